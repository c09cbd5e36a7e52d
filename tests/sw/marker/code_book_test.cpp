#include <marker/code_book.h>
#include <marker/work.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <iterator>
#include <memory>
#include <opencv2/aruco/dictionary.hpp>
#include <random>
#include <string>

#include "fake_hal.h"

using marker::CodeBook;
using marker::Dictionary;

namespace {

std::uint32_t ones(std::uint64_t word) {
  return static_cast<std::uint32_t>(__builtin_popcountll(word));
}

std::uint64_t turned(std::uint64_t word, std::uint32_t cells, unsigned turns) {
  for (unsigned i = 0; i < turns; ++i) word = marker::rotate_clockwise(word, cells);
  return word;
}

const Dictionary& dictionary(const char* name) {
  const Dictionary* const found = marker::find_dictionary(name);
  BOOST_REQUIRE(found != nullptr);
  return *found;
}

struct Fixture {
  Fixture() { fake_hal::reset(); }

  /// As large as on the chip: not for the stack.
  std::unique_ptr<CodeBook> book = std::make_unique<CodeBook>();
  std::mt19937_64 random{42};

  std::uint64_t random_word(const Dictionary& of) { return random() >> (64 - of.cells * of.cells); }

  /// With so many cells changed.
  std::uint64_t damaged(std::uint64_t word, std::uint32_t cells, std::uint32_t wrong) {
    std::uint64_t change = 0;
    while (ones(change) < wrong) change |= std::uint64_t{1} << random() % (cells * cells);
    return word ^ change;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(code_book, Fixture)

BOOST_AUTO_TEST_CASE(words_are_those_of_opencv) {
  constexpr std::size_t in_order = 16;  // DICT_4X4_50 to DICT_7X7_1000
  constexpr int others[] = {cv::aruco::DICT_APRILTAG_36h11, cv::aruco::DICT_APRILTAG_16h5,
                            cv::aruco::DICT_APRILTAG_25h9, cv::aruco::DICT_ARUCO_ORIGINAL};
  for (std::size_t i = 0; i < in_order + std::size(others); ++i) {
    const Dictionary& ours = marker::dictionaries[i];
    const auto theirs = cv::aruco::getPredefinedDictionary(i < in_order ? static_cast<int>(i)
                                                                        : others[i - in_order]);
    BOOST_TEST(ours.size == static_cast<std::uint32_t>(theirs->bytesList.rows));
    BOOST_REQUIRE(ours.cells == static_cast<std::uint32_t>(theirs->markerSize));
    for (std::uint32_t id = 0; id < ours.size; ++id) {
      const int row = static_cast<int>(id), side = theirs->markerSize;
      const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
          theirs->bytesList.rowRange(row, row + 1), side);
      std::uint64_t word = 0;
      for (int cell = 0; cell < side * side; ++cell) {
        word = word << 1 | (bits.at<std::uint8_t>(cell / side, cell % side) == 0 ? 1 : 0);
      }
      BOOST_REQUIRE_MESSAGE(word == ours.words[id], ours.name << " ID " << id);
    }
  }
}

BOOST_AUTO_TEST_CASE(distances_are_what_they_are) {
  for (const Dictionary& d : marker::dictionaries) {
    std::uint32_t least = 64;
    for (std::uint32_t i = 0; i < d.size; ++i) {
      const bool is_vague = marker::equals_itself_turned(d, i);
      BOOST_TEST(is_vague == (d.name == std::string("aruco_original") && i == 1023), d.name);
      for (unsigned turns = 0; turns < 4; ++turns) {
        const std::uint64_t word = turned(d.words[i], d.cells, turns);
        for (std::uint32_t j = turns == 0 || is_vague ? i + 1 : i; j < d.size; ++j) {
          least = std::min(least, ones(word ^ d.words[j]));
        }
      }
    }
    BOOST_TEST(least == d.distance, d.name);
  }
}

BOOST_AUTO_TEST_CASE(names) {
  BOOST_TEST(dictionary("4x4_50").size == 50u);
  BOOST_TEST(dictionary("apriltag_36h11").cells == 6u);
  BOOST_TEST(marker::find_dictionary("4x4_51") == nullptr);
  BOOST_TEST(marker::find_dictionary("") == nullptr);
}

// Every ID of every dictionary, in all rotations, with as many wrong cells as can be corrected.
BOOST_AUTO_TEST_CASE(finds_what_can_be_corrected) {
  for (const Dictionary& d : marker::dictionaries) {
    book->open(d, 64);
    BOOST_TEST(book->corrects() == (d.distance - 1) / 2, d.name);
    for (std::uint32_t id = 0; id < d.size; ++id) {
      for (unsigned turns = 0; turns < 4; ++turns) {
        const std::uint32_t wrong = (id + turns) % (book->corrects() + 1);
        const auto match =
            book->look_up(damaged(turned(d.words[id], d.cells, turns), d.cells, wrong));
        BOOST_REQUIRE_MESSAGE(match.found && match.id == id && match.corrected == wrong &&
                                  (match.rotation == turns || marker::equals_itself_turned(d, id)),
                              d.name << " ID " << id << " turned " << turns << ", wrong " << wrong);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(refuses_what_is_farther) {
  const Dictionary& d = dictionary("6x6_250");
  book->open(d, 2);
  BOOST_TEST(book->corrects() == 2u);
  for (std::uint32_t id = 0; id < d.size; ++id) {
    BOOST_TEST(book->look_up(damaged(d.words[id], d.cells, 2)).found);
    BOOST_TEST(!book->look_up(damaged(d.words[id], d.cells, 3)).found);
  }
}

// What the false share says of random words comes true, and by default it is tolerable, or nothing
// is corrected.
BOOST_AUTO_TEST_CASE(random_words) {
  for (const Dictionary& d : marker::dictionaries) {
    book->open(d);
    BOOST_TEST((book->false_share() <= marker::tolerable_false_share || book->corrects() == 0));
    constexpr int trials = 100000;
    int found = 0;
    for (int i = 0; i < trials; ++i) found += book->look_up(random_word(d)).found ? 1 : 0;
    const double expected = book->false_share() * trials;
    // Words that equal themselves turned make it a little less; five standard deviations.
    BOOST_TEST(found < expected + 5 * std::sqrt(expected) + 1, d.name);
    BOOST_TEST(found > expected - 5 * std::sqrt(expected) - 1, d.name);
  }
  book->open(dictionary("4x4_250"), 1);
  BOOST_TEST(book->false_share() == 1000.0 * 17 / 65536);
}

// Compares per look-up of a random word in all four rotations; a loop would make 4000 and 2348.
BOOST_AUTO_TEST_CASE(few_words_are_compared) {
  struct Expected {
    const char* name;
    double compares;
  };
  for (const Expected& e : {Expected{"4x4_1000", 0.1}, Expected{"6x6_1000", 34},
                            Expected{"7x7_1000", 230}, Expected{"apriltag_36h11", 20}}) {
    const Dictionary& d = dictionary(e.name);
    book->open(d);
    fake_hal::reset();
    for (int i = 0; i < 1000; ++i) book->look_up(random_word(d));
    // Cells that differ are counted, and one more: of random words half do.
    const double counted = static_cast<double>(
        fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::code_compares)]);
    const double compares = counted / (d.cells * d.cells / 2.0 + 1) / 1000;
    BOOST_TEST_MESSAGE(e.name << ": " << compares << " compares");
    BOOST_TEST(compares < e.compares, e.name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
