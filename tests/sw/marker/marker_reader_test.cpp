#include <marker/marker_reader.h>
#include <marker/work.h>
#include <vp/random.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fake_hal.h"
#include "pictures.h"

using marker::CodeBook;
using marker::DetectedMarker;
using marker::Dictionary;
using marker::Extremes;
using marker::GreyImage;
using marker::Refusal;

namespace {

const marker::Lens pinhole{{200, 200, 60, 60}};
constexpr std::uint32_t picture_side = 120, left = 24, cell = 8;

/// A picture of one marker, upright, 8 px a cell.
std::vector<std::uint8_t> drawn(const Dictionary& dictionary, std::uint64_t word) {
  std::vector<std::uint8_t> pixels(picture_side * picture_side, 220);
  const std::uint32_t n = dictionary.cells;
  for (std::uint32_t y = 0; y < (n + 2) * cell; ++y) {
    for (std::uint32_t x = 0; x < (n + 2) * cell; ++x) {
      const std::uint32_t row = y / cell, column = x / cell;
      const bool inside = row > 0 && column > 0 && row <= n && column <= n;
      const bool black = !inside || (word >> (n * n - 1 - ((row - 1) * n + column - 1)) & 1u) != 0;
      if (black) pixels[(left + y) * picture_side + left + x] = 30;
    }
  }
  return pixels;
}

struct Fixture {
  Fixture() { fake_hal::reset(); }

  std::unique_ptr<CodeBook> book = std::make_unique<CodeBook>();
  DetectedMarker found{};

  const Dictionary& open(const char* name) {
    const Dictionary* const dictionary = marker::find_dictionary(name);
    BOOST_REQUIRE(dictionary != nullptr);
    book->open(*dictionary);
    return *dictionary;
  }

  /// Of the largest blob.
  Refusal detect(const std::vector<std::uint8_t>& pixels,
                 const marker::DetectionOptions& options = {}) {
    const GreyImage image{pixels.data(), picture_side, picture_side};
    const std::vector<Extremes> blobs = pictures::find_blobs(image, 127, 30);
    BOOST_REQUIRE(blobs.size() == 1u);
    return marker::detect_marker({image, pinhole}, blobs[0], *book, options, found);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(marker_reader, Fixture)

BOOST_AUTO_TEST_CASE(markers_of_all_dictionaries_in_all_rotations) {
  for (const Dictionary& dictionary : marker::dictionaries) {
    book->open(dictionary);
    std::uint64_t word = dictionary.words[29];
    const double right = left + (dictionary.cells + 2.0) * cell;
    for (unsigned turns = 0; turns < 4; ++turns) {
      BOOST_TEST(detect(drawn(dictionary, word)) == Refusal::none, dictionary.name);
      BOOST_TEST(found.id == 29u);
      BOOST_TEST(found.corrected == 0u);
      // Its own top left corner comes first: it turns clockwise with the marker.
      BOOST_TEST(found.fit.ideal[0].x == (turns == 1 || turns == 2 ? right : left),
                 boost::test_tools::tolerance(1e-9));
      BOOST_TEST(found.fit.ideal[0].y == (turns == 2 || turns == 3 ? right : left),
                 boost::test_tools::tolerance(1e-9));
      word = marker::rotate_clockwise(word, dictionary.cells);
    }
  }
}

BOOST_AUTO_TEST_CASE(wrong_cells_are_corrected_and_counted) {
  const Dictionary& dictionary = open("6x6_250");
  BOOST_REQUIRE(book->corrects() == 4u);
  BOOST_TEST(detect(drawn(dictionary, dictionary.words[200] ^ 0x810000001)) == Refusal::none);
  BOOST_TEST(found.id == 200u);
  BOOST_TEST(found.corrected == 3u);
  BOOST_TEST(detect(drawn(dictionary, dictionary.words[200] ^ 0x81000000F)) == Refusal::unknown);
}

BOOST_AUTO_TEST_CASE(the_border_is_black) {
  const Dictionary& dictionary = open("5x5_100");
  std::vector<std::uint8_t> pixels = drawn(dictionary, dictionary.words[5]);
  // The middle of one cell of the border: the edges are as they were.
  for (std::uint32_t y = left + 2; y < left + cell - 1; ++y) {
    for (std::uint32_t x = left + 3 * cell; x < left + 4 * cell; ++x) {
      pixels[y * picture_side + x] = 220;
    }
  }
  BOOST_TEST(detect(pixels) == Refusal::border);
  marker::DetectionOptions tolerant;
  tolerant.white_border = 1;
  BOOST_TEST(detect(pixels, tolerant) == Refusal::none);
  BOOST_TEST(found.id == 5u);
}

BOOST_AUTO_TEST_CASE(a_black_square_is_no_marker) {
  const Dictionary& dictionary = open("4x4_50");
  BOOST_TEST(detect(drawn(dictionary, 0xFFFF)) == Refusal::plain);
  // Its edges cost time, and were not looked at.
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::crossings)] == 0u);
  // With a single white cell it may be one.
  BOOST_TEST(detect(drawn(dictionary, 0xFFEF)) == Refusal::unknown);
}

