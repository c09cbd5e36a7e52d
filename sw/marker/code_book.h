#pragma once

#include <array>
#include <cstdint>

namespace marker {

/// Square markers of cells × cells, one bit a cell, inside a black border one cell wide.
struct Dictionary {
  const char* name;            ///< as OpenCV's, in lower case: "4x4_50", "apriltag_36h11"
  std::uint32_t cells;         ///< of the code's side, 4 to 7
  std::uint32_t size;          ///< IDs
  std::uint32_t distance;      ///< least number of cells in which two words differ, however turned;
                               ///< 1: a word may equal itself turned
  const std::uint64_t* words;  ///< by ID: row by row, the top left cell highest; 1 = black
};

inline constexpr std::uint32_t max_dictionary_size = 1024;
inline constexpr std::uint32_t min_code_cells = 4;
inline constexpr std::uint32_t max_code_cells = 7;

/// ArUco's DICT_4X4_50 to DICT_7X7_1000, AprilTag's families, ArUco's first dictionary and its
/// MIP_36h12.
inline constexpr std::uint32_t dictionary_count = 21;
extern const std::array<Dictionary, dictionary_count> dictionaries;

/// The dictionary of that name, or nullptr.
const Dictionary* find_dictionary(const char* name);

/// True if the marker looks the same when it is turned, so that its rotation cannot be known.
bool equals_itself_turned(const Dictionary& dictionary, std::uint32_t id);

/// The word turned by a quarter clockwise.
std::uint64_t rotate_clockwise(std::uint64_t word, std::uint32_t cells);

/// A share of candidates with random cells that may pass for a marker.
inline constexpr double tolerable_false_share = 1e-3;

/// Words of a dictionary by their parts, so that no look-up goes through all of them: a word with
/// at most n wrong cells has at least one of n + 1 parts right, and few words share a part.
class CodeBook {
 public:
  /// What a word was taken for.
  struct Match {
    bool found;
    std::uint16_t id;
    std::uint8_t rotation;   ///< quarter turns clockwise from upright, 0 … 3
    std::uint8_t corrected;  ///< cells that were wrong
  };

  /// Takes the dictionary in, which must outlive the book. Up to `correct` wrong cells are
  /// corrected, but never so many that another ID is as near.
  void open(const Dictionary& dictionary, std::uint32_t correct);

  /// The same with as many as keep false_share() tolerable; none where no number does.
  void open(const Dictionary& dictionary);

  const Dictionary& dictionary() const { return *dictionary_; }
  std::uint32_t corrects() const { return parts_ - 1; }

  /// Share of random words that are taken for an ID.
  double false_share() const;
  /// The same of words in which no cell is corrected.
  double exact_false_share() const;

  Match look_up(std::uint64_t word) const;

 private:
  static constexpr std::uint32_t max_parts = 10;  ///< 7x7_50 corrects 9

  std::uint64_t part(std::uint64_t word, std::uint32_t index) const;
  bool find_near(std::uint64_t word, Match& match) const;

  const Dictionary* dictionary_ = nullptr;
  std::uint32_t parts_ = 0;
  std::array<std::uint32_t, max_parts + 1> first_bit_{};
  /// IDs in the order of a part of their words.
  std::array<std::array<std::uint16_t, max_dictionary_size>, max_parts> order_{};
};

}  // namespace marker
