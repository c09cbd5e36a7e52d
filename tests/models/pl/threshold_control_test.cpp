// When the threshold changes: wr_thresh, the end of a frame, rst, the system reset.
#include <boost/test/unit_test.hpp>

#include "control_kit.h"

using namespace control_kit;

BOOST_AUTO_TEST_SUITE(threshold_control)

BOOST_AUTO_TEST_CASE(wr_thresh_loads_on_every_pixel_clock_while_it_is_high) {
  Ready p;
  p.monitor.start();
  harness::ChangeLog threshold(p.pl.global_threshold.active_threshold, p.scheduler);
  p.run_to_clock(10);
  p.set_threshold(55);
  p.run_to_clock(12);
  p.set_threshold(77);
  p.run_to_clock(15);
  p.set_threshold(99, 0);  // the level without wr_thresh
  p.run_to_clock(30);
  BOOST_TEST(
      threshold.changes == (Changes{{p.monitor.time_of(11), 55}, {p.monitor.time_of(13), 77}}),
      boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_threshold_loaded_within_a_frame_decides_from_the_next_pixel_on) {
  Ready p;
  p.load(Image(pixels, 100));
  p.raise_ena();
  // Pixel i is sampled at clock 3 + i. Loaded at clock 3 + 39, so pixel 40 is the first bright one.
  p.run_to_clock(3 + 38);
  p.set_threshold(99);
  p.finish();
  const std::vector<Word> words = p.words();
  BOOST_REQUIRE(words.size() > 3u);
  BOOST_TEST(words[0].first == 0xFFFF'FFFFu);
  BOOST_TEST(words[1].first == 0x0000'00FFu);
  BOOST_TEST(words[2].first == 0u);
}

BOOST_AUTO_TEST_CASE(wr_thresh_wins_over_the_threshold_of_the_frame) {
  struct Case {
    std::uint64_t from, to;  ///< wr_thresh is sampled high from clock `from` to clock `to`
    unsigned expected;
  };
  Ready plain;
  plain.raise_ena();
  plain.finish();
  const unsigned adaptive = plain.threshold();
  BOOST_TEST(adaptive != 55u);
  const Case cases[] = {{pixels, pixels + 2, adaptive},
                        {pixels, pixels + 3, 55},
                        {pixels + 3, pixels + 3, 55},
                        {pixels + 4, pixels + 4, 55}};
  for (const Case& c : cases) {
    BOOST_TEST_CONTEXT("clock " << c.from << " to " << c.to) {
      Ready p;
      p.raise_ena();
      p.run_to_clock(100);
      p.control(0);
      p.run_to_clock(c.from - 1);
      p.set_threshold(55);
      p.run_to_clock(c.to);
      p.control(0);
      p.finish();
      BOOST_TEST(p.threshold() == c.expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(each_clock_changes_the_threshold_once) {
  Ready p;
  harness::ChangeLog threshold(p.pl.global_threshold.active_threshold, p.scheduler);
  p.set_threshold(55);
  p.run_for(100'000);
  p.monitor.start();
  p.set_threshold(55, control_packet::wr_thresh | control_packet::ena);
  p.finish();
  BOOST_TEST(threshold.changes.size() == 1u);
}

BOOST_AUTO_TEST_CASE(wr_thresh_is_ignored_during_rst) {
  Ready p;
  p.set_threshold(55, control_packet::wr_thresh | control_packet::rst);
  p.run_for(1'000'000);
  BOOST_TEST(p.threshold() == 127u);
  p.set_threshold(55, control_packet::wr_thresh);
  p.run_for(100'000);
  BOOST_TEST(p.threshold() == 55u);
}

BOOST_AUTO_TEST_CASE(the_threshold_survives_rst_and_returns_to_127_with_a_system_reset) {
  Ready p;
  p.raise_ena();
  p.finish();
  const unsigned adaptive = p.threshold();
  BOOST_TEST(adaptive != 127u);
  p.control(0);
  p.reset();
  BOOST_TEST(p.threshold() == adaptive);
  p.driver.system_reset(true);
  p.run_for(100'000);
  BOOST_TEST(p.threshold() == 127u);
  p.set_threshold(55);
  p.run_for(100'000);
  BOOST_TEST(p.threshold() == 127u);
  p.control(0);
  p.driver.system_reset(false);
  p.run_for(100'000);
  BOOST_TEST(p.threshold() == 127u);
}

// The 7000 pixels of 20 before rst outnumber the 4096 of 60 after it.
BOOST_AUTO_TEST_CASE(rst_within_a_frame_forgets_its_histogram) {
  Ready p;
  p.load(Image(pixels, 20));
  p.raise_ena();
  p.run_to_clock(7000);
  p.control(0);
  p.reset();
  Image image(pixels, 60);
  harness::draw(image, width, 0, height / 2, width - 1, height - 1, 200);
  p.load(image);
  p.raise_ena();
  p.finish();
  BOOST_TEST(p.threshold() == (60u + 200u) / 2);
}

BOOST_AUTO_TEST_SUITE_END()
