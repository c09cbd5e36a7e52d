// Linux applications of several processes, and what each run leaves behind: nothing.
#include <boost/test/unit_test.hpp>

#include <csignal>
#include <filesystem>

#include "linux_place.h"

using namespace integration;

namespace {

struct Processes : LinuxPlace {
  Arguments arguments(const std::string& what, const Arguments& options = {}) const {
    Arguments all{"--linux", MARKERVP_APPLICATIONS "processes", "--no-report", "--quiet"};
    all.insert(all.end(), options.begin(), options.end());
    all.insert(all.end(), {"--", what});
    return all;
  }
  kit::Outcome works(const std::string& what, const Arguments& options = {}) const {
    const kit::Outcome outcome = run(arguments(what, options));
    BOOST_TEST(outcome.exit_code == 0, what << ": " << outcome.out << outcome.err);
    BOOST_TEST(outcome.err == "");
    return outcome;
  }
  void ends(int exit_code, const std::string& what, const Arguments& parts,
            const Arguments& options = {}) const {
    const kit::Outcome outcome = run(arguments(what, options));
    BOOST_TEST(outcome.exit_code == exit_code, what << ": " << outcome.out << outcome.err);
    for (const std::string& part : parts)
      BOOST_TEST((outcome.err.find(part) != std::string::npos),
                 what << ": '" << part << "' is not in: " << outcome.err);
  }
  bool has_access(const std::string& log, const std::string& part) const {
    return kit::read_file(*this / log).find(part) != std::string::npos;
  }
};

const std::string lit = "write  0x41200000  axi_gpio_0.GPIO_DATA  0x00000100";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(linux_processes, Processes)

BOOST_AUTO_TEST_CASE(copies_take_turns) {
  for (const std::string what : {"in_turn", "only_the_copy", "vforks", "clones", "helper"})
    works(what);
}

BOOST_AUTO_TEST_CASE(copies_whose_order_is_the_hosts) {
  for (const std::string what : {"both", "siblings"})
    ends(3, what,
         {"the application and a copy of it, made by fork(), both use its devices",
          "wait for the end of the copy", " " + what + "+0x"});
}

BOOST_AUTO_TEST_CASE(a_copy_that_had_the_hosts_time) {
  ends(0, "time_of_a_copy", {"asked for time before, which was the host's", "time_of_a_copy ("});
}

BOOST_AUTO_TEST_CASE(daemons_work_to_their_end) {
  for (const std::string what : {"becomes_daemon", "daemon_by_hand", "daemon_of_a_busy_parent"}) {
    works(what, {"--log-bus", "bus.log"});
    BOOST_TEST(has_access("bus.log", lit), kit::read_file(*this / "bus.log"));
    BOOST_TEST(result()["program_end"]["exit_code"] == 0);
    BOOST_TEST(none_is_left("processes"));
  }
}

BOOST_AUTO_TEST_CASE(the_end_of_a_daemon_is_that_of_the_run) {
  ends(1, "failing_daemon", {"program 'processes' ended with exit code 6"});
  ends(3, "dying_daemon", {"the application was ended by SIGABRT", " dying_daemon+0x"});
  ends(3, "endless_daemon",
       {"the application's process has ended, and a copy of it that fork() made runs on",
        "until_ended", "endless_daemon ("},
       {"--set", "ps.cpu.host_timeout=2 s"});
  BOOST_TEST(none_is_left("processes"));
}

BOOST_AUTO_TEST_CASE(a_daemon_is_the_same_each_time) {
  const auto log = [this](const std::string& name) {
    works("daemon_by_hand", {"--log-bus", name});
    return kit::read_file(*this / name);
  };
  BOOST_TEST(log("1.log") == log("2.log"));
}

BOOST_AUTO_TEST_CASE(a_session_of_its_own_ends_with_the_run) {
  works("leaves_a_session");
  BOOST_TEST(none_is_left("processes"));
}

BOOST_AUTO_TEST_CASE(a_killed_run_leaves_nothing) {
  for (const int signal : {SIGKILL, SIGINT, SIGSEGV}) {
    {
      Arguments all = arguments("session_and_endless");
      all.insert(all.begin(), "run");
      kit::ChildProcess run(MARKERVP_EXECUTABLE, all, path());
      const auto has_begun = [&] { return run.out().find("left") != std::string::npos; };
      BOOST_TEST_REQUIRE(await([&] { return run.ended() || has_begun(); }));
      BOOST_TEST(await([&] { return processes("processes") == 2; }));
      run.send(signal);
      run.wait();
    }
    BOOST_TEST(none_is_left("processes"));
    BOOST_TEST(await([this] { return std::filesystem::is_empty(*this / "tmp"); }));
  }
}

// Neither says where it is.
BOOST_AUTO_TEST_CASE(what_is_stopped_or_without_its_guard_ends_the_run) {
  ends(3, "stops_itself", {"the application is stopped, by SIGSTOP", "send it SIGCONT"},
       {"--set", "ps.cpu.host_timeout=2 s"});
  BOOST_TEST(none_is_left("processes"));
  ends(3, "kills_its_parent", {"between markervp and the application", "was ended from outside"});
  BOOST_TEST(none_is_left("processes"));
}

BOOST_AUTO_TEST_CASE(what_the_shim_needs_stays_open) {
  works("closes_all");
  works("takes_numbers");
}

BOOST_AUTO_TEST_CASE(what_the_shim_needs_is_taken_away) {
  ends(3, "takes_too_many",
       {"no descriptor above 199 is left for the platform", "takes_too_many+0x"});
  ends(3, "closes_by_itself",
       {"closed or replaced the descriptor 198", "with a system call of its own",
        "the application closed the descriptor by which it reaches"});
}

BOOST_AUTO_TEST_CASE(a_stack_overflows) {
  ends(3, "overflow",
       {"the application overflowed the stack of its main thread, which may have ",
        " KiB here (ulimit -s)", "deeper+0x"});
  ends(3, "large_variable", {"overflowed the stack of its main thread", "large_variable+0x"});
  ends(3, "thread_overflow",
       {"the application overflowed the stack of its thread 'filter', which has 256 "
        "KiB (pthread_attr_setstacksize())",
        "deeper+0x"});
  works("many_threads");
}

BOOST_AUTO_TEST_SUITE_END()