// Chance makes words of 4x4 cells: a cell that may be either belongs to none of them.
BOOST_AUTO_TEST_CASE(a_cell_between_black_and_white_is_no_word_of_small_dictionaries) {
  const auto with_grey_cell = [](const Dictionary& dictionary, std::uint8_t level) {
    std::vector<std::uint8_t> pixels = drawn(dictionary, dictionary.words[5]);
    for (std::uint32_t row = 1; row <= dictionary.cells; ++row) {
      for (std::uint32_t column = 1; column <= dictionary.cells; ++column) {
        const std::uint32_t y = left + row * cell, x = left + column * cell;
        if (pixels[y * picture_side + x] != 220) continue;
        for (std::uint32_t i = 0; i < cell * cell; ++i)
          pixels[(y + i / cell) * picture_side + x + i % cell] = level;
        return pixels;
      }
    }
    BOOST_FAIL("no white cell");
    return pixels;
  };
  const Dictionary& small = open("4x4_250");
  BOOST_TEST(detect(with_grey_cell(small, 220)) == Refusal::none);
  BOOST_TEST(detect(with_grey_cell(small, 150)) == Refusal::none);
  BOOST_TEST(detect(with_grey_cell(small, 130)) == Refusal::unknown);
  const Dictionary& large = open("6x6_250");
  BOOST_TEST(detect(with_grey_cell(large, 130)) == Refusal::none);
  BOOST_TEST(found.id == 5u);
}

// What is no quadrilateral is no word.
BOOST_AUTO_TEST_CASE(refused_before_a_word_is_looked_up) {
  const Dictionary& dictionary = open("4x4_50");
  std::vector<std::uint8_t> pixels = drawn(dictionary, dictionary.words[3]);
  for (std::uint32_t y = left; y < left + 6 * cell; ++y) {
    for (std::uint32_t x = left + 6 * cell - (y - left); x < picture_side; ++x) {
      pixels[y * picture_side + x] = 220;  // half of it: a triangle
    }
  }
  fake_hal::reset();
  const GreyImage image{pixels.data(), picture_side, picture_side};
  for (const Extremes& blob : pictures::find_blobs(image, 127, 16)) {
    BOOST_TEST(marker::detect_marker({image, pinhole}, blob, *book, {}, found) != Refusal::none);
  }
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::code_parts)] == 0u);
}

// Uniform noise makes blobs of every shape: none is a marker.
BOOST_AUTO_TEST_CASE(noise_is_no_marker) {
  open("4x4_50");
  vp::RandomBits random(7);
  std::uint32_t blobs = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<std::uint8_t> pixels(320 * 240);
    for (auto& pixel : pixels) pixel = static_cast<std::uint8_t>(random.next() >> 56);
    const GreyImage image{pixels.data(), 320, 240};
    for (const std::uint8_t threshold : {30, 60, 90, 127}) {
      for (const Extremes& blob : pictures::find_blobs(image, threshold, 8)) {
        ++blobs;
        BOOST_TEST(marker::detect_marker({image, pinhole}, blob, *book, {}, found) !=
                   Refusal::none);
      }
    }
  }
  BOOST_TEST(blobs > 500u);
}

BOOST_AUTO_TEST_SUITE_END()
