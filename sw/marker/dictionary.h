#pragma once

#include <array>
#include <cstdint>

namespace marker {

/// A 4 × 4 code: bit 15 is the top left cell, then row by row; 1 = black (the thesis' convention;
/// OpenCV's is the inverse).
using Code = std::uint16_t;

inline constexpr std::uint32_t dictionary_size = 250;

/// The upright codes of ArUco's DICT_4X4_250 by ID.
extern const std::array<Code, dictionary_size> dictionary;

/// The code turned by a quarter clockwise (thesis table 3.2).
constexpr Code rotate_clockwise(Code code) {
  Code turned = 0;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      const unsigned from = (3 - column) * 4 + row;
      turned = static_cast<Code>(turned << 1 | ((code >> (15 - from)) & 1u));
    }
  }
  return turned;
}

/// In how many cells two codes differ (thesis table 3.3).
constexpr unsigned hamming_distance(Code a, Code b) {
  unsigned distance = 0;
  for (unsigned difference = static_cast<unsigned>(a ^ b); difference != 0;
       difference &= difference - 1) {
    ++distance;
  }
  return distance;
}

}  // namespace marker
