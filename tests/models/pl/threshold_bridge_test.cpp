// FIFO, packets and overflow of the threshold bridge, at its ports.
#include <pl/axi_threshold_bridge/axi_threshold_bridge.h>
#include <boost/test/unit_test.hpp>

#include "pipeline.h"

namespace {

/// The module alone, with a slave behind it. Every method works through whole system clocks.
struct Bridge : kit::Simulation {
  explicit Bridge(const std::vector<std::string>& assignments = {},
                  const pl::Geometry& geometry = {})
      : settings(assignments),
        made(pl::AxiThresholdBridge::models().list().front().make("axi_threshold_bridge",
                                                                  {clk, geometry})) {
    ip.ena(ena);
    ip.rst(rst);
    ip.thresh_in(thresh_in);
    ip.thresh_data(thresh_data);
    ip.m(link);
    sink.s(link);
    sink.accept(true);
    sc_core::sc_start(vp::from_ps(5'000));
    pulse_rst();
  }
  void clocks(unsigned n) { sc_core::sc_start(vp::from_ps(n * 10'000u)); }
  void pulse_rst() {
    rst = true;
    thresh_in = false;
    clocks(1);
    rst = false;
  }
  void word(std::uint32_t data) {
    thresh_data = data;
    thresh_in = !thresh_in;
    clocks(1);
  }
  std::uint32_t overflow() const { return ip.bridge_overflow; }

  harness::Settings settings;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> ena{"ena", 1, true}, rst{"rst"}, thresh_in{"thresh_in"};
  vp::Signal<std::uint32_t> thresh_data{"thresh_data"};
  vp::AxiStream link{"link"};
  std::unique_ptr<pl::AxiThresholdBridge> made;
  pl::AxiThresholdBridge& ip = *made;
  harness::StreamSink sink{"sink", clk};
};

void check_packets(const std::vector<harness::StreamSink::Beat>& beats, unsigned length) {
  for (std::size_t i = 0; i < beats.size(); ++i) {
    BOOST_REQUIRE_EQUAL(beats[i].last, i % length == length - 1);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(threshold_bridge)

BOOST_AUTO_TEST_CASE(a_word_passes_through_in_two_clocks_and_one_for_the_beat) {
  Bridge b;
  const std::uint64_t start = kit::now_ps() + 5'000;  // the edge that samples the toggle
  b.word(0x1234'5678);
  BOOST_TEST(!b.link.tvalid.get());
  BOOST_TEST(b.ip.fifo_count.get() == 1u);
  b.clocks(1);
  BOOST_TEST(b.link.tvalid.get());
  BOOST_TEST(b.link.tdata.get() == 0x1234'5678u);
  BOOST_TEST(b.ip.fifo_count.get() == 0u);
  b.clocks(1);
  BOOST_TEST(!b.link.tvalid.get());
  BOOST_REQUIRE(b.sink.beats.size() == 1u);
  BOOST_TEST(b.sink.beats[0].ps == start + 20'000);
}

BOOST_AUTO_TEST_CASE(every_32nd_word_is_the_last_of_its_packet) {
  Bridge b;
  for (std::uint32_t i = 0; i < 100; ++i) b.word(i);
  b.clocks(5);
  BOOST_TEST(b.sink.beats.size() == 100u);
  check_packets(b.sink.beats, 32);
  for (std::uint32_t i = 0; i < 100; ++i) BOOST_TEST(b.sink.beats[i].data == i);
  BOOST_TEST(b.link.packets.get() == 3u);
}

// Without `ena` nothing is taken or offered; a word that is offered passes once, as TREADY says.
BOOST_AUTO_TEST_CASE(each_word_passes_once_while_ena_comes_and_goes) {
  Bridge b;
  for (std::uint32_t i = 0; i < 96; ++i) {
    b.word(i);
    b.ena = i % 3 == 0;
    b.sink.accept(i % 5 != 0);
    b.clocks(i % 4);
    b.ena = true;
    b.clocks(1);
  }
  b.sink.accept(true);
  b.clocks(70);
  BOOST_TEST(b.overflow() == 0u);
  BOOST_REQUIRE(b.sink.beats.size() == 96u);
  for (std::uint32_t i = 0; i < 96; ++i) BOOST_TEST(b.sink.beats[i].data == i);
  check_packets(b.sink.beats, 32);
}

BOOST_AUTO_TEST_CASE(sixty_four_words_wait_besides_the_output_register) {
  Bridge b;
  b.sink.accept(false);
  for (std::uint32_t i = 0; i < 65; ++i) b.word(i);
  b.clocks(2);
  BOOST_TEST(b.ip.fifo_count.get() == 64u);
  BOOST_TEST(b.overflow() == 0u);
  for (std::uint32_t i = 65; i < 70; ++i) b.word(i);
  BOOST_TEST(b.overflow() == 5u);
  BOOST_TEST(b.ip.fifo_count.get() == 64u);
  BOOST_TEST(b.link.tdata.get() == 0u);  // stands while it waits
  BOOST_TEST(b.link.tvalid.get());
  b.sink.accept(true);
  b.clocks(70);
  BOOST_REQUIRE(b.sink.beats.size() == 65u);  // the newest were dropped
  for (std::uint32_t i = 0; i < 65; ++i) BOOST_TEST(b.sink.beats[i].data == i);
  check_packets(b.sink.beats, 32);
  b.word(100);
  b.clocks(3);
  BOOST_TEST(b.sink.beats.back().data == 100u);
  BOOST_TEST(b.overflow() == 5u);  // sticky
}

BOOST_AUTO_TEST_CASE(a_full_fifo_takes_a_word_on_the_clock_after_one_has_left) {
  Bridge b;
  b.sink.accept(false);
  for (std::uint32_t i = 0; i < 66; ++i) b.word(i);
  BOOST_TEST(b.overflow() == 1u);
  b.sink.accept(true);
  b.word(66);  // full when this clock began, although a word leaves on it
  BOOST_TEST(b.overflow() == 2u);
  b.word(67);
  BOOST_TEST(b.overflow() == 2u);
}

BOOST_AUTO_TEST_CASE(a_slave_that_hesitates_loses_nothing_and_sees_stable_data) {
  Bridge b;
  harness::Random random(1);
  for (std::uint32_t i = 0; i < 300; ++i) {
    b.sink.accept(random.below(3) != 0);
    if (i % 3 == 0) {
      b.word(i);
    } else {
      b.clocks(1);
    }
  }
  b.sink.accept(true);
  b.clocks(100);
  BOOST_REQUIRE(b.sink.beats.size() == 100u);
  for (std::uint32_t i = 0; i < 100; ++i) BOOST_TEST(b.sink.beats[i].data == 3 * i);
  check_packets(b.sink.beats, 32);
  BOOST_TEST(b.link.stalls.get() > 0u);
}

BOOST_AUTO_TEST_CASE(rst_empties_it_and_starts_a_new_packet) {
  Bridge b;
  b.sink.accept(false);
  for (std::uint32_t i = 0; i < 80; ++i) b.word(i);
  BOOST_TEST(b.overflow() == 15u);
  b.pulse_rst();
  BOOST_TEST(b.overflow() == 0u);
  BOOST_TEST(b.ip.fifo_count.get() == 0u);
  BOOST_TEST(!b.link.tvalid.get());
  b.sink.accept(true);
  for (std::uint32_t i = 0; i < 40; ++i) b.word(1000 + i);
  b.clocks(3);
  BOOST_TEST(b.sink.beats.size() == 40u);
  BOOST_TEST(b.sink.beats[0].data == 1000u);
  check_packets(b.sink.beats, 32);
}

BOOST_AUTO_TEST_CASE(depth_and_packet_length_are_parameters) {
  Bridge b({"axi_threshold_bridge.fifo_depth=4"}, {640, 480, 8});
  b.sink.accept(false);
  for (std::uint32_t i = 0; i < 10; ++i) b.word(i);
  BOOST_TEST(b.overflow() == 5u);
  b.sink.accept(true);
  b.clocks(10);
  for (std::uint32_t i = 0; i < 19; ++i) b.word(i);
  b.clocks(3);
  BOOST_TEST(b.sink.beats.size() == 24u);
  check_packets(b.sink.beats, 8);
}

BOOST_AUTO_TEST_CASE(a_frame_is_300_packets_of_its_binary_words) {
  harness::Pipeline pipeline;
  pipeline.load(harness::rectangles(640, 480, 100, 3));
  const std::vector<harness::Word> words = pipeline.run_frame();
  BOOST_TEST(pipeline.binary_link.packets.get() == 300u);
  check_packets(pipeline.sink.beats, 32);
  std::size_t i = 0;
  for (const harness::Word& word : words) {
    if (word.kind == 'T') BOOST_REQUIRE_EQUAL(pipeline.sink.beats[i++].data, word.first);
  }
  BOOST_TEST(i == pipeline.sink.beats.size());
}

BOOST_AUTO_TEST_CASE(a_slave_that_stalls_within_a_frame_costs_whole_words) {
  harness::Pipeline pipeline({}, harness::frame_size(128, 64));
  pipeline.load(harness::noise(128, 64, 32));
  pipeline.reset();
  pipeline.raise_ena();
  pipeline.run_to_clock(32 * 50);
  pipeline.sink.accept(false);
  pipeline.run_to_clock(32 * 150);
  pipeline.sink.accept(true);
  pipeline.run_to_clock(pipeline.clocks_of_a_frame());
  BOOST_TEST(pipeline.pl.axi_threshold_bridge.bridge_overflow.get() == 100u - 65u);
  BOOST_TEST(pipeline.sink.beats.size() == 256u - 35u);
  check_packets(pipeline.sink.beats, 32);
}

BOOST_AUTO_TEST_SUITE_END()
