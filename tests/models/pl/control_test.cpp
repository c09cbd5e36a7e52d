// rst, ena and the system reset at any time, also in the middle of a frame.
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "control_kit.h"

using namespace control_kit;

BOOST_AUTO_TEST_SUITE(control)

BOOST_AUTO_TEST_CASE(the_control_packet_is_split_at_once) {
  Ready p;
  const auto& block = p.pl.control_block;
  p.driver.gpio_io_o = 0xFFFF'0000;
  BOOST_TEST((!block.ena && !block.rst_out && !block.wr_en && !block.wr_thresh));
  BOOST_TEST(unsigned{block.ready} == 0u);
  p.driver.gpio_io_o = 1u << 0;
  BOOST_TEST((block.ena && !block.rst_out && !block.wr_en && !block.wr_thresh));
  p.driver.gpio_io_o = 1u << 1;
  BOOST_TEST((!block.ena && block.rst_out && !block.wr_en && !block.wr_thresh));
  p.driver.gpio_io_o = 1u << 4;
  BOOST_TEST((!block.ena && !block.rst_out && block.wr_en && !block.wr_thresh));
  p.driver.gpio_io_o = 1u << 5;
  BOOST_TEST((!block.ena && !block.rst_out && !block.wr_en && block.wr_thresh));
  p.driver.gpio_io_o = 2u << 2;
  BOOST_TEST(unsigned{block.ready} == 2u);
  p.driver.gpio_io_o = 0xA5u << 8;
  BOOST_TEST(unsigned{block.threshold} == 0xA5u);
  p.driver.gpio_io_o = 0;
  p.driver.peripheral_reset = true;
  BOOST_TEST(block.rst_out.get());
}

