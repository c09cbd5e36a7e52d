// A clock behind a gate: edges of its source or none, counted on their own, to the picosecond.
#include "recorder.h"

#include <vp/gated_clock.h>
#include <vp/systemc_pins.h>

#include <simulation.h>
#include <boost/test/unit_test.hpp>
#include <map>

using Times = std::vector<std::uint64_t>;

namespace {

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock source{"source", scheduler, 27'000'000};  // 37037.037 ps
  vp::GatedClock gated{"gated", source};
};

/// Works the gate on edges of the source.
struct Gate : vp::Clocked {
  Gate(sc_core::sc_module_name name, vp::Clock& source, vp::GatedClock& gated)
      : Clocked(name, source), gated(gated) {}
  void edge() override {
    const auto at = plan.find(clock().cycle());
    if (at != plan.end()) gated.open(at->second);
  }
  vp::GatedClock& gated;
  std::map<std::uint64_t, bool> plan;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(gated_clocks)

BOOST_FIXTURE_TEST_CASE(edges_are_those_of_the_source_while_it_is_open, Fixture) {
  Gate gate{"gate", source, gated};
  gate.plan = {{2, false}, {5, true}, {8, false}, {9, true}};
  Recorder recorder{"recorder", gated};
  run_to(source.time_of(12));
  Times expected;
  for (const std::uint64_t n : {1, 2, 6, 7, 8, 10, 11, 12}) expected.push_back(source.time_of(n));
  BOOST_TEST(recorder.times == expected, boost::test_tools::per_element());
  BOOST_TEST(recorder.cycles == (Times{1, 2, 3, 4, 5, 6, 7, 8}), boost::test_tools::per_element());
  BOOST_TEST(gated.cycle() == 8u);
  BOOST_TEST(gated.time_of(9) == source.time_of(13));
  BOOST_TEST(gated.edge_at_or_after(source.time_of(12) + 1) == source.time_of(13));
  BOOST_TEST(&gated.source() == &source);
  BOOST_TEST(&source.source() == &source);
}

BOOST_FIXTURE_TEST_CASE(a_closed_gate_stops_the_clock_and_not_its_frequency, Fixture) {
  Gate gate{"gate", source, gated};
  gate.plan = {{3, false}};
  Recorder recorder{"recorder", gated};
  run_to(source.time_of(100));
  BOOST_TEST(recorder.times.size() == 3u);
  BOOST_TEST(gated.cycle() == 3u);
  BOOST_TEST(gated.edge_at_or_after(kit::now_ps()) == vp::Clock::never);
  BOOST_TEST(gated.time_of(4) == vp::Clock::never);
  BOOST_TEST(gated.frequency_hz() == 27'000'000u);
  BOOST_TEST(gated.duration_ps(2) == 74'074u);
}

// Alarms count edges of the gated clock; who sleeps past the gate misses none.
BOOST_FIXTURE_TEST_CASE(an_alarm_waits_for_the_gate, Fixture) {
  struct Sleeper : vp::Clocked {
    using Clocked::Clocked;
    void edge() override {
      times.push_back(clock().scheduler().now_ps());
      sleep();
      if (clock().cycle() == 1) wake_at(6);
    }
    Times times;
  };
  Gate gate{"gate", source, gated};
  gate.plan = {{3, false}, {13, true}};
  Sleeper sleeper{"sleeper", gated};
  run_to(source.time_of(30));
  BOOST_TEST(sleeper.times == (Times{source.time_of(1), source.time_of(16)}),
             boost::test_tools::per_element());
}

/// A register behind the gate samples what stood before the edge, and one before it, too.
BOOST_FIXTURE_TEST_CASE(registers_on_both_sides_sample_what_stood_before, Fixture) {
  CountingModule counter{"counter", source};
  Register behind{"behind", gated};
  Register back{"back", source};
  Gate gate{"gate", source, gated};
  gate.plan = {{4, false}, {7, true}};
  behind.d(counter.count);
  back.d(behind.q);
  run_to(source.time_of(4));
  BOOST_TEST(behind.q.get() == 3u, "edge 4 is there: the gate closed on it");
  BOOST_TEST(back.q.get() == 2u);
  run_to(source.time_of(7));
  BOOST_TEST(behind.q.get() == 3u);
  BOOST_TEST(back.q.get() == 3u);
  run_to(source.time_of(9));
  BOOST_TEST(behind.q.get() == 8u);
  BOOST_TEST(back.q.get() == 7u);
}

BOOST_FIXTURE_TEST_CASE(it_follows_a_change_of_the_source, Fixture) {
  Gate gate{"gate", source, gated};
  gate.plan = {{4, false}, {8, true}};
  Recorder recorder{"recorder", gated};
  run_to(100'000);  // two edges
  source.set_frequency(10'000'000);
  BOOST_TEST(gated.frequency_hz() == 10'000'000u);
  run_to(310'000);  // edges 3 and 4
  BOOST_TEST(recorder.times == (Times{37'037, 74'074, 200'001, 300'001}),
             boost::test_tools::per_element());
  source.set_frequency(50'000'000);  // while it is closed
  BOOST_TEST(gated.frequency_hz() == 50'000'000u);
  run_to(420'000);  // edges 5 to 9 from 330 001 on
  BOOST_TEST(recorder.times.back() == 410'001u, "edge 9");
  BOOST_TEST(gated.cycle() == 5u);
  source.set_frequency(0);
  run_to(1'000'000);
  BOOST_TEST(gated.cycle() == 5u);
}

// The pin of a foreign module rises with the edges that there are, and is high for half a period.
BOOST_FIXTURE_TEST_CASE(the_pin_follows_the_gate, Fixture) {
  struct Watch : sc_core::sc_module {
    SC_HAS_PROCESS(Watch);
    Watch(sc_core::sc_module_name name, const sc_core::sc_signal_in_if<bool>& pin)
        : sc_module(name), pin(pin) {
      SC_METHOD(note);
      sensitive << pin.value_changed_event();
      dont_initialize();
    }
    void note() { (pin.read() ? rises : falls).push_back(kit::now_ps()); }
    const sc_core::sc_signal_in_if<bool>& pin;
    Times rises, falls;
  };
  Gate gate{"gate", source, gated};
  gate.plan = {{2, false}, {5, true}, {7, false}, {8, true}};
  Recorder recorder{"recorder", gated};
  Watch watch{"watch", gated.pin()};
  run_to(source.time_of(10));
  BOOST_TEST(watch.rises == recorder.times, boost::test_tools::per_element());
  BOOST_TEST(watch.falls.size() + 1 == watch.rises.size());
  for (std::size_t i = 0; i < watch.falls.size(); ++i)
    BOOST_TEST(watch.falls[i] - watch.rises[i] == 18'518u, "half a period after rise " << i);
}

// Against the plain count, whatever the gate does.
BOOST_FIXTURE_TEST_CASE(any_sequence_of_the_gate, Fixture) {
  Gate gate{"gate", source, gated};
  Recorder recorder{"recorder", gated}, all{"all", source};
  std::uint32_t chance = 7;
  for (std::uint64_t n = 1; n < 3'000; ++n) {
    chance = chance * 1'664'525 + 1'013'904'223;
    if (chance >> 28 < 5) gate.plan[n] = (chance >> 20 & 1) != 0;
  }
  scheduler.set_batch(true);
  run_to(source.time_of(3'000));
  Times expected;
  bool open = true;
  for (std::uint64_t n = 1; n <= 3'000; ++n) {
    if (open) expected.push_back(all.times[n - 1]);
    if (const auto at = gate.plan.find(n); at != gate.plan.end()) open = at->second;
  }
  recorder.times.resize(expected.size());  // a batch runs further
  BOOST_TEST(recorder.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
