// CornerFrame against CornerCore: the same packets at the same clocks.
#include <pl/common/simd_target.h>
#include <pl/corner_detection/core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "pictures.h"
#include "reference.h"

using harness::first_difference;
using harness::Random;

namespace {

std::vector<harness::Word> detect(const Picture& picture, std::uint32_t threshold) {
  pl::CornerFrame frame(picture.geometry, threshold);
  std::vector<pl::StampedWord> corners;
  frame.detect(picture.image.data(), corners);
  return corner_words(corners);
}

void check(const Picture& picture, std::uint32_t threshold) {
  BOOST_TEST_CONTEXT(picture.name << ' ' << picture.geometry.width << 'x' << picture.geometry.height
                                  << " threshold " << threshold) {
    const auto expected = reference_corners(picture.image, picture.geometry, threshold);
    BOOST_TEST(first_difference(detect(picture, threshold), expected) == "");
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(corner_frame)

BOOST_AUTO_TEST_CASE(scenes_give_the_words_of_the_core) {
  for (const Picture& picture : scenes()) check(picture, 30);
}

BOOST_AUTO_TEST_CASE(every_size_gives_the_words_of_the_core) {
  for (const pl::Geometry& size : small_sizes()) {
    for (const Picture& picture : patterns(size)) check(picture, 30);
  }
  for (const Picture& picture : patterns({1024, 512})) check(picture, 30);
}

BOOST_AUTO_TEST_CASE(every_threshold_gives_the_words_of_the_core) {
  for (std::uint32_t threshold : {0u, 1u, 127u, 128u, 254u, 255u}) {
    for (const Picture& picture : patterns({160, 32})) check(picture, threshold);
  }
}

BOOST_AUTO_TEST_CASE(every_simd_target_gives_the_words_of_the_core) {
  for (const std::string& target : pl::simd_targets()) {
    BOOST_TEST_CONTEXT(target) {
      BOOST_REQUIRE(pl::use_simd_target(target));
      for (const pl::Geometry& size : {pl::Geometry{32, 32}, {96, 32}, {640, 480}}) {
        for (const Picture& picture : patterns(size)) check(picture, 30);
      }
    }
  }
  pl::use_simd_target("");
}

BOOST_AUTO_TEST_CASE(a_corner_leaves_four_clocks_after_the_pixel_four_right_and_below) {
  BOOST_TEST(pl::CornerFrame::clock({640, 480}, 4, 4) == 4u + 8 * 640 + 8);
  BOOST_TEST(pl::CornerFrame::clock({32, 32}, 27, 27) == 4u + 31 * 32 + 31);
}

BOOST_AUTO_TEST_CASE(bands_of_rows_give_the_words_of_the_whole_frame) {
  const Picture picture{"noise", {160, 64}, harness::noise(160, 64, 5)};
  const auto expected = reference_corners(picture.image, picture.geometry, 30);
  Random random(1);
  pl::CornerFrame frame(picture.geometry, 30);
  for (int round = 0; round < 50; ++round) {
    std::vector<pl::StampedWord> corners;
    frame.begin(picture.image.data());
    for (std::uint32_t rows = 0; rows < 64;) {
      rows = std::min(64u, rows + random.below(2 + static_cast<std::uint32_t>(round)));
      frame.advance(rows, corners);
      const std::uint64_t first_unread = pl::CornerCore::latency + std::uint64_t{rows} * 160;
      BOOST_TEST((corners.empty() || corners.back().clock < first_unread));
      const auto given = std::count_if(expected.begin(), expected.end(), [=](const auto& w) {
        return w.clock < harness::detectors_begin + first_unread;
      });
      BOOST_TEST(corners.size() == static_cast<std::size_t>(given));
    }
    BOOST_TEST(first_difference(corner_words(corners), expected) == "");
  }
}

// What an engine does when the image memory is written while the sensor reads it.
BOOST_AUTO_TEST_CASE(rows_that_changed_are_found_again) {
  const pl::Geometry size{96, 64};
  Random random(2);
  harness::Image image = harness::noise(96, 64, 6);
  pl::CornerFrame frame(size, 30);
  for (int round = 0; round < 50; ++round) {
    std::vector<pl::StampedWord> corners;
    frame.begin(image.data());
    for (std::uint32_t read = 0; read < 64; read += random.below(20)) {
      frame.advance(std::min(64u, read + random.below(30)), corners);
      const harness::Image other = harness::noise(96, 64, random.below(1000));
      std::copy(other.begin() + read * 96, other.end(), image.begin() + read * 96);
      frame.rewind(read);
      const auto taken_back = std::find_if(corners.begin(), corners.end(), [=](const auto& word) {
        return word.clock >= 7 + read * 96;
      });
      corners.erase(taken_back, corners.end());
    }
    frame.advance(64, corners);
    BOOST_TEST(first_difference(corner_words(corners), reference_corners(image, size, 30)) == "");
  }
}

BOOST_AUTO_TEST_CASE(a_change_that_is_not_told_is_noticed_by_the_comparison) {
  const pl::Geometry size{96, 64};
  harness::Image image = harness::noise(96, 64, 6);
  pl::CornerFrame frame(size, 30);
  std::vector<pl::StampedWord> corners;
  frame.begin(image.data());
  frame.advance(40, corners);
  const harness::Image other = harness::noise(96, 64, 7);
  std::copy(other.begin() + 20 * 96, other.end(), image.begin() + 20 * 96);
  frame.advance(64, corners);
  BOOST_TEST(first_difference(corner_words(corners), reference_corners(image, size, 30)) != "");
}

BOOST_AUTO_TEST_SUITE_END()
