#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace harness {

/// One word that left a module, with the pixel clock at which it left: clock 1 is the edge that
/// first samples `ena`.
struct Word {
  char kind;  ///< 'C' corner, 'B' blob, 'T' binary
  std::uint64_t clock;
  std::uint32_t first;
  std::uint32_t second;  ///< a blob's end; else 0
};
/// On which clocks the detectors and the blob detection take a frame's first pixel, one behind the
/// sensor, the other behind the threshold.
constexpr std::uint64_t detectors_begin = 3, blobs_begin = 4;

bool operator==(const Word& a, const Word& b);
bool operator<(const Word& a, const Word& b);
std::ostream& operator<<(std::ostream& out, const Word& word);

/// Empty if both hold the same words at the same clocks, in this order; else where they part.
std::string first_difference(const std::vector<Word>& a, const std::vector<Word>& b);

/// FNV-1a over kind, clock and packet of all words: one number that says two runs gave the same
/// words at the same clocks.
std::uint64_t hash(const std::vector<Word>& words);

/// How many words are of this kind.
std::size_t count(const std::vector<Word>& words, char kind);

}  // namespace harness
