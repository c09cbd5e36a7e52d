// The complete platform at other clocks than the thesis': the same features, at other times.
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "platform_run.h"

using namespace integration;
using platform::facts::UnitReport;

namespace {

/// A picture with few words and one with many.
const std::vector<std::string> pictures{"roll30", "demo"};

constexpr double pixels = 640 * 480;
/// Pixel clocks from a frame's start to its end word.
constexpr double end_word_clocks = pixels + 17;

const PlatformRun& usual() {
  static const PlatformRun run = run_scenes(pictures);
  return run;
}

/// Any frequency, whether a PLL gives it or not.
Settings exactly(const std::string& clock, const std::string& frequency) {
  return {{clock + ".frequency", frequency}, {"clocks", "exact"}};
}
Settings pixel_clock(const std::string& frequency) {
  return exactly("ps.fclk_clk1", frequency);
}
Settings system_clock(const std::string& frequency) {
  return exactly("ps.fclk_clk0", frequency);
}
Settings cpu_clock(const std::string& frequency) {
  return exactly("ps.cpu_clk", frequency);
}

bool some_warning_has(const UnitReport& frame, const std::string& text) {
  return std::any_of(frame.warnings.begin(), frame.warnings.end(), [&](const std::string& warning) {
    return warning.find(text) != std::string::npos;
  });
}

/// Same words, same marker, same corners and pose, nothing lost.
void check_same_finds(const UnitReport& frame, const UnitReport& expected) {
  BOOST_TEST(overflows(frame) == 0u);
  BOOST_TEST(frame.warnings.empty());
  BOOST_TEST(platform::marker_frame(frame).threshold.value() ==
             platform::marker_frame(expected).threshold.value());
  BOOST_TEST(features(frame) == features(expected), boost::test_tools::per_element());
  BOOST_TEST_REQUIRE(platform::marker_frame(frame).markers.size() == 1u);
  BOOST_TEST(platform::marker_frame(frame).markers[0].id ==
             platform::marker_frame(expected).markers[0].id);
  BOOST_TEST(platform::marker_frame(frame).markers[0].rotation ==
             platform::marker_frame(expected).markers[0].rotation);
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(platform::marker_frame(frame).markers[0].corners_px[i].x ==
               platform::marker_frame(expected).markers[0].corners_px[i].x);
    BOOST_TEST(platform::marker_frame(frame).markers[0].corners_px[i].y ==
               platform::marker_frame(expected).markers[0].corners_px[i].y);
  }
  BOOST_TEST((platform::marker_frame(frame).markers[0].pose.translation ==
              platform::marker_frame(expected).markers[0].pose.translation));
  BOOST_TEST((platform::marker_frame(frame).markers[0].pose.rotation ==
              platform::marker_frame(expected).markers[0].pose.rotation));
}

/// The end word is read within 3 us: an interrupt handler and a few reads of the feature register
/// may lie before.
void check_feature_extraction(const UnitReport& frame, double pixel_mhz) {
  const double end_word_us = end_word_clocks / pixel_mhz;
  const double time = stage_us(frame, "feature_extraction");
  BOOST_TEST(time > end_word_us);
  BOOST_TEST(time < end_word_us + 3);
}

