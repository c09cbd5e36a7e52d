#pragma once

#include <cstdint>

#include <vp/ip.h>
#include <xilinx/bram/bram.h>

/// What the estimates of the thesis' own IP share. The thesis' utilisation is in figures 4.26,
/// 4.29 and 4.31, whose numbers are not in its text: all counts are derived from the structure that
/// the text describes.
namespace pl {

constexpr std::uint64_t mhz = 1'000'000;

/// A FIFO of `depth` words: distributed memory up to 256 words (a RAM64M is 64 × 3 bits in 4 LUT),
/// block memory beyond.
inline void add_fifo(vp::IpEstimate& e, std::uint32_t depth, std::uint32_t width) {
  constexpr std::uint32_t deepest_in_lut = 256, rows = 64, bits = 3, luts = 4;
  constexpr std::uint32_t pointers = 30;
  e.lut += pointers;
  e.ff += pointers + width;
  if (depth > deepest_in_lut) {
    e.bram36 += xilinx::block_ram_36(depth, width);
  } else {
    e.lut += (depth + rows - 1) / rows * ((width + bits - 1) / bits) * luts;
  }
}

/// An IP whose clock the thesis does not limit: it works at `fmax_hz` there.
inline vp::IpEstimate small_ip(const char* kind, std::uint32_t lut, std::uint32_t ff,
                               std::uint64_t fmax_hz) {
  vp::IpEstimate e;
  e.kind = kind;
  e.lut = lut;
  e.ff = ff;
  e.uncertainty_percent = 50;
  e.source = "derived from the structure that thesis 4.3 and 4.4 describe";
  e.fmax_hz = fmax_hz;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation = "works at the thesis' system clock (4.1)";
  return e;
}

}  // namespace pl
