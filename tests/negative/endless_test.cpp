// PS programs that use the host's time and let no simulated time pass, and programs that are
// interrupted in the middle of a frame: the run ends, and keeps the results.
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "command_line.h"

using namespace negative;

namespace {

using HostClock = std::chrono::steady_clock;

/// Against hangs only: a quiet machine needs a second.
constexpr std::chrono::seconds longest{60};

enum Way {
  allocate,
  options,
  empty_text,
  connect,
  mask,
  poll_nothing,
  annotate,
  flush_nothing,
  nest,
  doze,
  rest,
  compute,
  foreign_calls,
  read_on
};

struct Endless : CommandLine {
  // A program that was ended is frozen with all that its stack holds.
  Endless() { ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1); }
  ~Endless() { ::unsetenv("LSAN_OPTIONS"); }

  static Words arguments(int way, const Words& more) {
    Words all{"run",       "z1.0",           "z1.5",  "--no-pictures",
              "--program", MARKERVP_ENDLESS, "--set", "sw.way=" + std::to_string(way)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  nlohmann::json result() const {
    return nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  }

  void fails(int way, const Words& parts, const Words& more = {}) const {
    BOOST_TEST_CONTEXT("way " << way) {
      std::filesystem::remove_all(*this / "out");
      Words all = arguments(way, {"--set", "ps.cpu.host_timeout=300 ms"});
      all.insert(all.end(), more.begin(), more.end());
      const kit::Outcome outcome = start(all);
      BOOST_TEST(outcome.exit_code == 3);
      check_one_line(outcome.err, parts);
      BOOST_TEST(result()["incomplete"] == "stopped by an error");
      BOOST_TEST(result()["frames"].size() == 1u);
    }
  }

  /// Sends `signal` when the first frame was reported.
  void is_interrupted(int way, int signal, const Words& more = {}) const {
    BOOST_TEST_CONTEXT("way " << way << ", signal " << signal) {
      std::filesystem::remove_all(*this / "out");
      kit::ChildProcess run(MARKERVP_EXECUTABLE, arguments(way, more), path());
      while (!run.ended() && !contains(run.out(), "[1/2]")) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      const auto sent = HostClock::now();
      run.send(signal);
      const kit::Outcome outcome = run.wait();
      BOOST_TEST((HostClock::now() - sent < longest));
      BOOST_TEST(outcome.exit_code == 130);
      check_one_line(outcome.err, {"interrupted", "kept"});
      BOOST_TEST(result()["incomplete"] == "interrupted");
      BOOST_TEST(result()["frames"].size() == 1u);
    }
  }
};

const std::string reason = "lets no simulated time pass, for 300 ms now (ps.cpu.host_timeout)";
const std::string program = "of program 'endless', pc ";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(endless, Endless)

BOOST_AUTO_TEST_CASE(calls_of_the_hal_that_take_no_time) {
  for (const int way : {allocate, options, empty_text, connect, mask, poll_nothing, annotate}) {
    fails(way, {reason, program});
  }
  fails(flush_nothing, {reason, program},
        {"--set", "ps.cpu.barrier_cycles=0 cycles", "--set", "ps.cpu.cache_call_cycles=0 cycles"});
}

BOOST_AUTO_TEST_CASE(functions_that_are_never_left) {
  fails(nest, {"hal_function_enter()", "more than hal_function_leave()", program},
        {"--set", "ps.cpu.host_timeout=100 s"});
}

BOOST_AUTO_TEST_CASE(the_c_library_and_code_of_others) {
  for (const int way : {doze, rest, compute, foreign_calls}) fails(way, {reason});
}

BOOST_AUTO_TEST_CASE(a_signal_ends_every_one_of_them) {
  for (const int way : {allocate, annotate, doze, rest, compute, foreign_calls}) {
    is_interrupted(way, SIGTERM);
  }
  is_interrupted(allocate, SIGINT);
}

/// Time passes here, slowly: the next frame is far away.
BOOST_AUTO_TEST_CASE(a_signal_ends_a_long_frame) {
  const Words slow{"--fidelity", "clocked", "--set", "ps.cpu.timeout=1000 s"};
  is_interrupted(read_on, SIGTERM, slow);
  is_interrupted(read_on, SIGINT, slow);
}

BOOST_AUTO_TEST_SUITE_END()
