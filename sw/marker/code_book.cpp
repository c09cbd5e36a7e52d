#include <marker/code_book.h>
#include <marker/dictionary_words.h>
#include <marker/work.h>

#include <algorithm>
#include <cstring>

namespace marker {
namespace {

namespace words = dictionary_words;

std::uint32_t ones(std::uint64_t word) {
  std::uint32_t count = 0;
  for (; word != 0; word &= word - 1) ++count;
  return count;
}

/// Share of all words of `bits` bits that differ from a given one in up to `most`.
double share_near(std::uint32_t bits, std::uint32_t most) {
  double choices = 1, sum = 1;
  for (std::uint32_t k = 0; k < most; ++k) {
    choices = choices * (bits - k) / (k + 1);
    sum += choices;
  }
  return sum / static_cast<double>(std::uint64_t{1} << bits);
}

double false_share_of(const Dictionary& dictionary, std::uint32_t correct) {
  return 4.0 * dictionary.size * share_near(dictionary.cells * dictionary.cells, correct);
}

std::uint32_t most_correctable(const Dictionary& dictionary) {
  return (dictionary.distance - 1) / 2;
}

}  // namespace

const std::array<Dictionary, dictionary_count> dictionaries = {{
    {"4x4_50", 4, 50, 4, words::aruco_4x4.data()},
    {"4x4_100", 4, 100, 3, words::aruco_4x4.data()},
    {"4x4_250", 4, 250, 3, words::aruco_4x4.data()},
    {"4x4_1000", 4, 1000, 2, words::aruco_4x4.data()},
    {"5x5_50", 5, 50, 8, words::aruco_5x5.data()},
    {"5x5_100", 5, 100, 7, words::aruco_5x5.data()},
    {"5x5_250", 5, 250, 6, words::aruco_5x5.data()},
    {"5x5_1000", 5, 1000, 5, words::aruco_5x5.data()},
    {"6x6_50", 6, 50, 13, words::aruco_6x6.data()},
    {"6x6_100", 6, 100, 12, words::aruco_6x6.data()},
    {"6x6_250", 6, 250, 11, words::aruco_6x6.data()},
    {"6x6_1000", 6, 1000, 9, words::aruco_6x6.data()},
    {"7x7_50", 7, 50, 19, words::aruco_7x7.data()},
    {"7x7_100", 7, 100, 18, words::aruco_7x7.data()},
    {"7x7_250", 7, 250, 17, words::aruco_7x7.data()},
    {"7x7_1000", 7, 1000, 14, words::aruco_7x7.data()},
    {"apriltag_36h11", 6, 587, 11, words::apriltag_36h11.data()},
    {"apriltag_16h5", 4, 30, 5, words::apriltag_16h5.data()},
    {"apriltag_25h9", 5, 35, 9, words::apriltag_25h9.data()},
    {"aruco_original", 5, 1024, 1, words::aruco_original.data()},
    {"aruco_mip_36h12", 6, 250, 12, words::aruco_mip_36h12.data()},
}};

const Dictionary* find_dictionary(const char* name) {
  for (const Dictionary& dictionary : dictionaries) {
    if (std::strcmp(dictionary.name, name) == 0) return &dictionary;
  }
  return nullptr;
}

std::uint64_t rotate_clockwise(std::uint64_t word, std::uint32_t cells) {
  std::uint64_t turned = 0;
  for (std::uint32_t row = 0; row < cells; ++row) {
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t from = (cells - 1 - column) * cells + row;
      turned = turned << 1 | (word >> (cells * cells - 1 - from) & 1u);
    }
  }
  return turned;
}

bool equals_itself_turned(const Dictionary& dictionary, std::uint32_t id) {
  const std::uint64_t word = dictionary.words[id];
  const std::uint64_t half_turned =
      rotate_clockwise(rotate_clockwise(word, dictionary.cells), dictionary.cells);
  return half_turned == word;
}

void CodeBook::open(const Dictionary& dictionary, std::uint32_t correct) {
  dictionary_ = &dictionary;
  parts_ = std::min(correct, most_correctable(dictionary)) + 1;
  const std::uint32_t bits = dictionary.cells * dictionary.cells;
  for (std::uint32_t i = 0; i <= parts_; ++i) first_bit_[i] = i * bits / parts_;
  for (std::uint32_t i = 0; i < parts_; ++i) {
    auto* const first = order_[i].data();
    for (std::uint32_t id = 0; id < dictionary.size; ++id) {
      first[id] = static_cast<std::uint16_t>(id);
    }
    std::sort(first, first + dictionary.size, [&](std::uint16_t a, std::uint16_t b) {
      const std::uint64_t of_a = part(dictionary.words[a], i), of_b = part(dictionary.words[b], i);
      return of_a != of_b ? of_a < of_b : a < b;
    });
  }
}

void CodeBook::open(const Dictionary& dictionary) {
  std::uint32_t correct = most_correctable(dictionary);
  while (correct > 0 && false_share_of(dictionary, correct) > tolerable_false_share) --correct;
  open(dictionary, correct);
}

double CodeBook::false_share() const {
  return false_share_of(*dictionary_, corrects());
}

double CodeBook::exact_false_share() const {
  return false_share_of(*dictionary_, 0);
}

std::uint64_t CodeBook::part(std::uint64_t word, std::uint32_t index) const {
  const std::uint32_t size = first_bit_[index + 1] - first_bit_[index];
  return word >> first_bit_[index] & ((std::uint64_t{1} << size) - 1);
}

bool CodeBook::find_near(std::uint64_t word, Match& match) const {
  [[maybe_unused]] std::uint32_t searched = 0, compares = 0;
  for (std::uint32_t i = 0; i < parts_ && !match.found; ++i) {
    MARKERVP_COUNT(searched);
    const std::uint64_t wanted = part(word, i);
    const std::uint16_t* const end = order_[i].data() + dictionary_->size;
    const std::uint16_t* id = std::lower_bound(order_[i].data(), end, wanted,
                                               [&](std::uint16_t known, std::uint64_t value) {
                                                 MARKERVP_COUNT(searched);
                                                 return part(dictionary_->words[known], i) < value;
                                               });
    for (; id != end && part(dictionary_->words[*id], i) == wanted; ++id) {
      const std::uint32_t wrong = ones(word ^ dictionary_->words[*id]);
      MARKERVP_ADD(compares, wrong + 1);
      if (wrong > corrects()) continue;
      match.found = true;
      match.id = *id;
      match.corrected = static_cast<std::uint8_t>(wrong);
      break;
    }
  }
  work(Work::code_parts, searched);
  work(Work::code_compares, compares);
  return match.found;
}

CodeBook::Match CodeBook::look_up(std::uint64_t word) const {
  Match match{};
  // Turned clockwise t times until upright: the marker itself is turned 4 - t quarters.
  for (unsigned turns = 0; turns < 4; ++turns) {
    if (find_near(word, match)) {
      match.rotation = static_cast<std::uint8_t>((4 - turns) % 4);
      break;
    }
    word = rotate_clockwise(word, dictionary_->cells);
    work(Work::code_turns, std::uint64_t{dictionary_->cells} * dictionary_->cells);
  }
  return match;
}

}  // namespace marker
