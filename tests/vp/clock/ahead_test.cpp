// A process that lets time pass itself, ahead of SystemC's.
#include "recorder.h"

#include <simulation.h>
#include <boost/test/unit_test.hpp>
#include <functional>

namespace {

/// A thread that runs a script.
struct Script : sc_core::sc_module {
  SC_HAS_PROCESS(Script);
  Script(sc_core::sc_module_name name, std::function<void()> script)
      : sc_module(name), script_(std::move(script)) {
    SC_THREAD(run);
  }
  void run() { script_(); }
  std::function<void()> script_;
};

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Recorder recorder{"recorder", clock};
};

using Times = std::vector<std::uint64_t>;

}  // namespace

BOOST_FIXTURE_TEST_SUITE(ahead, Fixture)

BOOST_AUTO_TEST_CASE(edges_run_and_systemc_stays_behind) {
  scheduler.set_lookahead(1'000'000);
  std::uint64_t systemc = 1, now = 0;
  Script script{"script", [&] {
                  scheduler.pass_until(35'000);
                  systemc = sc_core::sc_time_stamp().value();
                  now = scheduler.now_ps();
                  recorder.sleep();
                }};
  run_to(100'000);
  BOOST_TEST(now == 35'000u);
  BOOST_TEST(systemc == 0u);
  BOOST_TEST(recorder.times == (Times{10'000, 20'000, 30'000}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(without_lookahead_it_waits_like_others) {
  std::uint64_t systemc = 0;
  Script script{"script", [&] {
                  scheduler.pass_until(35'000);
                  systemc = sc_core::sc_time_stamp().value();
                  recorder.sleep();
                }};
  run_to(100'000);
  BOOST_TEST(systemc == 35'000u);
  BOOST_TEST(recorder.times == (Times{10'000, 20'000, 30'000}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(another_process_is_not_overtaken) {
  scheduler.set_lookahead(1'000'000);
  std::vector<std::pair<char, std::uint64_t>> order;
  Script ahead{"ahead", [&] {
                 for (std::uint64_t ps : {15'000u, 25'000u, 45'000u}) {
                   scheduler.pass_until(ps);
                   order.emplace_back('a', scheduler.now_ps());
                 }
                 recorder.sleep();
               }};
  Script other{"other", [&] {
                 sc_core::wait(20, sc_core::SC_NS);
                 order.emplace_back('o', scheduler.now_ps());
                 sc_core::wait(10, sc_core::SC_NS);
                 order.emplace_back('o', scheduler.now_ps());
               }};
  run_to(100'000);
  const std::vector<std::pair<char, std::uint64_t>> expected{
      {'a', 15'000}, {'o', 20'000}, {'a', 25'000}, {'o', 30'000}, {'a', 45'000}};
  BOOST_TEST((order == expected));
}

BOOST_AUTO_TEST_CASE(a_condition_ends_it_at_its_instant) {
  for (std::uint64_t lookahead : {0u, 5'000u, 1'000'000u}) {
    Fixture f;
    f.scheduler.set_lookahead(lookahead);
    std::uint64_t ended = 0;
    const auto third_edge = [](const void* context) {
      return static_cast<const Recorder*>(context)->times.size() >= 3;
    };
    Script script{"script", [&] {
                    f.scheduler.pass_until(90'000, third_edge, &f.recorder);
                    ended = f.scheduler.now_ps();
                    f.recorder.sleep();
                  }};
    // Who makes the condition true while the kernel runs says so.
    Script teller{"teller", [&] {
                    for (int i = 0; i < 12; ++i) {
                      sc_core::wait(5, sc_core::SC_NS);
                      f.scheduler.synchronise();
                      f.scheduler.check_condition();
                    }
                  }};
    run_to(100'000);
    BOOST_TEST(ended == 30'000u);
  }
}

/// Notifies a SystemC event on an edge.
struct Notifier : vp::Clocked {
  Notifier(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  void edge() override {
    if (clock().cycle() == 3) clock().scheduler().notify(event);
  }
  sc_core::sc_event event;
};

BOOST_AUTO_TEST_CASE(an_event_from_an_edge_is_served_at_its_time) {
  scheduler.set_lookahead(1'000'000);
  Notifier notifier{"notifier", clock};
  std::vector<std::pair<char, std::uint64_t>> order;
  Script ahead{"ahead", [&] {
                 for (std::uint64_t ps : {25'000u, 55'000u}) {
                   scheduler.pass_until(ps);
                   order.emplace_back('a', scheduler.now_ps());
                 }
               }};
  Script woken{"woken", [&] {
                 sc_core::wait(notifier.event);
                 order.emplace_back('w', scheduler.now_ps());
               }};
  run_to(100'000);
  const std::vector<std::pair<char, std::uint64_t>> expected{
      {'a', 25'000}, {'w', 30'000}, {'a', 55'000}};
  BOOST_TEST((order == expected));
}

BOOST_AUTO_TEST_CASE(an_event_behind_its_back_is_served_when_told) {
  scheduler.set_lookahead(1'000'000);
  sc_core::sc_event event;
  std::vector<std::pair<char, std::uint64_t>> order;
  Script ahead{"ahead", [&] {
                 sc_core::wait(sc_core::SC_ZERO_TIME);  // the other one waits
                 scheduler.pass_until(5'000);
                 event.notify(vp::from_ps(20'000));
                 scheduler.forget_horizon();
                 scheduler.pass_until(45'000);
                 order.emplace_back('a', scheduler.now_ps());
                 recorder.sleep();
               }};
  Script woken{"woken", [&] {
                 sc_core::wait(event);
                 order.emplace_back('w', scheduler.now_ps());
               }};
  run_to(100'000);
  const std::vector<std::pair<char, std::uint64_t>> expected{{'w', 20'000}, {'a', 45'000}};
  BOOST_TEST((order == expected));
}

BOOST_AUTO_TEST_CASE(running_ahead_stops_before_systemc_has_its_turn) {
  scheduler.set_lookahead(1'000'000);
  Times ends;
  const auto third_edge = [](const void* context) {
    return static_cast<const Recorder*>(context)->times.size() == 3;
  };
  Script ahead{"ahead", [&] {
                 sc_core::wait(sc_core::SC_ZERO_TIME);
                 BOOST_TEST(scheduler.run_ahead_until(90'000, third_edge, &recorder));
                 ends.push_back(scheduler.now_ps());
                 BOOST_TEST(!scheduler.run_ahead_until(90'000, third_edge, &recorder));
                 ends.push_back(scheduler.now_ps());
                 BOOST_TEST(!scheduler.run_ahead_until(90'000, third_edge, &recorder));
                 ends.push_back(scheduler.now_ps());
                 recorder.sleep();
               }};
  Script other{"other", [] { sc_core::wait(65, sc_core::SC_NS); }};
  run_to(100'000);
  BOOST_TEST(ends == (Times{30'000, 64'999, 64'999}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(rejoining_lets_systemc_catch_up) {
  scheduler.set_lookahead(1'000'000);
  std::uint64_t systemc = 0;
  Script script{"script", [&] {
                  scheduler.pass_until(33'000);
                  scheduler.rejoin();
                  systemc = sc_core::sc_time_stamp().value();
                  recorder.sleep();
                }};
  run_to(100'000);
  BOOST_TEST(systemc == 33'000u);
}

BOOST_AUTO_TEST_SUITE_END()
