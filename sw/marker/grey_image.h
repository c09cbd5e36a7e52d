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

}  // namespace marker
