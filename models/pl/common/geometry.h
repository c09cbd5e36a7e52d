#pragma once

#include <cstdint>

#include <marker_logic.h>

namespace pl {

/// What the programmable logic is built for: the size of frames in pixels, and the words of a
/// burst.
struct Geometry {
  std::uint32_t width = 640;
  std::uint32_t height = 480;
  std::uint32_t burst_words = marker_logic::usual_burst_words;
  /// Neighbours in a row that come on one edge; a row is a multiple of them.
  std::uint32_t pixels_per_clock = 1;

  std::uint32_t pixels() const { return width * height; }
  /// In which a row, and a frame, passes.
  std::uint32_t clocks_per_row() const { return width / pixels_per_clock; }
  std::uint32_t clocks() const { return pixels() / pixels_per_clock; }
  /// How features are packed.
  marker_logic::WordFormat words() const { return {width, height}; }
};

/// Refuses a size that feature words and DMA bursts cannot carry, a burst that the DMA does not
/// make, and other pixels a clock than 1, 2 or 4 (vp::InputError): see
/// marker_logic::is_legal_size() and is_legal_burst().
void check(const Geometry& geometry);

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
