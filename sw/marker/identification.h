#pragma once

#include <marker/dictionary.h>
#include <marker/rectification.h>

#include <cstdint>

namespace marker {

/// What a rectified candidate turned out to be.
struct Identification {
  bool found;
  std::uint16_t id;       ///< 0 … 249
  std::uint8_t rotation;  ///< quarter turns clockwise from upright, 0 … 3
  bool border;            ///< all 20 border cells are black
  Code code;              ///< as read, not turned; 0 unless `border`
};

/// Thesis 3.5.3: a cell is black if more than half of its samples are dark. The border must be
/// black all round, and the inner code in one of its four rotations must equal a word of the
/// dictionary.
Identification identify(const CellCounts& cells);

}  // namespace marker
