// ThresholdFrame against ThresholdCore: the same words, the same next threshold.
#include <pl/common/simd_target.h>
#include <pl/global_threshold/core.h>

#include <boost/test/unit_test.hpp>

#include "pictures.h"
#include "reference.h"

using harness::Random;

namespace {

std::uint8_t reference_next(const harness::Image& image) {
  pl::ThresholdCore core;
  for (std::uint8_t pixel : image) core.push(pixel);
  core.end_frame();
  return core.threshold();
}

/// Several frames without a reset between: each takes the threshold of the one before.
void check(const Picture& picture) {
  BOOST_TEST_CONTEXT(picture.name << ' ' << picture.geometry.width << 'x'
                                  << picture.geometry.height) {
    pl::ThresholdFrame frame(picture.geometry);
    BOOST_TEST(frame.threshold() == 127);
    for (int i = 0; i < 2; ++i) {
      frame.begin(picture.image.data());
      const std::uint8_t threshold = frame.threshold();
      frame.advance(picture.geometry.pixels());
      BOOST_TEST((frame.words() == pack(picture.image, threshold)));
      BOOST_TEST(frame.end() == reference_next(picture.image));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(threshold_frame)

BOOST_AUTO_TEST_CASE(scenes_give_the_words_of_the_core) {
  for (const Picture& picture : scenes()) check(picture);
}

BOOST_AUTO_TEST_CASE(every_size_and_simd_target_gives_the_words_of_the_core) {
  for (const std::string& target : pl::simd_targets()) {
    BOOST_TEST_CONTEXT(target) {
      BOOST_REQUIRE(pl::use_simd_target(target));
      for (const pl::Geometry& size : small_sizes()) {
        for (const Picture& picture : patterns(size)) check(picture);
      }
    }
  }
  pl::use_simd_target("");
}

BOOST_AUTO_TEST_CASE(every_simd_target_compares_every_level_with_every_threshold) {
  harness::Image levels;
  for (unsigned i = 0; i < 1024; ++i) levels.push_back(static_cast<std::uint8_t>(i * 37));
  for (const std::string& target : pl::simd_targets()) {
    BOOST_REQUIRE(pl::use_simd_target(target));
    pl::ThresholdFrame frame({32, 32});
    for (unsigned threshold = 0; threshold < 256; ++threshold) {
      frame.set_threshold(static_cast<std::uint8_t>(threshold));
      frame.begin(levels.data());
      frame.advance(1024);
      BOOST_TEST((frame.words() == pack(levels, static_cast<std::uint8_t>(threshold))));
    }
  }
  pl::use_simd_target("");
}

BOOST_AUTO_TEST_CASE(of_equal_counts_the_first_that_was_reached_is_the_peak) {
  const auto peaks = [](std::vector<std::uint8_t> pixels) {
    const pl::Peaks p = pl::find_peaks(pixels.data(), pixels.size());
    return std::pair<int, int>(p.dark, p.bright);
  };
  BOOST_TEST((peaks({}) == std::pair(0, 255)));
  BOOST_TEST((peaks({9, 8, 8, 9}) == std::pair(8, 255)));
  BOOST_TEST((peaks({9, 8, 9, 8}) == std::pair(9, 255)));
  BOOST_TEST((peaks({200, 130, 200, 130, 127, 128, 128, 0}) == std::pair(127, 200)));
  BOOST_TEST((peaks({5, 4, 3, 2, 1, 0}) == std::pair(5, 255)));
}

BOOST_AUTO_TEST_CASE(ties_of_many_levels_give_the_peaks_of_the_core) {
  Random random(3);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::uint8_t> pixels(random.below(200));
    const std::uint32_t levels = 1 + random.below(256);
    for (std::uint8_t& p : pixels)
      p = static_cast<std::uint8_t>(256 - levels + random.below(levels));
    pl::ThresholdCore core;
    for (std::uint8_t p : pixels) core.push(p);
    const pl::Peaks peaks = pl::find_peaks(pixels.data(), pixels.size());
    BOOST_TEST(peaks.dark == core.dark_peak());
    BOOST_TEST(peaks.bright == core.bright_peak());
  }
}

// Software may load a threshold at any clock, and what was binarised ahead is taken back.
BOOST_AUTO_TEST_CASE(the_threshold_may_change_between_any_two_pixels) {
  const pl::Geometry size{96, 32};
  const harness::Image image = harness::noise(96, 32, 4);
  Random random(4);
  pl::ThresholdFrame frame(size);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint32_t> expected(size.pixels() / 32);
    frame.begin(image.data());
    for (std::uint32_t from = 0; from < size.pixels();) {
      const std::uint32_t to = std::min(size.pixels(), from + random.below(100));
      for (std::uint32_t i = from; i < to; ++i) {
        expected[i / 32] |= std::uint32_t{image[i] <= frame.threshold()} << i % 32;
      }
      frame.advance(std::min(size.pixels(), to + random.below(100)));
      frame.rewind(to);
      BOOST_TEST(frame.pixels() == to);
      BOOST_TEST((frame.words() == expected));
      frame.set_threshold(static_cast<std::uint8_t>(random.below(256)));
      from = to;
    }
    BOOST_TEST(frame.end() == reference_next(image));
  }
}

BOOST_AUTO_TEST_SUITE_END()
