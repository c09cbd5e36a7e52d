// PS programs that cannot be loaded, and one that breaks the rules.
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Programs : CommandLine {
  // A program that breaks the rules is frozen with all that its stack holds: on purpose, and no
  // leak for builds with the address sanitizer to report.
  Programs() { ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1); }
  ~Programs() { ::unsetenv("LSAN_OPTIONS"); }

  /// Runs the faulty program on three frames: exit code 3, one line with all of `parts`, and the
  /// result of the first frame.
  void fails(int mistake, const Words& parts, const Words& more = {}) const {
    BOOST_TEST_CONTEXT("mistake " << mistake) {
      std::filesystem::remove_all(*this / "out");
      Words arguments{
          "run",       "z1.0",          "z1.5",  "z2.0",
          "--program", MARKERVP_FAULTY, "--set", "sw.mistake=" + std::to_string(mistake)};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const kit::Outcome outcome = start(arguments);
      BOOST_TEST(outcome.signal == 0);
      BOOST_TEST(outcome.exit_code == 3);
      check_one_line(outcome.err, parts);
      check_first_frame_is_kept();
    }
  }

  void check_first_frame_is_kept() const {
    const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
    BOOST_TEST(result["incomplete"] == "stopped by an error");
    BOOST_TEST(!result["provenance"]["error"].get<std::string>().empty());
    BOOST_TEST_REQUIRE(result["frames"].size() == 1u);
    BOOST_TEST(result["frames"][0]["input"] == "z1.0");
    BOOST_TEST(result["system"] == "faulty");
    BOOST_TEST(result["summary"]["frames"] == 1);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(programs, Programs)

BOOST_AUTO_TEST_CASE(programs_that_cannot_be_loaded) {
  run_refuses({"--program", "missing.so"}, {"missing.so"});
  run_refuses({"--program", "hybird"}, {"hybird"});
  run_refuses({"--program", "."}, {"cannot load program", "Is a directory"});
  run_refuses({"--program", ""}, {"program"});
  kit::write_file(*this / "text.so", "no program");
  run_refuses({"--program", "text.so"}, {"text.so"});
  kit::write_file(*this / "empty.so", "");
  run_refuses({"--program", "empty.so"}, {"empty.so"});
  // The loader itself would touch what is missing and die of it.
  const std::size_t size = std::filesystem::file_size(MARKERVP_FAULTY);
  for (const std::size_t bytes : {std::size_t{4}, std::size_t{64}, std::size_t{100},
                                  std::size_t{3000}, size / 8, size - 100}) {
    kit::write_part(MARKERVP_FAULTY, *this / "half.so", bytes);
    const bool known = bytes >= 64;  // as a shared object
    run_refuses({"--program", "half.so"}, {"half.so", known ? "truncated" : "no shared object"});
  }
  run_refuses({"--program", std::string(300, 'n')}, {"nnn"});
  run_refuses({"--program", "libz.so.1"}, {"libz.so.1"});
  refuses({"run", "--program", MARKERVP_EXECUTABLE, "--output", "out"}, {MARKERVP_EXECUTABLE});
}

BOOST_AUTO_TEST_CASE(options_of_the_program_are_checked) {
  run_refuses({"--program", MARKERVP_FAULTY, "--set", "sw.mistake=9"}, {"sw.mistake", "0 to 7"});
  run_refuses({"--program", MARKERVP_FAULTY, "--set", "sw.margin=4 px"}, {"sw.margin"});
}

BOOST_AUTO_TEST_CASE(accesses_where_nothing_is) {
  fails(0, {"read of 0x50000000", "DECERR", "at ", "ns", "program 'faulty'"});
  fails(1, {"write to 0x50000004", "DECERR", "at ", "ns", "program 'faulty'"});
  fails(2, {"0x41200002", "not a multiple of 4", "program 'faulty'"});
}

BOOST_AUTO_TEST_CASE(a_program_that_never_ends) {
  fails(3,
        {"1 ms", "ps.cpu.timeout", "it polls for a change of any bit of axi_gpio_1.GPIO_DATA: 0x",
         "program 'faulty'", "faulty.cpp:", ", called from "},
        {"--set", "ps.cpu.timeout=1 ms"});
}

BOOST_AUTO_TEST_CASE(a_program_that_sleeps_forever) {
  fails(4, {"program 'faulty'"});
}

BOOST_AUTO_TEST_CASE(a_result_of_unknown_kind) {
  fails(5, {"unknown kind", "at 320 ns of program 'faulty', pc ", "entry()+"});
}

BOOST_AUTO_TEST_CASE(a_buffer_that_was_not_flushed) {
  for (const bool flushed : {false, true}) {
    const kit::Outcome outcome =
        start({"run", "z1.0", "z1.5", "--no-pictures", "--program", MARKERVP_FAULTY, "--set",
               flushed ? "sw.mistake=7" : "sw.mistake=6"});
    BOOST_TEST(outcome.exit_code == 0);
    BOOST_TEST(contains(outcome.err, "never flushed") == !flushed, outcome.err);
  }
}

/// Nothing was found before the mistake: still a result, with no frames.
BOOST_AUTO_TEST_CASE(a_first_frame_that_fails) {
  const kit::Outcome outcome =
      start({"run", "demo", "--set", "ps.cpu.timeout=1 ms", "--set", "ps.cpu.quantum=0 ps"});
  BOOST_TEST(outcome.exit_code == 3);
  check_one_line(outcome.err, {"ps.cpu.timeout", "program 'hybrid'"});
  const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["frames"].empty());
  BOOST_TEST(result["summary"]["frames"] == 0);
}

BOOST_AUTO_TEST_SUITE_END()
