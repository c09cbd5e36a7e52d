#pragma once

#include <cstdint>

#include <marker_logic.h>

namespace pl {

/// Size of the frames that the programmable logic is built for, in pixels.
struct Geometry {
  std::uint32_t width = 640;
  std::uint32_t height = 480;

  std::uint32_t pixels() const { return width * height; }
  /// How features are packed.
  marker_logic::WordFormat words() const { return {width, height}; }
};

/// Refuses a size that feature words and DMA bursts cannot carry (vp::InputError): see
/// marker_logic::is_legal_size().
void check(const Geometry& geometry);

}  // namespace pl
