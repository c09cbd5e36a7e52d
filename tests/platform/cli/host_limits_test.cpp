// A host that gives little: few descriptors, a small stack.
#include <boost/test/unit_test.hpp>

#include <string>

#include "cli_kit.h"
#include "sanitized.h"

namespace {

using cli_test::contains;

/// The program under limits of the shell, which may be lowered only.
struct Limited : cli_test::Terminal {
  int run(const std::string& limits, const std::string& arguments) {
    const std::string script = limits + "; exec '" MARKERVP_EXECUTABLE "' " + arguments;
    const kit::Outcome outcome = kit::run_process("/bin/sh", {"-c", script}, folder.path());
    out = outcome.out;
    err = outcome.err;
    return outcome.exit_code;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(host_limits, Limited)

// Whatever it is that finds no descriptor. The sanitizer needs some to look at an object's type.
BOOST_AUTO_TEST_CASE(too_few_descriptors_are_the_hosts_fault,
                     *boost::unit_test::enable_if<!kit::is_sanitized>()) {
  kit::write_file(folder / "study.yaml",
                  "inputs: [z1.0]\nparameters: {ps.fclk_clk1.frequency: [45 MHz, 50 MHz]}\n");
  for (const std::string command :
       {"run z1.0 --quiet -o out", "run z1.0 --quiet -o out --terminal uart1=link",
        "sweep study.yaml -o sweep", "map"}) {
    int refused = 0;
    for (int descriptors = 5; descriptors < 13; ++descriptors) {
      const int code = run("ulimit -n " + std::to_string(descriptors), command);
      if (code == 0) continue;
      ++refused;
      BOOST_TEST(code == 2, command << " with " << descriptors << ": " << err);
      BOOST_TEST(contains(err, "Too many open files; raise ulimit -n"),
                 command << " with " << descriptors << ": " << err);
    }
    BOOST_TEST(refused > 0, command);
  }
}

// Yosys and its ABC say nothing of use.
BOOST_AUTO_TEST_CASE(too_few_descriptors_for_a_synthesis,
                     *boost::unit_test::enable_if<!kit::is_sanitized>()) {
  if (kit::run_process("/bin/sh", {"-c", "command -v yosys"}, folder.path()).exit_code != 0) return;
  kit::write_file(folder / "small.sv",
                  "module small(input logic clk, input logic a, output logic b);\n"
                  "  always_ff @(posedge clk) b <= !a;\nendmodule\n");
  const std::string command = "rtl synth --rtl . --top small -o small.json";
  int refused = 0;
  for (int descriptors = 5; descriptors < 25; ++descriptors) {
    const int code = run("ulimit -n " + std::to_string(descriptors), command);
    if (code == 0) continue;
    ++refused;
    BOOST_TEST(code == 2, descriptors << ": " << err);
    BOOST_TEST(contains(err, "Too many open files; raise ulimit -n"), descriptors << ": " << err);
  }
  BOOST_TEST(refused > 0);
  BOOST_TEST(run("ulimit -n 30", command) == 0, err);
}

BOOST_AUTO_TEST_CASE(a_small_stack_grows_where_it_may) {
  BOOST_TEST(run("ulimit -S -s 64", "run z1.0 --quiet -o out") == 0, err);
  BOOST_TEST(run("ulimit -s 64", "run z1.0 --quiet -o out") == 2);
  BOOST_TEST(cli_test::is_one_line_with(
                 err, "the stack may take 64 KiB (ulimit -s), and 512 are needed: raise ulimit -s"),
             err);
}

BOOST_AUTO_TEST_SUITE_END()