void check_same(const Settings& settings, double pixel_mhz) {
  BOOST_TEST_CONTEXT(settings.front().first << " = " << settings.front().second) {
    const PlatformRun run = run_scenes(pictures, settings);
    BOOST_TEST_REQUIRE(run.frames.size() == usual().frames.size());
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      check_same_finds(run.frames[i], usual().frames[i]);
      check_feature_extraction(run.frames[i], pixel_mhz);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(clocks)

BOOST_AUTO_TEST_CASE(feature_extraction_scales_with_the_pixel_clock) {
  check_same(pixel_clock("50 MHz"), 50);
  check_same(pixel_clock("10 MHz"), 10);
  check_same(pixel_clock("40 MHz"), 40);
  check_same(pixel_clock("74.25 MHz"), 74.25);
  check_same(pixel_clock("100 MHz"), 100);
}

BOOST_AUTO_TEST_CASE(clocks_that_are_made_are_those_that_a_chip_has) {
  check_same({{"ps.fclk_clk1.frequency", "55 MHz"}}, 1000.0 / 18);
  check_same({{"ps.fclk_clk1.frequency", "74.25 MHz"}}, 1000.0 / 13);
  check_same({{"ps.fclk_clk1.frequency", "55 MHz"}, {"ps.ethernet", "false"}}, 1600.0 / 29);
}

BOOST_AUTO_TEST_CASE(no_result_depends_on_the_system_clock) {
  for (const char* frequency : {"50 MHz", "75 MHz", "99.999999 MHz", "150 MHz", "200 MHz"}) {
    check_same(system_clock(frequency), 50);
  }
}

BOOST_AUTO_TEST_CASE(a_slower_processor_finds_the_same_later) {
  check_same(cpu_clock("333 MHz"), 50);
  const PlatformRun slow = run_scenes(pictures, cpu_clock("333.333333 MHz"));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    // Half the clock, twice the time. Only stalls of the memory stay as they are.
    BOOST_TEST(stage_us(slow.frames[i], "pose") == 2 * stage_us(usual().frames[i], "pose"),
               boost::test_tools::tolerance(0.03));
    BOOST_TEST(stage_us(slow.frames[i], "identification") >
               1.5 * stage_us(usual().frames[i], "identification"));
  }
}

BOOST_AUTO_TEST_CASE(quantum_changes_nothing) {
  for (const char* quantum : {"0 ps", "1 us", "10 ms"}) {
    const PlatformRun run = run_scenes(pictures, {{"ps.cpu.quantum", quantum}});
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      check_same_finds(run.frames[i], usual().frames[i]);
      BOOST_TEST(run.frames[i].start_ps == usual().frames[i].start_ps);
      BOOST_TEST(run.frames[i].end_ps == usual().frames[i].end_ps);
    }
  }
}

/// 1 MHz under pixels of 50 MHz: words are overwritten before they are seen, and the binary image
/// stays incomplete.
BOOST_AUTO_TEST_CASE(a_system_clock_that_is_far_too_slow_is_told_and_ends) {
  const PlatformRun run = run_scenes(pictures, system_clock("1 MHz"));
  BOOST_TEST_REQUIRE(run.frames.size() == pictures.size());
  for (const UnitReport& frame : run.frames) {
    BOOST_TEST(frame.counts["crossing_overflow"] > 0u);
    BOOST_TEST(frame.counts["bridge_overflow"] > 0u);
    BOOST_TEST(platform::marker_frame(frame).markers.empty());
    BOOST_TEST(some_warning_has(frame, "the system clock is too slow"));
    BOOST_TEST(some_warning_has(frame, "binary image timed out"));
  }
}

BOOST_AUTO_TEST_CASE(an_upload_that_takes_too_long_is_told_and_ends) {
  const PlatformRun run = run_scenes(pictures, system_clock("100 kHz"));
  BOOST_TEST_REQUIRE(run.frames.size() == pictures.size());
  for (const UnitReport& frame : run.frames) {
    BOOST_TEST(platform::marker_frame(frame).markers.empty());
    BOOST_TEST(some_warning_has(frame, "upload timed out"));
  }
}

BOOST_AUTO_TEST_CASE(a_processor_that_is_far_too_slow_is_told_and_ends) {
  const PlatformRun run = run_scenes(pictures, cpu_clock("1 MHz"));
  BOOST_TEST_REQUIRE(run.frames.size() == pictures.size());
  for (const UnitReport& frame : run.frames) {
    BOOST_TEST(frame.counts["bridge_overflow"] > 0u);
    BOOST_TEST(some_warning_has(frame, "DMA 1 was not armed again in time"));
  }
}

BOOST_AUTO_TEST_CASE(each_full_buffer_is_told_and_what_fits_is_right) {
  const PlatformRun labels = run_scenes(pictures, {{"pl.blob_detection.label_count", "4"}});
  BOOST_TEST(labels.frames.back().counts["label_overflow"] > 0u);
  BOOST_TEST(some_warning_has(labels.frames.back(), "pl.blob_detection.label_count is too small"));

  const PlatformRun words = run_scenes(
      pictures, {{"pl.feature_packaging.buffer_depth", "2"}, {"ps.m_axi_gp0.read_time", "10 us"}});
  BOOST_TEST(words.frames.back().counts["feature_overflow"] > 0u);
  BOOST_TEST(some_warning_has(words.frames.back(), "a buffer of pl.feature_packaging was full"));
  const std::vector<std::string> all = features(usual().frames.back());
  for (const std::string& word : features(words.frames.back())) {
    BOOST_TEST((std::find(all.begin(), all.end(), word) != all.end()), word << " is new");
  }

  const PlatformRun bridge = run_scenes(pictures, {{"pl.axi_threshold_bridge.fifo_depth", "1"}});
  BOOST_TEST(bridge.frames.back().counts["bridge_overflow"] > 0u);
  BOOST_TEST(features(bridge.frames.back()) == all, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
