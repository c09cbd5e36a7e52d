// Streams and words between clocks, and bits of a stream in other places.
#include <simulation.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <xilinx/axis_clock_fifo/axis_clock_fifo.h>
#include <xilinx/axis_fan/axis_fan.h>
#include <xilinx/axis_subset_converter/axis_subset_converter.h>
#include <xilinx/fifo_generator/fifo_generator.h>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "input_error.h"

namespace {

struct Clocks : kit::Simulation {
  Clocks() { reports.redirect(text); }
  static void run_ns(unsigned ns) { sc_core::sc_start(sc_core::sc_time(ns, sc_core::SC_NS)); }

  std::ostringstream text;
  vp::ReportRouter reports;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock slow{"slow", scheduler, 50'000'000};
  vp::Clock fast{"fast", scheduler, 100'000'000};
};

struct Crossing : Clocks {
  Crossing(bool to_fast, std::uint32_t depth)
      : from(to_fast ? slow : fast),
        to(to_fast ? fast : slow),
        source("source", from),
        fifo("fifo", from, to, {4, depth}),
        sink("sink", to) {
    source.m_axis(in);
    fifo.s_axis(in);
    fifo.m_axis()(out);
    sink.s_axis(out);
  }
  vp::Clock &from, &to;
  vp::AxiStream in{"in"}, out{"out"};
  vp::StreamSource source;
  xilinx::AxisClockFifo fifo;
  vp::StreamSink sink;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(stream_parts)

BOOST_AUTO_TEST_CASE(beats_keep_their_order_between_clocks) {
  for (const bool to_fast : {true, false}) {
    for (const std::uint32_t depth : {2u, 16u}) {
      Crossing line(to_fast, depth);
      for (std::uint32_t i = 0; i < 100; ++i) line.source.send(i, i % 10 == 9, i == 50 ? 3 : 0xF);
      line.run_ns(20'000);
      BOOST_TEST_REQUIRE(line.sink.beats.size() == 100u);
      for (std::uint32_t i = 0; i < 100; ++i) {
        BOOST_TEST(line.sink.beats[i].data == i);
        BOOST_TEST(line.sink.beats[i].last == (i % 10 == 9));
        BOOST_TEST(line.sink.beats[i].keep == (i == 50 ? 3 : 0xF));
      }
    }
  }
}

// It is offered on slow edge 1 (20 ns), in the FIFO on edge 2 or 3, and three fast edges later on
// offer.
BOOST_AUTO_TEST_CASE(a_beat_takes_the_clocks_of_the_pointers) {
  Crossing line(true, 16);
  line.source.send(7, true);
  line.run_ns(1'000);
  BOOST_TEST_REQUIRE(line.sink.beats.size() == 1u);
  const std::uint64_t pass_ps = line.fast.time_of(line.sink.beats[0].cycle);
  // TREADY of the FIFO is high from edge 1 on, so the beat is in it on edge 2, at 40 ns: fast edge
  // 4. It shows on edge 7, and passes on edge 8.
  BOOST_TEST(line.sink.beats[0].cycle == 8u);
  BOOST_TEST(pass_ps == 80'000u);
}

BOOST_AUTO_TEST_CASE(a_full_fifo_holds_its_master) {
  Crossing line(false, 8);
  line.sink.ready_on = [](std::uint64_t) { return false; };
  for (std::uint32_t i = 0; i < 30; ++i) line.source.send(i, false);
  line.run_ns(2'000);
  // Eight in the memory, and one on offer.
  BOOST_TEST(line.in.beats.get() == 9u);
  line.sink.ready_on = [](std::uint64_t cycle) { return cycle % 3 == 0; };
  line.sink.wake();
  line.run_ns(4'000);
  BOOST_TEST_REQUIRE(line.sink.beats.size() == 30u);
  for (std::uint32_t i = 0; i < 30; ++i) BOOST_TEST(line.sink.beats[i].data == i);
}

// Every second fast edge coincides with a slow one.
BOOST_AUTO_TEST_CASE(the_order_in_which_clocks_are_made_changes_nothing) {
  std::vector<std::uint64_t> passed[2];
  for (const bool slow_first : {true, false}) {
    kit::Simulation simulation;
    vp::ClockScheduler scheduler("scheduler");
    std::unique_ptr<vp::Clock> slow, fast;
    const auto make_slow = [&] {
      slow = std::make_unique<vp::Clock>("slow", scheduler, 50'000'000);
    };
    if (slow_first) make_slow();
    fast = std::make_unique<vp::Clock>("fast", scheduler, 100'000'000);
    if (!slow_first) make_slow();
    vp::AxiStream in("in"), middle("middle"), out("out");
    vp::StreamSource source("source", *fast);
    xilinx::AxisClockFifo down("down", *fast, *slow, {4, 4}), up("up", *slow, *fast, {4, 4});
    vp::StreamSink sink("sink", *fast);
    sink.ready_on = [](std::uint64_t cycle) { return cycle % 7 < 3; };
    source.m_axis(in);
    down.s_axis(in);
    down.m_axis()(middle);
    up.s_axis(middle);
    up.m_axis()(out);
    sink.s_axis(out);
    for (std::uint32_t i = 0; i < 60; ++i) source.send(i, i % 4 == 3);
    Clocks::run_ns(5'000);
    for (const auto& beat : sink.beats) passed[slow_first ? 0 : 1].push_back(beat.cycle);
  }
  BOOST_TEST(passed[0].size() == 60u);
  BOOST_TEST(passed[0] == passed[1], boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(expressions_say_where_bits_come_from) {
  using From = xilinx::RemapBit::From;
  const auto bits = xilinx::parse_remap("{tuser[0], 4'b0_101 ,tdata[9:8],2'h2}", "x");
  BOOST_TEST_REQUIRE(bits.size() == 9u);
  BOOST_TEST((bits[0].from == From::zero && bits[1].from == From::one));
  BOOST_TEST((bits[2].from == From::data && bits[2].bit == 8));
  BOOST_TEST((bits[3].from == From::data && bits[3].bit == 9));
  BOOST_TEST((bits[4].from == From::one && bits[5].from == From::zero));
  BOOST_TEST((bits[6].from == From::one && bits[7].from == From::zero));
  BOOST_TEST((bits[8].from == From::user && bits[8].bit == 0));
  for (const char* wrong : {"", "tdata[", "tdata[1:2]", "data[3:0]", "8'q0", "2'b111", "'h0",
                            "tdata[99999]", "tlast,,tlast", "3'hG"}) {
    const std::string said = input_error([&] { xilinx::parse_remap(wrong, "x"); });
    BOOST_TEST(said.find("neither bits of a signal") != std::string::npos, wrong);
  }
}

BOOST_AUTO_TEST_CASE(a_subset_converter_moves_bits_and_ends_packets) {
  Clocks clocks;
  xilinx::AxisSubsetConverterBuild build;
  build.out.bytes = 2;
  build.data = "tdata[7:0],tdata[31:24]";
  build.default_last = 3;
  vp::StreamSource source("source", clocks.fast);
  xilinx::AxisSubsetConverter converter("converter", clocks.fast, build);
  vp::StreamSink sink("sink", clocks.fast);
  vp::AxiStream in("in"), out("out");
  source.m_axis(in);
  converter.s_axis(in);
  converter.m_axis(out);
  sink.s_axis(out);
  for (std::uint32_t i = 0; i < 9; ++i) source.send(0xAB000000 | i, i == 1);
  Clocks::run_ns(300);
  BOOST_TEST_REQUIRE(sink.beats.size() == 9u);
  for (std::uint32_t i = 0; i < 9; ++i) {
    BOOST_TEST(sink.beats[i].data == (i << 8 | 0xAB));
    BOOST_TEST(sink.beats[i].last == (i % 3 == 2));
    BOOST_TEST(sink.beats[i].cycle == sink.beats[0].cycle + i);  // a beat a clock
  }
}

BOOST_AUTO_TEST_CASE(copies_of_a_beat_go_out_and_come_together) {
  Clocks clocks;
  vp::StreamSource source("source", clocks.fast);
  xilinx::AxisBroadcaster fan("fan", clocks.fast, 4, 2, 0, {"", "tdata[23:16],8'hEE"});
  xilinx::AxisCombiner join("join", clocks.fast, 2, 2, 0, 1);
  vp::StreamSink sink("sink", clocks.fast);
  vp::AxiStream in("in"), low("low"), high("high"), out("out");
  source.m_axis(in);
  fan.s_axis(in);
  fan.m_axis(0)(low);
  fan.m_axis(1)(high);
  join.s_axis(0)(low);
  join.s_axis(1)(high);
  join.m_axis(out);
  sink.s_axis(out);
  sink.ready_on = [](std::uint64_t cycle) { return cycle < 20 || cycle % 3 != 0; };
  for (std::uint32_t i = 0; i < 20; ++i) source.send(0x00550000 | i << 16 | i, i % 5 == 4);
  Clocks::run_ns(1'000);
  BOOST_TEST(in.beats.get() == 20u);
  BOOST_TEST_REQUIRE(sink.beats.size() == 20u);
  for (std::uint32_t i = 0; i < 20; ++i) {
    if (i < 10) BOOST_TEST(sink.beats[i].cycle == sink.beats[0].cycle + i);  // a beat a clock
    const std::uint32_t middle = (0x55 | i) & 0xFF;
    BOOST_TEST(sink.beats[i].data == (middle << 24 | 0x00EE0000 | i));
    BOOST_TEST(sink.beats[i].last == (i % 5 == 4));
  }
}

// One output that never takes its copy holds the others behind theirs.
BOOST_AUTO_TEST_CASE(a_broadcaster_waits_for_all_outputs) {
  Clocks clocks;
  vp::StreamSource source("source", clocks.fast);
  xilinx::AxisBroadcaster fan("fan", clocks.fast, 4, 4, 0, {"", ""});
  vp::StreamSink one("one", clocks.fast), two("two", clocks.fast);
  vp::AxiStream in("in"), to_one("to_one"), to_two("to_two");
  source.m_axis(in);
  fan.s_axis(in);
  fan.m_axis(0)(to_one);
  fan.m_axis(1)(to_two);
  one.s_axis(to_one);
  two.s_axis(to_two);
  two.ready_on = [](std::uint64_t) { return false; };
  for (std::uint32_t i = 0; i < 5; ++i) source.send(i, false);
  Clocks::run_ns(300);
  BOOST_TEST(in.beats.get() == 2u);
  BOOST_TEST(one.beats.size() == 2u);
  BOOST_TEST(two.beats.empty());
  two.ready_on = [](std::uint64_t) { return true; };
  two.wake();
  Clocks::run_ns(300);
  BOOST_TEST_REQUIRE(two.beats.size() == 5u);
  BOOST_TEST(one.beats.size() == 5u);
}

BOOST_AUTO_TEST_CASE(words_come_out_in_order_and_flags_say_so) {
  for (const bool falls_through : {false, true}) {
    Clocks c;
    xilinx::FifoGeneratorBuild build;
    build.depth = 16;
    build.first_word_fall_through = falls_through;
    xilinx::FifoGenerator fifo("fifo", c.fast, c.fast, build);
    vp::Signal<bool> write("write"), read("read"), reset("reset");
    vp::Signal<std::uint64_t> data("data", 8);
    fifo.wr_en(write);
    fifo.reader().rd_en(read);
    fifo.din(data);
    fifo.reset(reset);
    const auto clock = [&] {
      Clocks::run_ns(10);
      c.scheduler.synchronise();
    };
    clock();
    BOOST_TEST(fifo.reader().empty.get());
    write = true;
    data = 11;
    clock();
    data = 22;
    clock();
    write = false;
    clock();
    BOOST_TEST(!fifo.reader().empty.get());
    BOOST_TEST(fifo.reader().dout.get() == (falls_through ? 11u : 0u));
    read = true;
    clock();
    BOOST_TEST(fifo.reader().dout.get() == (falls_through ? 22u : 11u));
    clock();
    BOOST_TEST(fifo.reader().dout.get() == 22u);
    BOOST_TEST(fifo.reader().empty.get());
    clock();
    BOOST_TEST(fifo.reader().underflow.get());
    read = false;
    write = true;
    for (int i = 0; i < 20; ++i) clock();
    BOOST_TEST(fifo.full.get());
    BOOST_TEST(fifo.lost.get() == (falls_through ? 2u : 4u));
    BOOST_TEST(fifo.overflow.get());
    BOOST_TEST(c.text.str().find("written while it was full") != std::string::npos);
    write = false;
    reset = true;
    clock();
    reset = false;
    clock();
    BOOST_TEST(fifo.reader().empty.get());
    BOOST_TEST(!fifo.full.get());
  }
}

BOOST_AUTO_TEST_CASE(words_cross_clocks) {
  Clocks c;
  xilinx::FifoGeneratorBuild build;
  build.depth = 16;
  build.common_clock = false;
  xilinx::FifoGenerator fifo("fifo", c.slow, c.fast, build);
  vp::Signal<bool> write("write");
  vp::Signal<std::uint64_t> data("data", 8, 9);
  fifo.wr_en(write);
  fifo.din(data);
  Clocks::run_ns(20);
  c.scheduler.synchronise();
  write = true;
  Clocks::run_ns(20);  // taken on slow edge 2, at 40 ns
  c.scheduler.synchronise();
  write = false;
  Clocks::run_ns(20);
  c.scheduler.synchronise();
  BOOST_TEST(fifo.reader().empty.get());  // fast edge 6
  Clocks::run_ns(10);
  c.scheduler.synchronise();
  BOOST_TEST(!fifo.reader().empty.get());  // three edges behind the fourth
  write = true;
  Clocks::run_ns(400);
  BOOST_TEST(fifo.writes.get() == 15u);
}

BOOST_AUTO_TEST_CASE(widths_that_no_model_has) {
  Clocks c;
  BOOST_TEST(input_error([&] {
               xilinx::AxisClockFifo f("f", c.slow, c.fast, {129, 16});
             }).find("streams of 129 bytes are not modelled") != std::string::npos);
  BOOST_TEST(input_error([&] {
               xilinx::AxisBroadcaster f("h", c.slow, 4, 2, 0, {"tdata[7:0]"});
             }).find("the remap must have 16 bits") != std::string::npos);
  BOOST_TEST(input_error([&] {
               xilinx::AxisCombiner f("i", c.slow, 1, 4, 0, 0);
             }).find("two inputs or more") != std::string::npos);
  xilinx::FifoGeneratorBuild wide;
  wide.width = 65;
  BOOST_TEST(input_error([&] {
               xilinx::FifoGenerator f("g", c.slow, c.slow, wide);
             }).find("words of 65 bits are not modelled") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
