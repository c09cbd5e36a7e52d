// Alarms of many modules on several clocks, against a plain search for the next one.
#include "recorder.h"

#include <simulation.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <deque>
#include <string>
#include <utility>

namespace {

constexpr std::uint64_t never = vp::Clock::never;
constexpr std::size_t module_count = 9;
constexpr std::uint64_t frequencies[] = {100'000'000, 148'500'000, 50'000'000};
constexpr std::size_t clock_count = std::size(frequencies);

/// What happened: when, and to whom; in order.
using Log = std::vector<std::pair<std::uint64_t, std::size_t>>;

std::size_t clock_of(std::size_t module) {
  return module % clock_count;
}

/// What a module does on an edge depends on its number, the time and the seed only.
struct Decision {
  std::uint64_t own;    ///< cycles until its next alarm; 0: none
  std::size_t other;    ///< module whose alarm is moved
  std::uint64_t later;  ///< to that many cycles from now; 0: this very edge
  bool moves;

  Decision(std::uint64_t seed, std::size_t module, std::uint64_t ps) {
    std::uint64_t chance =
        (seed * 31 + module) * 0x9E37'79B9'7F4A'7C15u ^ ps * 0xD6E8'FEB8'6659'FD93u;
    const auto draw = [&](std::uint64_t below) {
      chance ^= chance >> 29;
      chance *= 0xBF58'476D'1CE4'E5B9u;
      return (chance >> 33) % below;
    };
    own = draw(8) == 0 ? 0 : 1 + draw(20);
    other = draw(module_count);
    moves = draw(3) == 0 && other != module;
    // Modules that no signal connects run in the reverse order of their construction.
    const bool same_edge = clock_of(other) == clock_of(module) && other < module;
    later = same_edge ? draw(3) : 1 + draw(9);
  }
};

struct Sleeper : vp::Clocked {
  Sleeper(const std::string& name, vp::Clock& clock, std::size_t number, std::uint64_t seed,
          std::deque<Sleeper>& all, Log& log)
      : Clocked(name.c_str(), clock), number(number), seed(seed), all(all), log(log) {}

  void edge() override {
    const std::uint64_t now = clock().scheduler().now_ps();
    log.emplace_back(now, number);
    started = true;
    const Decision decision(seed, number, now);
    if (decision.moves && all[decision.other].started) {
      Sleeper& other = all[decision.other];
      other.wake_at(other.clock().cycle() + decision.later);
    }
    sleep_until(decision.own == 0 ? never : this_edge() + decision.own);
  }

  std::size_t number;
  bool started = false;  ///< awake until its first edge, whatever its alarm
  std::uint64_t seed;
  std::deque<Sleeper>& all;
  Log& log;
};

Log simulated(std::uint64_t seed, std::uint64_t end_ps) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler{"scheduler"};
  scheduler.set_batch(true);
  std::deque<vp::Clock> clocks;
  std::deque<Sleeper> sleepers;
  Log log;
  for (std::size_t c = 0; c < clock_count; ++c) {
    clocks.emplace_back(("clock" + std::to_string(c)).c_str(), scheduler, frequencies[c]);
  }
  for (std::size_t i = 0; i < module_count; ++i) {
    sleepers.emplace_back("sleeper" + std::to_string(i), clocks[clock_of(i)], i, seed, sleepers,
                          log);
  }
  run_to(end_ps);
  log.erase(std::find_if(log.begin(), log.end(), [&](auto& entry) { return entry.first > end_ps; }),
            log.end());
  return log;
}

/// The same by looking at every alarm for each step.
Log searched(std::uint64_t seed, std::uint64_t end_ps) {
  const auto time_of = [](std::size_t clock, std::uint64_t cycle) {
    return (cycle * 1'000'000'000'000 + frequencies[clock] / 2) / frequencies[clock];
  };
  const auto cycles_until = [&](std::size_t clock, std::uint64_t ps) {
    std::uint64_t cycle = ps / (1'000'000'000'000 / frequencies[clock] + 1);
    while (time_of(clock, cycle + 1) <= ps) ++cycle;
    return cycle;
  };
  std::vector<std::uint64_t> alarms(module_count, 1);  // awake on the first edge
  std::vector<bool> started(module_count, false);
  Log log;
  while (true) {
    // The earliest; at the same time clocks in the order of construction, modules in the reverse.
    std::uint64_t first = never;
    std::size_t found = 0;
    for (std::size_t c = 0; c < clock_count; ++c) {
      for (std::size_t i = module_count; i-- > 0;) {
        if (clock_of(i) != c || alarms[i] == never || time_of(c, alarms[i]) >= first) continue;
        first = time_of(c, alarms[i]);
        found = i;
      }
    }
    if (first > end_ps) return log;
    log.emplace_back(first, found);
    started[found] = true;
    const std::uint64_t cycle = std::exchange(alarms[found], never);
    const Decision decision(seed, found, first);
    if (decision.moves && started[decision.other]) {
      alarms[decision.other] = cycles_until(clock_of(decision.other), first) + decision.later;
    }
    alarms[found] = decision.own == 0 ? never : cycle + decision.own;
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(alarms)

BOOST_AUTO_TEST_CASE(every_alarm_runs_at_its_edge_and_in_order) {
  constexpr std::uint64_t end_ps = 20'000'000;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      const Log expected = searched(seed, end_ps);
      const Log log = simulated(seed, end_ps);
      BOOST_TEST(expected.size() > 20u);
      BOOST_REQUIRE_EQUAL(log.size(), expected.size());
      const auto differ = std::mismatch(log.begin(), log.end(), expected.begin());
      BOOST_TEST((differ.first == log.end()),
                 "step " << differ.first - log.begin() << " of " << log.size());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
