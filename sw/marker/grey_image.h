#pragma once

#include <cstdint>

namespace marker {

/// A camera image, row by row.
struct GreyImage {
  const std::uint8_t* pixels;
  std::uint32_t width, height;  ///< px
};

/// The largest image that the PS finds features in: what the PL's packets can address, too.
inline constexpr std::uint32_t max_image_width = 1024;
inline constexpr std::uint32_t max_image_height = 512;

/// Words of a binary image: 32 pixels each.
inline constexpr std::uint32_t pixels_per_word = 32;

}  // namespace marker
