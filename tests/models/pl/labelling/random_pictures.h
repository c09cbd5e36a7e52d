#pragma once

#include <pl/blob_labelling/core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "frames.h"

namespace labelling {

/// Pixels of a binary picture, 1 is dark.
struct Binary {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  std::uint32_t count() const { return width * height; }
  pl::Geometry geometry() const { return {width, height}; }
  /// Bit i of word w is pixel 32w + i.
  std::vector<std::uint32_t> words() const;
};

/// The `pixels` pixels from raster index `first` on, the first in bit 0.
std::uint32_t group_at(const Binary& picture, std::uint32_t first, std::uint32_t pixels);
/// Rows of text, '#' is dark.
Binary drawn(const std::vector<std::string>& rows);
/// Noise of some density, rows of dots that lines join, near-chessboards, nested arches or combs.
Binary random_picture(harness::Random& random, std::uint32_t width, std::uint32_t height);
/// Shapes that are hard to label, 64x48: U, spirals, combs, chessboard, nested arches, all dark.
std::vector<Binary> hard_shapes();

/// The components of a picture by flood fill, sorted.
std::vector<pl::Extremes> flood_fill(const Binary& picture);

}  // namespace labelling
