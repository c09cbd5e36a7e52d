#pragma once

#include <cstdint>

namespace pl {

/// The 32-bit words that carry features to the PS (thesis 4.4.3, figures 4.20 and 4.21).
namespace packet {

/// No corner can look like it: x never reaches 1023 together with y 511.
constexpr std::uint32_t end_of_frame = 0xFFFF'FFFF;

/// `strength` 12 bits, of which the upper ten travel; `direction` N 0, S 1, E 2, W 3.
constexpr std::uint32_t corner(std::uint32_t strength, std::uint32_t direction, std::uint32_t x,
                               std::uint32_t y) {
  return 1u << 31 | (strength >> 2 & 0x3FF) << 21 | direction << 19 | y << 10 | x;
}
/// `number` counts the frame's blobs modulo 2048.
constexpr std::uint32_t blob_start(std::uint32_t number, std::uint32_t x, std::uint32_t y) {
  return 1u << 30 | (number & 0x7FF) << 19 | y << 10 | x;
}
constexpr std::uint32_t blob_end(std::uint32_t number, std::uint32_t x, std::uint32_t y) {
  return (number & 0x7FF) << 19 | y << 10 | x;
}

}  // namespace packet

}  // namespace pl
