#pragma once

#include <cstdint>

#include <marker/feature_set.h>
#include <marker/images.h>
#include <marker/result.h>

namespace algorithms {

/// The text of tests/data/golden/NAME.words, put into the program as it is.
struct GoldenText {
  const char* name;
  const char* begin;
  const char* end;
};

inline constexpr std::uint32_t width = 640;   ///< px, of the golden frames
inline constexpr std::uint32_t height = 480;  ///< px
inline constexpr std::uint32_t binary_words = width * height / 32;

/// Reads a frame's feature words, in the order in which the PL sends them, with the end word, and
/// its binary image. `binary` has room for `binary_words`. False if the text is not as its README
/// says.
bool read_golden(const GoldenText& text, marker::WordStore& words, std::uint32_t* binary);

/// Runs everything of sw/marker on one golden frame and prints all that it computed: counts and
/// indices decimal, doubles as the 16 hexadecimal digits of their bits. Two machines compute the
/// same if they print the same.
class SelfTest {
 public:
  /// False, and said so on the console, if there is no memory or the text is no golden frame.
  bool run(const GoldenText& text);

 private:
  bool prepare();
  void print_features() const;
  void print_candidate(std::uint32_t index) const;
  void print_marker() const;

  hal_dma_buffer binary_{};
  marker::WordStore words_;
  marker::FeatureSet features_;
  marker::CandidateList candidates_;
};

}  // namespace algorithms
