#pragma once

#include <cstdint>

#include <marker_logic.h>

namespace marker {

/// A camera image, row by row.
struct GreyImage {
  const std::uint8_t* pixels;
  std::uint32_t width, height;  ///< px
};

/// The largest image that the PS finds features in: what the PL can find them in, too.
inline constexpr std::uint32_t max_image_width = marker_logic::max_width;
inline constexpr std::uint32_t max_image_height = marker_logic::max_height;

using marker_logic::pixels_per_word;

/// A thresholded image wherever it lies: DMA memory in the hybrid system, an array in the PS-only
/// one.
struct BinaryImage {
  const std::uint32_t* words;  ///< bit i of word w is pixel 32w + i, raster order; 1 = dark
  std::uint32_t width;         ///< px, a multiple of 32
  std::uint32_t height;        ///< px
  bool in_dma_memory;          ///< a DMA engine wrote it: reads stall (thesis 5.4.1.6)

  /// Pixel column `x` of row `y`, both inside.
  bool is_dark(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t index = y * width + x;
    return (words[index / 32] >> (index % 32)) & 1u;
  }
};

}  // namespace marker