BOOST_AUTO_TEST_CASE(rst_within_a_frame_leaves_nothing_behind) {
  const std::vector<Word> expected = fresh_words();
  for (const std::uint64_t clock : {1u, 2u, 3u, 40u, 999u, 5000u, 8191u, 8193u, 8194u, 8200u}) {
    BOOST_TEST_CONTEXT("rst at clock " << clock) {
      Ready p;
      p.raise_ena();
      p.run_to_clock(clock);
      p.control(control_packet::rst);
      p.run_for(1'000'000);
      BOOST_TEST(!p.pl.sensor_input.frame_ena.get());
      BOOST_TEST(!p.pl.frame_status.busy.get());
      BOOST_TEST(p.pl.feature_packaging.feature.get() == 0u);
      BOOST_TEST(p.pl.feature_packaging.corner_count.get() == 0u);
      BOOST_TEST(p.pl.feature_packaging.blob_count.get() == 0u);
      BOOST_TEST(p.pl.axi_threshold_bridge.fifo_count.get() == 0u);
      BOOST_TEST(!p.binary_link.tvalid.get());
      p.set_threshold(127);  // as for the fresh one, whether the frame had ended or not
      p.run_for(100'000);
      p.control(0);
      p.run_for(100'000);
      p.sink.beats.clear();
      p.raise_ena();
      p.finish();
      BOOST_TEST(harness::first_difference(p.words(), expected) == "");
      BOOST_TEST(p.sink.beats.size() == pixels / 32);
      BOOST_TEST(p.sink.beats.back().last);
    }
  }
}

/// Corners and binary words: blobs leave in the order of their labels, which rst puts back.
std::vector<Word> without_blobs(std::vector<Word> words) {
  words.erase(
      std::remove_if(words.begin(), words.end(), [](const Word& word) { return word.kind == 'B'; }),
      words.end());
  return words;
}

BOOST_AUTO_TEST_CASE(a_frame_after_another_needs_no_rst_between) {
  Pipeline pipeline({}, harness::frame_size(width, height));
  pipeline.load(frame_image());
  pipeline.run_frame();
  const std::vector<Word> second = pipeline.run_frame();  // with the threshold of the first
  Ready p;
  p.raise_ena();
  p.finish();
  p.control(0);
  p.run_for(100'000);
  p.raise_ena();
  p.finish();
  BOOST_TEST(harness::first_difference(without_blobs(p.words()), without_blobs(second)) == "");
  BOOST_TEST(harness::count(p.words(), 'B') == harness::count(second, 'B'));
  std::uint32_t number = 0;  // counts from 0 again
  for (const Word& word : p.words()) {
    if (word.kind == 'B') BOOST_TEST((word.first >> 19 & 0x7FF) == number++);
  }
}

BOOST_AUTO_TEST_CASE(ena_low_within_a_frame_has_no_effect) {
  const std::vector<Word> expected = fresh_words();
  for (const std::uint64_t low_after : {1u, 2u, 100u, 8191u, 8192u, 8193u}) {
    BOOST_TEST_CONTEXT("low after clock " << low_after) {
      Ready p;
      p.raise_ena();
      p.run_to_clock(low_after);
      p.control(0);
      p.finish();
      BOOST_TEST(harness::first_difference(p.words(), expected) == "");
      BOOST_TEST(p.frame_ena.changes.size() == 2u);
    }
  }
}

BOOST_AUTO_TEST_CASE(ena_held_high_starts_one_frame_only) {
  const std::vector<Word> expected = fresh_words();
  Ready p;
  p.raise_ena();
  p.run_to_clock(3 * pixels);
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
  BOOST_TEST(p.frame_ena.changes.size() == 2u);
}

BOOST_AUTO_TEST_CASE(a_rise_of_ena_within_a_frame_is_ignored) {
  const std::vector<Word> expected = fresh_words();
  Ready p;
  p.raise_ena();
  for (const std::uint64_t clock : {1u, 2u, 3u, 500u, 4000u, 8180u, 8191u}) {
    p.run_to_clock(clock);
    p.control(0);
    p.run_to_clock(clock + 1);
    p.control(control_packet::ena);  // sampled at clock + 2
  }
  p.run_to_clock(pixels + 1000);
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
  BOOST_TEST(p.frame_ena.changes.size() == 2u);
}

BOOST_AUTO_TEST_CASE(the_first_rise_that_starts_a_frame_again_is_the_one_after_its_last_pixel) {
  for (const std::uint64_t sampled_at : {pixels + 1, pixels + 2}) {
    BOOST_TEST_CONTEXT("rise sampled at clock " << sampled_at) {
      Ready p;
      p.raise_ena();
      p.run_to_clock(100);
      p.control(0);
      p.run_to_clock(sampled_at - 1);
      p.control(control_packet::ena);
      p.run_to_clock(pixels + 100);
      BOOST_TEST(p.pl.sensor_input.frame_ena.get() == (sampled_at == pixels + 2));
    }
  }
}

BOOST_AUTO_TEST_CASE(ena_still_high_after_rst_counts_as_a_rise) {
  const std::vector<Word> expected = fresh_words();
  Ready p;
  p.raise_ena();
  p.run_to_clock(3000);
  p.control(control_packet::ena | control_packet::rst);
  p.run_for(1'000'000);
  p.frame_ena.changes.clear();
  p.monitor.start();  // the first edge without rst is clock 1
  p.control(control_packet::ena);
  p.finish();
  BOOST_TEST(p.frame_ena.changes ==
                 (Changes{{p.monitor.time_of(2), 1}, {p.monitor.time_of(pixels + 2), 0}}),
             boost::test_tools::per_element());
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
}

BOOST_AUTO_TEST_CASE(ena_lowered_before_rst_starts_nothing) {
  Ready p;
  p.raise_ena();
  p.run_to_clock(3000);
  p.control(0);
  p.control(control_packet::rst);
  p.run_for(1'000'000);
  p.frame_ena.changes.clear();
  p.control(0);
  p.run_for(1'000'000);
  BOOST_TEST(p.frame_ena.changes.empty());
}

BOOST_AUTO_TEST_CASE(a_system_reset_within_a_frame_is_a_reset_of_everything) {
  const std::vector<Word> expected = fresh_words();
  Ready p;
  p.raise_ena();
  p.run_to_clock(4000);
  p.driver.system_reset(true);
  p.run_for(200'000);
  BOOST_TEST(!p.pl.sensor_input.frame_ena.get());
  BOOST_TEST(p.pl.feature_packaging.feature.get() == 0u);
  p.control(0);
  p.driver.system_reset(false);
  p.run_for(200'000);
  p.raise_ena();
  p.finish();
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
}

BOOST_AUTO_TEST_SUITE_END()
