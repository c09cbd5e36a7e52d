#include "recorder.h"

#include <simulation.h>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(scheduler)

struct Fixture : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
};

// A chain of registers, made in an order that would let a value fall through in one edge.
BOOST_FIXTURE_TEST_CASE(a_chain_delays_by_one_edge_a_stage_whatever_the_order, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  CountingModule source{"source", clock};
  Register first{"first", clock}, second{"second", clock};
  first.d(source.count);
  second.d(first.q);
  run_to(50'000);  // five edges
  BOOST_TEST(source.count.get() == 5u);
  BOOST_TEST(first.q.get() == 4u);
  BOOST_TEST(second.q.get() == 3u);
}

BOOST_FIXTURE_TEST_CASE(a_ring_of_registers_rotates, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Register a{"a", clock}, b{"b", clock}, c{"c", clock};
  a.d(c.q);
  b.d(a.q);
  c.d(b.q);
  a.q.write(1);
  b.q.write(2);
  c.q.write(3);
  run_to(10'000);
  BOOST_TEST(a.q.get() == 3u);
  BOOST_TEST(b.q.get() == 1u);
  BOOST_TEST(c.q.get() == 2u);
  run_to(30'000);
  BOOST_TEST(a.q.get() == 1u);
}

/// Two registers in one module, each fed by the other.
struct Swap : vp::Clocked {
  Swap(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {
    a_in(a);
    b_in(b);
  }
  void edge() override {
    a = b_in.read();
    b = a_in.read();
  }
  vp::Signal<std::uint32_t> a{"a", 32, 1}, b{"b", 32, 2};
  vp::In<std::uint32_t> a_in{"a_in", this}, b_in{"b_in", this};
};

BOOST_FIXTURE_TEST_CASE(a_module_that_feeds_itself_sees_what_stood_before, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Swap swap{"swap", clock};
  run_to(10'000);
  BOOST_TEST(swap.a.get() == 2u);
  BOOST_TEST(swap.b.get() == 1u);
  run_to(20'000);
  BOOST_TEST(swap.a.get() == 1u);
  BOOST_TEST(swap.b.get() == 2u);
}

// At coincident edges both directions of a crossing sample what stood before.
BOOST_FIXTURE_TEST_CASE(coincident_edges_sample_what_stood_before, Fixture) {
  vp::Clock fast{"fast", scheduler, 100'000'000}, slow{"slow", scheduler, 50'000'000};
  CountingModule fast_source{"fast_source", fast}, slow_source{"slow_source", slow};
  Register to_slow{"to_slow", slow}, to_fast{"to_fast", fast};
  to_slow.d(fast_source.count);
  to_fast.d(slow_source.count);
  run_to(20'000);  // fast edges at 10 and 20 ns, slow edge at 20 ns
  BOOST_TEST(to_slow.q.get() == 1u);
  BOOST_TEST(to_fast.q.get() == 0u);
  run_to(30'000);
  BOOST_TEST(to_fast.q.get() == 1u);
}

/// Writes a signal at 20 ns, when an edge falls, too.
struct Writer : sc_core::sc_module {
  SC_HAS_PROCESS(Writer);
  Writer(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
         vp::Signal<std::uint32_t>& out)
      : sc_module(name), scheduler_(scheduler), out_(out) {
    SC_THREAD(run);
  }
  void run() {
    wait(20, sc_core::SC_NS);
    scheduler_.synchronise();
    out_ = 7;
  }
  vp::ClockScheduler& scheduler_;
  vp::Signal<std::uint32_t>& out_;
};

BOOST_FIXTURE_TEST_CASE(what_a_process_writes_at_an_edge_is_seen_by_the_next_one, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Signal<std::uint32_t> wire{"wire"};
  Register reg{"reg", clock};
  reg.d(wire);
  Writer writer{"writer", scheduler, wire};
  run_to(29'000);
  BOOST_TEST(wire.get() == 7u);
  BOOST_TEST(reg.q.get() == 0u);
  run_to(30'000);
  BOOST_TEST(reg.q.get() == 7u);
}

/// Sleeps until its input changes; notes when it ran.
struct Sleeper : Recorder {
  Sleeper(sc_core::sc_module_name name, vp::Clock& clock) : Recorder(name, clock) { wake_on(d); }
  void edge() override {
    Recorder::edge();
    sleep();
  }
  vp::In<std::uint32_t> d{"d", this};
};

BOOST_FIXTURE_TEST_CASE(a_sleeper_wakes_on_the_edge_after_its_input_changed, Fixture) {
  vp::Clock fast{"fast", scheduler, 100'000'000}, slow{"slow", scheduler, 50'000'000};
  CountingModule source{"source", slow};
  Sleeper same{"same", slow}, other{"other", fast};
  same.d(source.count);
  other.d(source.count);
  run_to(45'000);
  const std::vector<std::uint64_t> expected_same{20'000, 40'000}, expected_other{10'000, 30'000};
  BOOST_TEST(same.times == expected_same, boost::test_tools::per_element());
  BOOST_TEST(other.times == expected_other, boost::test_tools::per_element());
}

/// Notifies a SystemC event from a clock edge.
struct Notifier : vp::Clocked {
  Notifier(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  void edge() override {
    if (clock().cycle() == 5) clock().scheduler().notify(event);
  }
  sc_core::sc_event event;
};

struct EventRecorder : sc_core::sc_module {
  SC_HAS_PROCESS(EventRecorder);
  EventRecorder(sc_core::sc_module_name name, sc_core::sc_event& event) : sc_module(name) {
    SC_METHOD(note);
    sensitive << event;
    dont_initialize();
  }
  void note() { times.push_back(kit::now_ps()); }
  std::vector<std::uint64_t> times;
};

BOOST_FIXTURE_TEST_CASE(an_event_from_inside_a_batch_comes_at_its_edge, Fixture) {
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Notifier notifier{"notifier", clock};
  EventRecorder recorder{"recorder", notifier.event};
  scheduler.set_batch(true);
  run_to(1'000'000);
  const std::vector<std::uint64_t> expected{50'000};
  BOOST_TEST(recorder.times == expected, boost::test_tools::per_element());
}

struct Instants : vp::InstantObserver {
  void end_of_instant(std::uint64_t ps) override { times.push_back(ps); }
  std::vector<std::uint64_t> times;
};

BOOST_FIXTURE_TEST_CASE(observers_see_each_instant_once, Fixture) {
  vp::Clock fast{"fast", scheduler, 100'000'000}, slow{"slow", scheduler, 50'000'000};
  CountingModule a{"a", fast}, b{"b", slow};
  Instants instants;
  scheduler.add_observer(instants);
  run_to(30'000);
  const std::vector<std::uint64_t> expected{10'000, 20'000, 30'000};
  BOOST_TEST(instants.times == expected, boost::test_tools::per_element());
  scheduler.remove_observer(instants);
  run_to(60'000);
  BOOST_TEST(instants.times.size() == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
