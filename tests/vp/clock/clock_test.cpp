#include "recorder.h"

#include <simulation.h>
#include <boost/test/unit_test.hpp>

using Times = std::vector<std::uint64_t>;

BOOST_AUTO_TEST_SUITE(clocks)

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
};

BOOST_FIXTURE_TEST_CASE(edges_fall_at_rounded_multiples_of_the_period, Fixture) {
  // 27 MHz: 37037.037 ps, 55 MHz: 18181.818 ps, 148.5 MHz: 6734.007 ps.
  vp::Clock a{"a", scheduler, 27'000'000}, b{"b", scheduler, 55'000'000},
      c{"c", scheduler, 148'500'000};
  Recorder ra{"ra", a}, rb{"rb", b}, rc{"rc", c};
  run_to(120'000);
  BOOST_TEST(ra.times == (Times{37037, 74074, 111111}), boost::test_tools::per_element());
  BOOST_TEST(rb.times == (Times{18182, 36364, 54545, 72727, 90909, 109091}),
             boost::test_tools::per_element());
  BOOST_TEST(rc.times[0] == 6734u);
  BOOST_TEST(rc.times[16] == 114478u);  // 17 · 6734.0067 = 114478.11
  BOOST_TEST(rc.cycles[16] == 17u);
}

BOOST_FIXTURE_TEST_CASE(no_drift_after_a_million_edges, Fixture) {
  vp::Clock clock{"clock", scheduler, 333'333'333};
  BOOST_TEST(clock.time_of(333'333'333) == 1'000'000'000'000u);
  CountingModule counter{"counter", clock};
  Recorder recorder{"recorder", clock};
  scheduler.set_batch(true);
  run_to(3'000'000'000);  // 3 ms
  BOOST_TEST(recorder.times[999'999] == clock.time_of(1'000'000));
  BOOST_TEST(clock.time_of(1'000'000) == 3'000'000'003u);
}

BOOST_FIXTURE_TEST_CASE(conversions, Fixture) {
  vp::Clock clock{"clock", scheduler, 50'000'000};
  BOOST_TEST(clock.time_of(1) == 20'000u);
  BOOST_TEST(clock.cycle_at_or_after(0) == 1u);
  BOOST_TEST(clock.cycle_at_or_after(20'000) == 1u);
  BOOST_TEST(clock.cycle_at_or_after(20'001) == 2u);
  BOOST_TEST(clock.edge_at_or_after(50'001) == 60'000u);
  BOOST_TEST(clock.duration_ps(6.5) == 130'000u);
}

BOOST_FIXTURE_TEST_CASE(a_stopped_clock_has_no_edges, Fixture) {
  vp::Clock clock{"clock", scheduler, 0};
  Recorder recorder{"recorder", clock};
  run_to(1'000'000);
  BOOST_TEST(recorder.times.empty());
  BOOST_TEST(clock.cycle() == 0u);
  BOOST_TEST(clock.edge_at_or_after(5) == vp::Clock::never);
}

/// Changes a clock's frequency at given times.
struct Changer : sc_core::sc_module {
  SC_HAS_PROCESS(Changer);
  Changer(sc_core::sc_module_name name, vp::Clock& clock) : sc_module(name), clock_(clock) {
    SC_THREAD(run);
  }
  void run() {
    for (auto [ps, hertz] : changes) {
      wait(vp::from_ps(ps - kit::now_ps()));
      clock_.set_frequency(hertz);
    }
  }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> changes;
  vp::Clock& clock_;
};

BOOST_FIXTURE_TEST_CASE(a_change_of_frequency_starts_a_new_period, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder recorder{"recorder", clock};
  Changer changer{"changer", clock};
  // In the middle of a period, to stop at an edge, and on again.
  changer.changes = {{25'000, 50'000'000}, {65'000, 0}, {100'000, 200'000'000}};
  run_to(112'000);
  BOOST_TEST(recorder.times == (Times{10'000, 20'000, 45'000, 65'000, 105'000, 110'000}),
             boost::test_tools::per_element());
  BOOST_TEST(recorder.cycles == (Times{1, 2, 3, 4, 5, 6}), boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(a_sleeping_domain_runs_no_edge_and_keeps_its_count, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder recorder{"recorder", clock};
  recorder.sleep_after = 2;
  run_to(75'000);
  BOOST_TEST(clock.edges_run() == 2u);
  BOOST_TEST(clock.cycle() == 7u);
  recorder.sleep_after = 1;
  recorder.wake();
  run_to(175'000);
  BOOST_TEST(recorder.times == (Times{10'000, 20'000, 80'000}), boost::test_tools::per_element());
  BOOST_TEST(recorder.cycles.back() == 8u);
}

BOOST_FIXTURE_TEST_CASE(an_alarm_runs_one_edge_of_a_sleeping_module, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder recorder{"recorder", clock};
  recorder.sleep_after = 1;
  run_to(15'000);
  recorder.wake_at(9);
  run_to(215'000);
  BOOST_TEST(recorder.times == (Times{10'000, 90'000}), boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(an_alarm_may_be_moved_and_taken_back, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder first{"first", clock}, second{"second", clock};
  first.sleep_after = second.sleep_after = 1;
  run_to(15'000);
  first.wake_at(9);
  second.wake_at(6);
  second.wake_at(12);
  first.wake_at(4);
  run_to(45'000);
  first.wake_at(7);
  first.wake_at(vp::Clock::never);
  run_to(215'000);
  BOOST_TEST(first.times == (Times{10'000, 40'000}), boost::test_tools::per_element());
  BOOST_TEST(second.times == (Times{10'000, 120'000}), boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(an_alarm_in_the_past_is_refused, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder recorder{"recorder", clock};
  recorder.sleep_after = 1;
  run_to(55'000);
  BOOST_CHECK_EXCEPTION(recorder.wake_at(4), std::logic_error, [](const std::logic_error& error) {
    return std::string(error.what()) == "recorder: alarm for edge 4, which has run: now is 5";
  });
}

BOOST_FIXTURE_TEST_CASE(batches_change_nothing, Fixture) {
  vp::Clock a{"a", scheduler, 27'000'000}, b{"b", scheduler, 55'000'000};
  Recorder ra{"ra", a}, rb{"rb", b};
  scheduler.set_batch(true);
  run_to(10'000'000);
  for (std::size_t i = 0; i < ra.times.size(); ++i) BOOST_REQUIRE(ra.times[i] == a.time_of(i + 1));
  for (std::size_t i = 0; i < rb.times.size(); ++i) BOOST_REQUIRE(rb.times[i] == b.time_of(i + 1));
  BOOST_TEST(ra.times.size() >= 270u);
}

BOOST_AUTO_TEST_SUITE_END()
