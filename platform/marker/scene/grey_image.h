#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace platform {

/// An 8-bit grey picture, row by row from the top left, no padding.
struct GreyImage {
  int width = 0;   ///< px
  int height = 0;  ///< px
  std::vector<std::uint8_t> pixels;

  std::uint8_t at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

}  // namespace platform
