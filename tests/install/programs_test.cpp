// PS programs built outside of the tree, on the installed executable.
#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include "installation.h"

using namespace install_test;

namespace {

struct Programs {
  Programs() {
    installed.build(installed / "share/markervp/examples/04_own_program", "template");
    installed.build(project("programs"), "programs");
  }

  std::string file(const std::string& name) const {
    return installed.beside("programs/" + name + ".so");
  }
  kit::Outcome run(const std::string& program, const Words& more = {}) const {
    Words arguments{"run", "--program", program, "--output", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return installed.markervp(arguments);
  }
  nlohmann::json result() const {
    return nlohmann::json::parse(kit::read_file(installed.beside("out/result.json")));
  }

  const Installation& installed = Installation::get();
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(programs, Programs)

BOOST_AUTO_TEST_CASE(the_template) {
  const kit::Outcome outcome = run(installed.beside("template/first.so"));
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(outcome.err == "");
  BOOST_TEST(contains(outcome.out,
                      "hello from the processing system\n"
                      "toggled an output, now waiting for the timer\n"
                      "interrupt 1 after 1000 us\n"
                      "interrupt 2 after 2000 us\n"
                      "interrupt 3 after 3000 us\n"
                      "\n"
                      "no frames: the program ended at 3.00"),
             outcome.out);
  BOOST_TEST(contains(outcome.out, "with exit code 0   (first, "), outcome.out);
  BOOST_TEST(contains(outcome.out, "wrote out/result.json"), outcome.out);
  BOOST_TEST(!contains(outcome.out, "picture"), outcome.out);
  BOOST_TEST(result()["program_end"]["exit_code"] == 0);
  BOOST_TEST(result()["frames"].empty());
  BOOST_TEST(result()["system"] == "first");
}

BOOST_AUTO_TEST_CASE(the_target_run_of_the_template) {
  const kit::Outcome outcome = installed.build_target("template", "run");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "interrupt 3 after 3000 us"), outcome.out);
}

BOOST_AUTO_TEST_CASE(installed_programs_are_found_by_name) {
  const kit::Outcome hybrid = run("hybrid");
  BOOST_TEST(hybrid.exit_code == 0, hybrid.err);
  BOOST_TEST(contains(hybrid.out, "1 frame, 1 with a marker"), hybrid.out);
  BOOST_TEST(run("ps-only", {"--no-pictures"}).exit_code == 0);
  BOOST_TEST(contains(run("blink").out, "unhandled 0"));
}

/// The driver and marker libraries of the package, and results.
BOOST_AUTO_TEST_CASE(a_program_that_takes_images) {
  const kit::Outcome outcome = run(file("frames"), {"z1.0", "z2.0", "--no-pictures"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(result()["summary"]["frames"] == 2);
}

BOOST_AUTO_TEST_CASE(tests_of_a_program_run_in_ctest) {
  const kit::Outcome outcome = installed.build_target("programs", "test");
  BOOST_TEST(outcome.exit_code == 0, outcome.out);
  BOOST_TEST(contains(outcome.out, "100% tests passed, 0 tests failed out of 2"), outcome.out);
  BOOST_TEST(
      contains(kit::read_file(installed.beside("programs/frames_led.xml")), "failures=\"0\""));
}

BOOST_AUTO_TEST_CASE(a_program_that_fails) {
  const kit::Outcome outcome = run(file("failing"));
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(outcome.err == "markervp: program 'failing' ended with exit code 7\n");
  BOOST_TEST(contains(outcome.out, "no line end\n"), "what it wrote last");
  BOOST_TEST(result()["program_end"]["exit_code"] == 7);
}

// Counters of gcov are static data, which the platform restores: they are written instead, once.
BOOST_AUTO_TEST_CASE(coverage) {
  BOOST_TEST_REQUIRE(run(file("covered")).exit_code == 0);
  const std::string objects = installed.beside("programs/CMakeFiles/covered.dir");
  const kit::Outcome gcov =
      installed.run("/usr/bin/env", {"gcov", "-o", objects, "checked.cpp.gcda"});
  BOOST_TEST_REQUIRE(gcov.exit_code == 0, gcov.err);
  const std::string lines = kit::read_file(installed.beside("checked.cpp.gcov"));
  BOOST_TEST(contains(lines, "       10:   12:  return table[index % 4];"), lines);
  BOOST_TEST(contains(lines, "    #####:   10:    return -1;"), lines);
  BOOST_TEST(contains(lines, "0:Runs:1\n"), lines);
}

BOOST_AUTO_TEST_CASE(sanitizers) {
  const auto checked = [&](const std::string& name) {
    return installed.run("/bin/sh", {"-c",
                                     "LD_PRELOAD=$(gcc -print-file-name=libasan.so) "
                                     "ASAN_OPTIONS=detect_leaks=0 " +
                                         (installed / "bin/markervp") +
                                         " run --output out --program " + file(name)});
  };
  const kit::Outcome fine = checked("address_checked");
  BOOST_TEST(fine.exit_code == 0, fine.err);
  BOOST_TEST(fine.err == "");
  const kit::Outcome beyond = checked("beyond");
  BOOST_TEST(beyond.exit_code != 0);
  BOOST_TEST(contains(beyond.err, "global-buffer-overflow"), beyond.err);
  BOOST_TEST(contains(beyond.err, "checked.cpp:23"), beyond.err);
  const kit::Outcome overflowing = run(file("overflowing"));
  BOOST_TEST(overflowing.exit_code == 0);
  BOOST_TEST(contains(overflowing.err, "checked.cpp:27:"), overflowing.err);
}

/// On the chip its static buffer would do; here only the HAL's memory has a bus address.
BOOST_AUTO_TEST_CASE(a_dma_buffer_outside_of_the_ddr) {
  const kit::Outcome outcome = run(file("dma_outside"));
  BOOST_TEST(outcome.exit_code == 0, "the program sees the error in DMASR");
  for (const char* part : {"axi_dma_0", "MM2S transfer of 64 bytes at 0x80000000", "DECERR",
                           "hal_dma_allocate", "[/markervp/axi_dma/bus_error]"}) {
    BOOST_TEST(contains(outcome.err, part), outcome.err);
  }
  BOOST_TEST(contains(outcome.out, "DMADecErr 1\n"), outcome.out);
  BOOST_TEST(contains(outcome.out, "more than there is: refused\n"), outcome.out);
}

BOOST_AUTO_TEST_CASE(files_that_are_no_programs) {
  kit::write_file(installed.beside("text.so"), std::string(1000, 't'));
  check_refused(run("text.so"),
                {"cannot load program '", "text.so", "no shared object for this machine"});
  check_refused(run(file("no_entry")),
                {"no_entry.so' is not a PS program", "neither main() nor an entry"});
  check_refused(run(file("wrong_abi")), {"wrong_abi.so", "was built for version", "rebuild it"});
  check_refused(run(file("unresolved")), {"unresolved.so", "nobody_has_this"});
  check_refused(run("nonsense"), {"no program 'nonsense'", "programs"});
}

BOOST_AUTO_TEST_CASE(a_program_for_another_machine) {
  constexpr std::size_t machine = 18;  // e_machine of the ELF header, little endian
  constexpr char arm = 40;
  std::string bytes = kit::read_file(installed.beside("template/first.so"));
  bytes[machine] = arm;
  bytes[machine + 1] = 0;
  kit::write_file(installed.beside("arm.so"), bytes);
  check_refused(run("arm.so"), {"cannot load program '", "arm.so'", "another machine, ARM;"});
}

/// Something else has the addresses of the DDR: a library that is loaded before all others.
BOOST_AUTO_TEST_CASE(the_range_of_the_ddr_is_occupied) {
  const kit::Outcome outcome = installed.run(
      "/usr/bin/env",
      {"LD_PRELOAD=" + file("occupant"), installed / "bin/markervp", "run", "--output", "never"});
  check_refused(outcome,
                {"ps.ddr (DDR) needs the host addresses 0x001", " to 0x20000000, but they are ",
                 "occupied by " + file("occupant") + " at 0x10000000 to 0x10001000"});
  BOOST_TEST(!std::filesystem::exists(installed.beside("never")));
}

BOOST_AUTO_TEST_SUITE_END()
