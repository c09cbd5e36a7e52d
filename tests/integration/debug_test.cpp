// markervp debug: a run is made again, and gdb is in its program at a moment of it.
#include <boost/test/unit_test.hpp>
#include <regex>

#include "executable.h"

using namespace integration;

namespace {

struct Debug : Workplace {
  Debug() { run_program(); }

  void run_program(const Arguments& more = {}, int exit_code = 0,
                   const std::string& program = MARKERVP_DEBUGGED) const {
    Arguments arguments{"--program", program, "--no-pictures", "--no-report"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const kit::Outcome outcome = run(arguments);
    BOOST_TEST_REQUIRE(outcome.exit_code == exit_code, outcome.err);
  }
  kit::Outcome debug(const Arguments& arguments, const std::string& folder = "out") const {
    Arguments all{"debug", folder};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  /// False, with a message, where gdb is missing or may not look at processes, as in many
  /// containers.
  bool gdb_works() const {
    const kit::Outcome outcome = debug({"--register", "axi_gpio_0.GPIO_DATA", "--command", "quit"});
    const bool works = outcome.err.find("gdb (") == std::string::npos &&
                       outcome.err.find("no debugger may") == std::string::npos &&
                       outcome.err.find("write extended state status") == std::string::npos;
    if (!works) BOOST_TEST_MESSAGE("left out: " + outcome.err);
    return works;
  }
  void finds(const Arguments& arguments, const std::vector<std::string>& parts) const {
    const kit::Outcome outcome = debug(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    std::size_t at = 0;
    for (const std::string& part : parts) {
      const std::size_t found = outcome.out.find(part, at);
      BOOST_TEST((found != std::string::npos), "'" << part << "' is not in its place in:\n"
                                                   << outcome.out << outcome.err);
      if (found != std::string::npos) at = found + part.size();
    }
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(debug, Debug)

BOOST_AUTO_TEST_CASE(an_access_by_its_number) {
  if (!gdb_works()) return;
  finds({"--register", "axi_gpio_0.GPIO_DATA", "--access", "2", "--command", "print stage",
         "--command", "info locals"},
        {"stopped: access 2 of axi_gpio_0.GPIO_DATA: write 0x00000200 OK, at ", " of program ",
         "write(", "debugged.cpp:", "hal_write32(output()", "$1 = 2"});
}

BOOST_AUTO_TEST_CASE(writes_alone_are_counted_and_the_next_one_follows) {
  if (!gdb_works()) return;
  finds({"--register", "axi_gpio_0.GPIO_DATA", "--access", "2", "--writes", "--command", "continue",
         "--command", "print stage"},
        {"stopped: access 2 of", "stopped: access 3 of", "write 0x00000300",
         "debugged.cpp:", "$1 = 3"});
}

BOOST_AUTO_TEST_CASE(a_time_is_met_exactly_in_the_call_in_which_it_passes) {
  if (!gdb_works()) return;
  finds(
      {"--at", "20 us", "--command", "simtime", "--command", "print stage", "--command",
       "registers axi_gpio_0", "--command", "continue"},
      {"stopped: the time has come, at 20 us of program 'debugged', pc ", "rest()",
       "hal_poll_until_changed(", "20 us", "$1 = 100", "0x00000300  GPIO_DATA", "exited normally"});
}

BOOST_AUTO_TEST_CASE(a_warning_by_its_number) {
  if (!gdb_works()) return;
  finds({"--warning", "2", "--command", "print stage"},
        {"stopped: warning 2: ps.cpu: the second (/markervp/cpu/program), at ", "run ()",
         "hal_warn(\"the second\")", "$1 = 200"});
}

BOOST_AUTO_TEST_CASE(a_failure_while_its_calls_are_under_way) {
  if (!gdb_works()) return;
  run_program({"--set", "sw.end=data_abort"}, 3);
  finds(
      {"--command", "print stage", "--command", "print (int)end"},
      {"stopped: data abort: read of 0x50000000", "hal_read32(0x5000'0000)", "$1 = 200", "$2 = 1"});
  run_program({"--set", "sw.end=segmentation_fault"}, 3);
  finds({"--failure", "--command", "print (int)end"},
        {"stopped: segmentation fault: write to 0x00000008", "segmentation_fault) *", "$1 = 2"});
}

BOOST_AUTO_TEST_CASE(it_writes_nothing) {
  const std::string before = result_text();
  debug({"--warning", "1", "--command", "continue"});
  BOOST_TEST(result_text() == before);
}

BOOST_AUTO_TEST_CASE(a_moment_that_does_not_come_is_told) {
  const auto missed = [this](const Arguments& arguments, const std::string& pattern) {
    const kit::Outcome outcome = debug(arguments);
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(std::regex_search(outcome.err, std::regex(pattern)), outcome.err);
  };
  missed({"--at", "1 s"}, "the run ended at .* us, before 1 s: choose an earlier --at");
  missed({"--register", "axi_gpio_0.GPIO_TRI"},
         "the program made 0 accesses of axi_gpio_0.GPIO_TRI until the end at .*, not 1: ");
  missed({"--register", "axi_gpio_0.GPIO_DATA", "--writes", "--access", "4"},
         "the program made 3 writes of .*, not 4: choose a smaller --access");
  missed({"--warning", "3"}, "there were 2 warnings until the end at .*, not 3: ");
  missed({}, "the program was not stopped, but ended at .*: choose a moment with --at");
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told) {
  const auto fails = [this](const Arguments& arguments, const std::string& message,
                            const std::string& folder = "out") {
    const kit::Outcome outcome = debug(arguments, folder);
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(outcome.err.find(message) != std::string::npos, outcome.err);
  };
  fails({"--register", "axi_gpio_7.GPIO_DATA"}, "no device 'axi_gpio_7': choose ");
  fails({"--register", "axi_gpio_0.DATA"}, "no register 'axi_gpio_0.DATA': axi_gpio_0 has ");
  fails({"--at", "soon"}, "--at 'soon' ");
  fails({"--at", "1 us", "--warning", "1"}, "--at excludes --warning");
  fails({"--access", "3"}, "--access requires --register");
  fails({"--warning", "0"}, "--warning");
  fails({"--at", "1 us"}, "cannot read result 'nowhere/result.json'", "nowhere");
}

BOOST_AUTO_TEST_CASE(without_gdb_it_says_what_to_do) {
  if (!gdb_works()) return;
  const kit::Outcome outcome = kit::run_process(
      "/usr/bin/env", {"PATH=/nonexistent", MARKERVP_EXECUTABLE, "debug", "out", "--at", "1 us"},
      path());
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("cannot start gdb (No such file or directory): install it") !=
                 std::string::npos,
             outcome.err);
}

BOOST_AUTO_TEST_CASE(a_program_without_debug_information_is_told) {
  if (!gdb_works()) return;
  const std::string plain = *this / "plain.so";
  std::filesystem::copy_file(MARKERVP_DEBUGGED, plain);
  const kit::Outcome stripped = kit::run_process("/usr/bin/env", {"strip", "-g", plain}, path());
  if (stripped.exit_code != 0) return;
  run_program({}, 0, plain);
  finds({"--warning", "1", "--command", "backtrace 1"},
        {"stopped: warning 1", "no debug information there: compile it with -g"});
}

BOOST_AUTO_TEST_SUITE_END()
