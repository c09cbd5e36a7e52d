// How often the signals inside RTL change.
#include <boost/test/unit_test.hpp>

#include <simulation.h>

#include <cstdint>
#include <string>

#include <axi/rtl_part.h>
#include <pl/common/rtl_activity.h>
#include <vp/clock_scheduler.h>

namespace {

constexpr std::uint64_t period = 10'000;  // ps
constexpr double words_bits = 16 * 32;
const std::string turning = MARKERVP_TURNING_RTL;

struct Bench : kit::Simulation {
  Bench() {
    part.input("rst_n", reset_n);
    part.input("works", works);
    part.input("idle_input", idle_input);
    toggles = part.estimate().foreign.toggles;
  }
  void run_clocks(std::uint64_t clocks) {
    sc_core::sc_start(sc_core::sc_time::from_value(clocks * period));
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Signal<bool> reset_n{"reset_n", 1, true};
  vp::Signal<bool> works{"works"};
  vp::Signal<std::uint32_t> idle_input{"idle_input"};
  axi::RtlPart part{"part", turning, {{"clk", &clock}}};
  vp::IpEstimate::Foreign::Toggles toggles;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(rtl_activity)

BOOST_FIXTURE_TEST_CASE(signals_are_counted_and_memories_are_not, Bench) {
  BOOST_TEST(toggles.bits >= words_bits);
  BOOST_TEST(toggles.bits < 2 * words_bits);  // of 32 768 in the memory
}

// 4 KB of state are compared at one of about 68 edges, so the last ones may not be counted yet.
BOOST_FIXTURE_TEST_CASE(each_change_of_busy_logic_counts, Bench) {
  constexpr std::uint64_t clocks = 20'000;
  toggles.begin();
  works = true;
  run_clocks(clocks);
  BOOST_TEST(toggles.changes() == words_bits * clocks, boost::test_tools::tolerance(0.01));
  BOOST_TEST(toggles.busy_clocks() == clocks, boost::test_tools::tolerance(0.01));
}

BOOST_FIXTURE_TEST_CASE(idle_logic_of_the_same_size_changes_nothing, Bench) {
  toggles.begin();
  run_clocks(20'000);
  BOOST_TEST(toggles.changes() < words_bits);
}

BOOST_FIXTURE_TEST_CASE(logic_that_works_for_a_quarter_of_the_time_counts_as_such, Bench) {
  constexpr std::uint64_t stretch = 50, times = 2000;
  toggles.begin();
  for (std::uint64_t i = 0; i < times; ++i) {
    works = i % 4 == 0;
    run_clocks(stretch);
  }
  const double all = words_bits * stretch * times;
  BOOST_TEST(toggles.changes() == all / 4, boost::test_tools::tolerance(0.2));
  BOOST_TEST(toggles.busy_clocks() < 0.3 * stretch * times);
}

// What drives the pins takes their power.
BOOST_FIXTURE_TEST_CASE(pins_do_not_count, Bench) {
  toggles.begin();
  for (std::uint32_t i = 0; i < 4000; ++i) {
    idle_input = i % 2 ? 0x7FFF'FFFF : 0;
    run_clocks(1);
  }
  BOOST_TEST(toggles.changes() < words_bits);
}

BOOST_FIXTURE_TEST_CASE(nothing_is_counted_before_it_begins, Bench) {
  works = true;
  run_clocks(2000);
  BOOST_TEST(toggles.changes() == 0);
  toggles.begin();
  toggles.begin();  // once is enough
  run_clocks(2000);
  BOOST_TEST(toggles.changes() > 0);
  BOOST_TEST(toggles.changes() <= words_bits * 2000);
}

BOOST_AUTO_TEST_SUITE_END()
