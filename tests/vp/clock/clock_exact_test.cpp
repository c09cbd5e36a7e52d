// Times of edges against the plain formula, however far and in whatever order they are asked for.
#include "recorder.h"

#include <simulation.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>

namespace {

using Wide = unsigned __int128;
constexpr std::uint64_t ps_per_second = 1'000'000'000'000;

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
};

/// round(cycles · 10¹² / f)
std::uint64_t rounded(std::uint64_t cycles, std::uint64_t hertz) {
  return static_cast<std::uint64_t>((Wide(cycles) * ps_per_second + hertz / 2) / hertz);
}

/// Edges of a clock that last changed at `origin_ps`, after `origin_cycle`, near edge n.
void check_near(const vp::Clock& clock, std::uint64_t origin_cycle, std::uint64_t origin_ps,
                std::uint64_t n) {
  const std::uint64_t hertz = clock.frequency_hz();
  const std::uint64_t cycle = origin_cycle + n;
  const std::uint64_t edge = origin_ps + rounded(n, hertz);
  const std::uint64_t before = origin_ps + rounded(n - 1, hertz);
  BOOST_TEST(clock.time_of(cycle) == edge);
  BOOST_TEST(clock.edge_at_or_after(edge) == edge);
  BOOST_TEST(clock.cycle_at_or_after(edge) == cycle);
  BOOST_TEST(clock.cycle_at_or_after(before + 1) == cycle);
  BOOST_TEST(clock.edge_at_or_after(before + 1) == edge);
  BOOST_TEST(clock.cycle_at_or_after(edge + 1) == cycle + 1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(exact_clocks)

BOOST_FIXTURE_TEST_CASE(near_and_far_edges_in_any_order, Fixture) {
  std::uint64_t chance = 1;
  for (const std::uint64_t hertz :
       {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{999'999}, std::uint64_t{100'000'000},
        std::uint64_t{148'500'000}, std::uint64_t{666'666'667}, std::uint64_t{999'999'999'989},
        ps_per_second}) {
    BOOST_TEST_CONTEXT(hertz << " Hz") {
      const vp::Clock clock{("clock_" + std::to_string(hertz)).c_str(), scheduler, hertz};
      const std::uint64_t last = static_cast<std::uint64_t>(Wide(hertz) * 1'000'000);  // 11 days
      std::uint64_t n = 1;
      for (int i = 0; i < 400; ++i) {
        check_near(clock, 0, 0, n);
        chance = chance * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
        const bool jump = i % 7 == 0;
        n = 1 + (jump ? (chance >> 5) % last : (n + (chance >> 50)) % last);
      }
      BOOST_TEST(clock.cycle_at_or_after(0) == 1u);
      BOOST_TEST(clock.edge_at_or_after(0) == rounded(1, hertz));
    }
  }
}

BOOST_FIXTURE_TEST_CASE(after_a_change_they_count_from_there, Fixture) {
  vp::Clock clock{"clock", scheduler, 666'666'667};
  Recorder recorder{"recorder", clock};
  recorder.sleep_after = 1;
  run_to(1'234'567);
  const std::uint64_t cycle = clock.cycle();
  clock.set_frequency(148'500'000);
  BOOST_TEST(clock.cycle() == cycle);
  const std::uint64_t now = kit::now_ps();
  for (const std::uint64_t n : {1u, 2u, 3u, 1'000'000u, 2u, 100'000'000u, 1u}) {
    check_near(clock, cycle, now, n);
  }
  BOOST_TEST(clock.edge_at_or_after(now) == now + rounded(1, 148'500'000), "not the origin itself");
  BOOST_TEST(clock.edge_at_or_after(5) == now + rounded(1, 148'500'000));
}

/// Changes the frequency of its own clock on an edge of it.
struct OwnChanger : Recorder {
  using Recorder::Recorder;
  void edge() override {
    Recorder::edge();
    if (clock().cycle() == 3) clock().set_frequency(50'000'000);
  }
};

BOOST_FIXTURE_TEST_CASE(a_clock_may_be_changed_on_its_own_edge, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  OwnChanger changer{"changer", clock};
  run_to(75'000);
  const std::vector<std::uint64_t> times{10'000, 20'000, 30'000, 50'000, 70'000};
  BOOST_TEST(changer.times == times, boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(a_clock_may_have_many_modules, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  std::vector<std::unique_ptr<Recorder>> modules;
  for (int i = 0; i < 200; ++i) {
    modules.push_back(std::make_unique<Recorder>(("m" + std::to_string(i)).c_str(), clock));
    modules.back()->sleep_after = 1;
  }
  modules.erase(modules.begin() + 30);
  run_to(15'000);
  modules[70]->wake_at(5);
  modules[198]->wake_at(9);
  modules[64]->wake_at(7);
  modules[64]->wake_at(vp::Clock::never);
  run_to(95'000);
  modules[150]->wake();
  run_to(115'000);
  using Times = std::vector<std::uint64_t>;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    Times expected{10'000};
    if (i == 70) expected.push_back(50'000);
    if (i == 198) expected.push_back(90'000);
    if (i == 150) expected = {10'000, 100'000, 110'000};
    BOOST_TEST(modules[i]->times == expected, boost::test_tools::per_element());
  }
  BOOST_TEST(clock.edges_run() == 5u);
}

BOOST_AUTO_TEST_SUITE_END()
