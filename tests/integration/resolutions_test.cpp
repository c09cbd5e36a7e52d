// Other resolutions than 640x480, on rendered scenes and on images drawn here.
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include <facts/summary.h>
#include <vp/error.h>
#include <vp/random.h>

#include "platform_run.h"

using namespace integration;
using platform::GreyImage;
using platform::facts::UnitReport;

namespace {

struct Size {
  int width, height;
};

Settings resolution(Size size) {
  return {{"pl.width", std::to_string(size.width) + " px"},
          {"pl.height", std::to_string(size.height) + " px"}};
}

GreyImage plain(Size size, std::uint8_t grey) {
  return {size.width, size.height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(size.width * size.height), grey)};
}

void fill(GreyImage& image, int left, int top, int side, std::uint8_t grey) {
  for (int y = top; y < top + side; ++y) {
    const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width + left;
    std::fill(row, row + side, grey);
  }
}

/// A candidate that is no marker.
GreyImage dark_square(Size size, int left, int top, int side) {
  GreyImage image = plain(size, 220);
  fill(image, left, top, side, 30);
  return image;
}

void check_time(const UnitReport& frame, Size size) {
  const double end_word_us = (size.width * size.height + 17) / 50.0;
  BOOST_TEST(stage_us(frame, "feature_extraction") > end_word_us);
  BOOST_TEST(stage_us(frame, "feature_extraction") < end_word_us + 2);
}

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(resolutions)

BOOST_AUTO_TEST_CASE(markers_are_found_in_scenes_of_other_sizes) {
  for (const Size size :
       {Size{320, 240}, {160, 128}, {512, 512}, {640, 512}, {1024, 512}, {1280, 720}}) {
    BOOST_TEST_CONTEXT(size.width << "x" << size.height) {
      const PlatformRun run = run_scenes({"z1.0", "roll90"}, resolution(size));
      for (const UnitReport& frame : run.frames) {
        BOOST_TEST(overflows(frame) == 0u);
        BOOST_TEST(frame.warnings.empty());
        BOOST_TEST_REQUIRE(platform::marker_frame(frame).markers.size() == 1u);
        BOOST_TEST(platform::marker_frame(frame).markers[0].id == 0);
        const auto error = platform::measure_error(platform::marker_frame(frame).markers[0],
                                                   *platform::marker_frame(frame).truth);
        BOOST_TEST(error.corner_px < 3);
        check_time(frame, size);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_square_is_found_to_the_pixel_in_any_size) {
  for (const Size size : {Size{64, 64}, {96, 64}, {320, 240}, {1024, 512}}) {
    BOOST_TEST_CONTEXT(size.width << "x" << size.height) {
      const int left = size.width / 2 - 12;
      const int top = size.height / 2 - 16;
      const PlatformRun run = run_images({dark_square(size, left, top, 30)}, resolution(size));
      BOOST_TEST_REQUIRE(run.frames.size() == 1u);
      const UnitReport& frame = run.frames[0];
      BOOST_TEST(frame.counts["blobs"] == 1u);
      BOOST_TEST(frame.counts["candidates"] == 1u);
      BOOST_TEST(platform::marker_frame(frame).markers.empty(), "a plain square is no marker");
      BOOST_TEST(has(features(frame), "blob " + std::to_string(left) + " " + std::to_string(top) +
                                          " " + std::to_string(left + 29) + " " +
                                          std::to_string(top + 29)));
      check_time(frame, size);
    }
  }
}

BOOST_AUTO_TEST_CASE(smallest_and_longest_frames_run) {
  for (const Size size : {Size{32, 32}, {64, 16}, {1024, 16}, {32, 512}}) {
    BOOST_TEST_CONTEXT(size.width << "x" << size.height) {
      const PlatformRun run = run_images({plain(size, 255), plain(size, 255)}, resolution(size));
      BOOST_TEST_REQUIRE(run.frames.size() == 2u);
      for (const UnitReport& frame : run.frames) {
        BOOST_TEST(frame.counts["feature_words"] == 1u, "the end word alone");
        BOOST_TEST(frame.warnings.empty());
        check_time(frame, size);
      }
    }
  }
}

/// Far more corners than the buffers hold: told, and the next frame is as if nothing had been.
BOOST_AUTO_TEST_CASE(a_frame_of_noise_does_no_harm_to_the_next) {
  const Size size{320, 240};
  GreyImage noise = plain(size, 0);
  vp::RandomBits random(1);
  for (std::uint8_t& pixel : noise.pixels) pixel = static_cast<std::uint8_t>(random.next());
  const GreyImage square = dark_square(size, 100, 60, 80);
  const PlatformRun run = run_images({square, noise, square, square}, resolution(size));
  BOOST_TEST_REQUIRE(run.frames.size() == 4u);
  BOOST_TEST(run.frames[1].counts["feature_overflow"] > 0u);
  BOOST_TEST(!run.frames[1].warnings.empty());
  for (const std::size_t i : {0u, 2u, 3u}) {
    BOOST_TEST(overflows(run.frames[i]) == 0u);
    BOOST_TEST(run.frames[i].warnings.empty());
    BOOST_TEST(features(run.frames[i]) == features(run.frames[0]),
               boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(sizes_that_cannot_be_built_are_refused) {
  for (const Size size : {Size{0, 480}, {640, 0}, {650, 480}, {2080, 512}, {640, 2064}, {96, 16}}) {
    BOOST_TEST_CONTEXT(size.width << "x" << size.height) {
      BOOST_CHECK_THROW(run_images({}, resolution(size)), vp::InputError);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
