#pragma once

#include <marker/binary_image.h>
#include <marker/feature_set.h>

#include <cstdint>

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

}  // namespace algorithms
