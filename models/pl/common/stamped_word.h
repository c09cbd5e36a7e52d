#pragma once

#include <cstdint>

namespace pl {

/// A word with the pixel clock at which it leaves its module: clock 0 is the edge that takes the
/// frame's first pixel.
struct StampedWord {
  std::uint64_t clock = 0;
  std::uint32_t word = 0;
};

/// A blob's two packets with the pixel clock at which they leave.
struct StampedBlob {
  std::uint64_t clock = 0;
  std::uint32_t start = 0;
  std::uint32_t end = 0;
};

}  // namespace pl
