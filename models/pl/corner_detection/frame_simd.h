#pragma once

#include <cstddef>
#include <cstdint>

namespace pl::fast {

/// Bytes behind the last pixel of a row that mark_corners() may read.
constexpr std::size_t mark_corners_overread = 80;

/// Tells which of `count` pixels from `points` on have nine contiguous circle pixels brighter than
/// the pixel itself by more than `threshold` (0 to 255): bit k of `bits` (bit k % 64 of word k /
/// 64, whole words are written). The circles lie `stride` bytes a row around the points.
void mark_corners(const std::uint8_t* points, std::ptrdiff_t stride, std::uint32_t count,
                  std::uint32_t threshold, std::uint64_t* bits);

}  // namespace pl::fast
