// PS programs that misbehave while they are loaded or unloaded, and wrong descriptions.
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "command_line.h"

using namespace negative;

namespace {

struct Early : CommandLine {
  Early() { ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1); }
  ~Early() {
    ::unsetenv("LSAN_OPTIONS");
    ::unsetenv("EARLY");
  }

  kit::Outcome run(const std::string& way) const {
    ::setenv("EARLY", way.c_str(), 1);
    return start({"run", "--program", MARKERVP_EARLY, "--output", "out"});
  }

  bool has_result() const { return std::filesystem::exists(*this / "out/result.json"); }

  /// Nothing runs: exit code 3, and no result.
  void fails(const std::string& way, const Words& parts) const {
    BOOST_TEST_CONTEXT(way) {
      const kit::Outcome outcome = run(way);
      BOOST_TEST(outcome.exit_code == 3);
      check_one_line(outcome.err, parts);
      BOOST_TEST(!has_result());
    }
  }

  /// SIGTERM while the program does nothing but use time, or wait.
  kit::Outcome interrupted(const std::string& way) const {
    ::setenv("EARLY", way.c_str(), 1);
    kit::ChildProcess run(MARKERVP_EXECUTABLE,
                          {"run", "--program", MARKERVP_EARLY, "--output", "out"}, path());
    while (!run.ended() && !std::filesystem::exists(*this / "here")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::filesystem::remove(*this / "here");
    run.send(SIGTERM);
    return run.wait();
  }
};

const std::string where = "in the constructor of a static object";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(early, Early)

BOOST_AUTO_TEST_CASE(a_program_that_behaves) {
  BOOST_TEST(run("").exit_code == 0);
  BOOST_TEST(has_result());
}

BOOST_AUTO_TEST_CASE(constructors_that_misbehave) {
  fails("fault", {"early.so", "segmentation fault: write to 0x00000000", where});
  fails("throw", {"early.so", "threw an exception: oops", where});
  fails("terminate", {"early.so", "std::terminate()", where});
  fails("hal", {"early.so", "called hal_read32() outside of its entry function", where});
  fails("exit", {"early.so", "called _exit(0)", where});
}

/// Ten seconds of the host's time: the limit has no parameter before there is a platform.
BOOST_AUTO_TEST_CASE(a_constructor_that_does_not_end) {
  fails("spin", {"early.so", "takes the host's time", where});
}

BOOST_AUTO_TEST_CASE(a_constructor_that_changes_the_working_folder) {
  BOOST_TEST(run("chdir").exit_code == 0);
  BOOST_TEST(has_result());
}

BOOST_AUTO_TEST_CASE(destructors_that_misbehave) {
  for (const std::string way : {"late fault", "late exit"}) {
    const kit::Outcome outcome = run(way);
    BOOST_TEST(outcome.exit_code == 3);
    check_one_line(outcome.err, {"early.so", "in the destructor of a static object"});
    BOOST_TEST(has_result());
  }
}

/// What is refused stays loaded until the end.
BOOST_AUTO_TEST_CASE(destructors_of_an_object_of_another_kind) {
  ::setenv("EARLY", "late exit", 1);
  for (const std::string option : {"--design=", "--set=pl.fidelity.corner_detection="}) {
    const kit::Outcome outcome = start({"config", option + MARKERVP_EARLY});
    BOOST_TEST(outcome.exit_code == 3, option);
    BOOST_TEST(outcome.err.find("early.so' is not ") != std::string::npos, outcome.err);
    BOOST_TEST(outcome.err.find("in the destructor of a static object") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_signal_ends_loading_and_unloading) {
  for (const std::string way : {"spin", "sleep"}) {
    const kit::Outcome outcome = interrupted(way);
    BOOST_TEST(outcome.exit_code == 130, way);
    check_one_line(outcome.err, {"interrupted"});
    BOOST_TEST(!has_result());
  }
  BOOST_TEST(interrupted("late spin").exit_code == 130);
}

BOOST_AUTO_TEST_CASE(tables_that_are_not_there) {
  ::setenv("EARLY", "count", 1);
  run_refuses({"--program", MARKERVP_EARLY}, {"early.so", "claims 4000000000 units", "4096"});
  ::setenv("EARLY", "wrong count", 1);
  run_refuses({"--program", MARKERVP_EARLY}, {"early.so"});
}

BOOST_AUTO_TEST_SUITE_END()
