#pragma once

#include <cstdint>

/// The control packet in AXI GPIO 0 (decision: thesis figure 4.19 is not in its text).
namespace hybrid::control {

inline constexpr std::uint32_t ena = 1u << 0;    ///< rising: a frame starts
inline constexpr std::uint32_t rst = 1u << 1;    ///< clears the PL's pipeline, not the threshold
inline constexpr std::uint32_t ready = 3u << 2;  ///< each change asks for the next feature word
inline constexpr std::uint32_t wr_en = 1u << 4;  ///< the image store takes words from DMA 0
inline constexpr std::uint32_t wr_thresh = 1u << 5;  ///< loads the threshold below
inline constexpr unsigned threshold_shift = 8;       ///< 8 bits

}  // namespace hybrid::control
