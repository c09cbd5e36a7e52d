#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include <simulation.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>

namespace {

struct Bench : kit::Simulation {
  Bench() {
    source.m_axis(link);
    sink.s_axis(link);
  }
  void run_cycles(unsigned n) { sc_core::sc_start(sc_core::sc_time(10 * n, sc_core::SC_NS)); }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::AxiStream link{"link"};
  vp::StreamSource source{"source", clock};
  vp::StreamSink sink{"sink", clock};
};

/// The same with the modules made in the other order: the scheduler has to break the ring
/// elsewhere.
struct ReverseBench : kit::Simulation {
  ReverseBench() {
    source.m_axis(link);
    sink.s_axis(link);
  }
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::StreamSink sink{"sink", clock};
  vp::StreamSource source{"source", clock};
  vp::AxiStream link{"link"};
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(one_beat_a_clock_while_both_are_willing, Bench) {
  for (unsigned i = 0; i < 8; ++i) source.send(100 + i, i % 4 == 3);
  run_cycles(20);
  BOOST_REQUIRE(sink.beats.size() == 8u);
  // Edge 1 offers the first beat and raises tready, edge 2 passes it.
  for (unsigned i = 0; i < 8; ++i) {
    BOOST_TEST(sink.beats[i].cycle == 2 + i);
    BOOST_TEST(sink.beats[i].data == 100 + i);
    BOOST_TEST(sink.beats[i].last == (i % 4 == 3));
  }
  BOOST_TEST(link.beats == 8u);
  BOOST_TEST(link.packets == 2u);
  BOOST_TEST(link.stalls == 0u);
  BOOST_TEST(source.sent == 8u);
}

BOOST_FIXTURE_TEST_CASE(order_of_construction_does_not_matter, ReverseBench) {
  for (unsigned i = 0; i < 8; ++i) source.send(100 + i, false);
  sc_core::sc_start(sc_core::sc_time(200, sc_core::SC_NS));
  BOOST_REQUIRE(sink.beats.size() == 8u);
  for (unsigned i = 0; i < 8; ++i) BOOST_TEST(sink.beats[i].cycle == 2 + i);
  BOOST_TEST(source.sent == 8u);
}

BOOST_FIXTURE_TEST_CASE(back_pressure_loses_nothing_and_is_counted, Bench) {
  sink.ready_on = [](std::uint64_t cycle) { return cycle % 3 == 0; };
  for (unsigned i = 0; i < 5; ++i) source.send(i, false);
  run_cycles(40);
  BOOST_REQUIRE(sink.beats.size() == 5u);
  // tready is a register: high after edges 3, 6, 9 …, so beats pass on edges 4, 7, 10 …
  for (unsigned i = 0; i < 5; ++i) {
    BOOST_TEST(sink.beats[i].cycle == 4 + 3 * i);
    BOOST_TEST(sink.beats[i].data == i);
  }
  BOOST_TEST(link.stalls == 2u + 4 * 2);
}

BOOST_FIXTURE_TEST_CASE(a_sleeping_slave_still_counts_stalls, Bench) {
  sink.sleep_until = 12;
  source.send(7, true);
  run_cycles(20);
  BOOST_REQUIRE(sink.beats.size() == 1u);
  BOOST_TEST(sink.beats[0].cycle == 13u);
  BOOST_TEST(link.stalls == 11u, "edges 2 to 12");
}

BOOST_FIXTURE_TEST_CASE(a_link_has_one_end_of_each_kind, Bench) {
  vp::StreamSource other_source("other_source", clock);
  vp::StreamSink other_sink("other_sink", clock);
  BOOST_CHECK_THROW(other_source.m_axis(link), std::logic_error);
  BOOST_CHECK_THROW(other_sink.s_axis(link), std::logic_error);
}
