#pragma once

#include <cstdint>

namespace pl {

/// Size of the frames that the programmable logic is built for, in pixels.
struct Geometry {
  std::uint32_t width = 640;
  std::uint32_t height = 480;

  std::uint32_t pixels() const { return width * height; }
};

/// Refuses a size the packet formats and DMA bursts cannot carry (vp::InputError): width a multiple
/// of 32 up to 1024, height up to 512, width × height a multiple of 1024.
void check(const Geometry& geometry);

}  // namespace pl
