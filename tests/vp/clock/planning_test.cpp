// What moves an edge that was planned: alarms, sleepers that wake, changes of the frequency.
#include "recorder.h"

#include <simulation.h>
#include <boost/test/unit_test.hpp>
#include <functional>

namespace {

using Times = std::vector<std::uint64_t>;

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
};

/// Sleeps from the beginning; notes its edges, and does something on each.
struct Sleeper : Recorder {
  Sleeper(sc_core::sc_module_name name, vp::Clock& clock) : Recorder(name, clock) { sleep(); }
  void edge() override {
    Recorder::edge();
    if (action) action();
  }
  std::function<void()> action;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(planning)

BOOST_FIXTURE_TEST_CASE(a_moved_alarm_leaves_no_edge_behind, Fixture) {
  Sleeper module{"module", clock};
  module.wake_at(5);
  run_to(20'000);
  module.wake_at(9);
  run_to(100'000);
  BOOST_TEST(module.times == Times{90'000}, boost::test_tools::per_element());
  BOOST_TEST(clock.edges_run() == 1u);
}

BOOST_FIXTURE_TEST_CASE(alarms_of_a_time_before_the_simulation_stay_with_their_modules, Fixture) {
  Sleeper source{"source", clock}, sink{"sink", clock};
  source.wake_at(3);
  sink.wake_at(7);
  run_to(100'000);
  BOOST_TEST(source.times == Times{30'000}, boost::test_tools::per_element());
  BOOST_TEST(sink.times == Times{70'000}, boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(alarms_that_coincide_are_each_taken_once, Fixture) {
  Sleeper a{"a", clock}, b{"b", clock}, c{"c", clock};
  for (Sleeper* module : {&a, &b, &c}) module->wake_at(5);
  run_to(60'000);
  a.wake_at(8);
  run_to(200'000);
  BOOST_TEST(a.times == (Times{50'000, 80'000}), boost::test_tools::per_element());
  BOOST_TEST(b.times == Times{50'000}, boost::test_tools::per_element());
  BOOST_TEST(c.times == Times{50'000}, boost::test_tools::per_element());
  BOOST_TEST(clock.edges_run() == 2u);
}

BOOST_FIXTURE_TEST_CASE(a_module_that_wakes_itself_on_its_alarm_goes_on_with_the_next_edge,
                        Fixture) {
  Sleeper module{"module", clock}, other{"other", clock};
  module.action = [&] { module.times.size() < 3 ? module.wake() : module.sleep(); };
  module.wake_at(4);
  run_to(100'000);
  BOOST_TEST(module.times == (Times{40'000, 50'000, 60'000}), boost::test_tools::per_element());
  BOOST_TEST(other.times.empty());
}

BOOST_FIXTURE_TEST_CASE(waking_a_module_passes_over_no_edge_of_this_instant, Fixture) {
  vp::Clock later{"later", scheduler, 100'000'000};
  Sleeper first{"first", clock}, due{"due", later}, woken{"woken", later};
  first.wake_at(5);
  due.wake_at(5);
  first.action = [&] { woken.wake(); };
  woken.action = [&] { woken.sleep(); };
  run_to(100'000);
  BOOST_TEST(due.times == Times{50'000}, boost::test_tools::per_element());
  BOOST_TEST(woken.times.size() == 1u);
}

BOOST_FIXTURE_TEST_CASE(an_edge_that_another_clock_adds_sees_what_stood_before, Fixture) {
  vp::Clock later{"later", scheduler, 100'000'000};
  Sleeper first{"first", clock}, reader{"reader", later};
  vp::Signal<std::uint32_t> value{"value"};
  value.set_writer(first);
  vp::In<std::uint32_t> in{"in", &reader};
  in(value);
  std::vector<std::uint32_t> seen;
  first.action = [&] {
    value = 1;
    reader.wake_at(5);
  };
  reader.action = [&] { seen.push_back(in); };
  first.wake_at(5);
  run_to(100'000);
  BOOST_TEST(reader.times == Times{50'000}, boost::test_tools::per_element());
  BOOST_TEST(seen == std::vector<std::uint32_t>{0}, boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(the_edge_of_an_instant_runs_before_a_process_changes_its_clock, Fixture) {
  Recorder recorder{"recorder", clock};
  sc_core::sc_spawn_options method;
  method.spawn_method();
  method.dont_initialize();
  sc_core::sc_event change("change");
  method.set_sensitivity(&change);
  sc_core::sc_spawn([&] { clock.set_frequency(50'000'000); }, "changer", &method);
  change.notify(vp::from_ps(30'000));  // before the scheduler plans that edge: it comes first
  run_to(75'000);
  BOOST_TEST(recorder.times == (Times{10'000, 20'000, 30'000, 50'000, 70'000}),
             boost::test_tools::per_element());
}

BOOST_FIXTURE_TEST_CASE(listeners_are_told_before_and_after_a_change, Fixture) {
  struct Listener : vp::ClockListener {
    void before_change(vp::Clock& changed) override { note("before", changed); }
    void after_change(vp::Clock& changed) override { note("after", changed); }
    void note(const std::string& when, const vp::Clock& changed) {
      told.push_back(when + " " + std::to_string(changed.frequency_hz()) + " next " +
                     std::to_string(changed.edge_at_or_after(changed.scheduler().now_ps() + 1)));
    }
    std::vector<std::string> told;
  } listener;
  clock.add_listener(listener);
  run_to(33'000);
  clock.set_frequency(50'000'000);
  const std::vector<std::string> expected{
      "before 100000000 next 40000",
      "after 50000000 next " + std::to_string(kit::now_ps() + 20'000)};
  BOOST_TEST(listener.told == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
