// Buffers of streams: FIFO, register slice, width converter.
#include <simulation.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <xilinx/axis_buffer/axis_buffer.h>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "input_error.h"

namespace {

struct Line : kit::Simulation {
  explicit Line(const xilinx::AxisBufferBuild& build) : buffer("buffer", clock, build) {
    source.m_axis(in);
    buffer.s_axis(in);
    buffer.m_axis(out);
    sink.s_axis(out);
  }
  void run(unsigned clocks) {
    sc_core::sc_start(sc_core::sc_time(10 * clocks, sc_core::SC_NS));
    scheduler.synchronise();
  }
  /// The bytes of each packet that came.
  std::vector<std::string> packets() const {
    std::vector<std::string> list(1);
    for (const auto& beat : sink.beats) {
      for (unsigned lane = 0; lane < 4; ++lane)
        if (beat.keep >> lane & 1) list.back() += static_cast<char>(beat.data >> 8 * lane);
      if (beat.last) list.emplace_back();
    }
    list.pop_back();
    return list;
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::AxiStream in{"in"}, out{"out"};
  vp::StreamSource source{"source", clock};
  xilinx::AxisBuffer buffer;
  vp::StreamSink sink{"sink", clock};
};

constexpr std::uint32_t abcd = 0x64636261, efgh = 0x68676665, ijkl = 0x6C6B6A69;

}  // namespace

BOOST_AUTO_TEST_SUITE(axis_buffer)

BOOST_AUTO_TEST_CASE(a_slice_passes_a_beat_a_clock) {
  Line line({4, 4, 4, 1});
  for (std::uint32_t i = 0; i < 100; ++i) line.source.send(i, i == 99, i == 50 ? 0x3 : 0xF);
  line.run(150);
  BOOST_TEST_REQUIRE(line.sink.beats.size() == 100u);
  for (std::uint32_t i = 0; i < 100; ++i) {
    BOOST_TEST(line.sink.beats[i].data == i);
    BOOST_TEST(line.sink.beats[i].keep == (i == 50 ? 0x3 : 0xF));
    BOOST_TEST(line.sink.beats[i].cycle == line.sink.beats[0].cycle + i);
  }
  BOOST_TEST(line.sink.beats[99].last);
}

BOOST_AUTO_TEST_CASE(latency_counts_clocks) {
  Line early({4, 4, 16, 1});
  early.source.send(abcd, true);
  early.run(20);
  Line late({4, 4, 16, 3});
  late.source.send(abcd, true);
  late.run(20);
  BOOST_TEST_REQUIRE(early.sink.beats.size() == 1u);
  BOOST_TEST_REQUIRE(late.sink.beats.size() == 1u);
  BOOST_TEST(late.sink.beats[0].cycle == early.sink.beats[0].cycle + 2);
}

BOOST_AUTO_TEST_CASE(a_full_fifo_holds_its_master) {
  Line line({4, 4, 8, 1});
  line.sink.ready_on = [](std::uint64_t) { return false; };
  for (std::uint32_t i = 0; i < 30; ++i) line.source.send(i, false);
  line.run(100);
  BOOST_TEST(line.in.beats.get() == 8u);
  line.sink.ready_on = [](std::uint64_t cycle) { return cycle % 3 == 0; };
  line.sink.wake();
  line.run(150);
  BOOST_TEST_REQUIRE(line.sink.beats.size() == 30u);
  for (std::uint32_t i = 0; i < 30; ++i) BOOST_TEST(line.sink.beats[i].data == i);
}

BOOST_AUTO_TEST_CASE(bytes_keep_their_order_at_any_pair_of_widths) {
  for (std::uint32_t in = 1; in <= 4; ++in) {
    for (std::uint32_t out = 1; out <= 4; ++out) {
      Line line({in, out, 16, 1});
      std::string sent;
      for (char c = 'a'; c < 'a' + 11;) {  // a packet of 11 bytes
        std::uint32_t data = 0;
        std::uint8_t keep = 0;
        for (unsigned lane = 0; lane < in && c < 'a' + 11; ++lane, ++c) {
          data |= static_cast<std::uint32_t>(c) << 8 * lane;
          keep = static_cast<std::uint8_t>(keep | 1u << lane);
          sent += c;
        }
        line.source.send(data, c == 'a' + 11, keep);
      }
      line.source.send('z', true, 1);
      line.run(100);
      const std::vector<std::string> expected{sent, "z"};
      BOOST_TEST(line.packets() == expected, in << " to " << out << " bytes");
      const std::size_t beats = (11 + out - 1) / out + 1;
      BOOST_TEST(line.sink.beats.size() == beats, in << " to " << out << " bytes");
    }
  }
}

BOOST_AUTO_TEST_CASE(a_last_beat_without_bytes_ends_its_packet) {
  Line line({4, 1, 16, 1});
  line.source.send(abcd, false);
  line.source.send(efgh, true, 0);
  line.source.send(ijkl, true, 0x1);
  line.run(50);
  const std::vector<std::string> expected{"abcd", "i"};
  BOOST_TEST(line.packets() == expected);
}

BOOST_AUTO_TEST_CASE(widths_that_are_not_modelled) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 1'000'000);
  BOOST_TEST(input_error([&] {
               xilinx::AxisBuffer wide("wide", clock, {129, 4, 16, 1});
             }) == "wide: streams of 129 bytes are not modelled, those of 1 to 128 are");
}

BOOST_AUTO_TEST_SUITE_END()
