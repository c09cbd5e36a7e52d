#pragma once

#include <cstdint>
#include <optional>

#include <pl/global_threshold/core.h>

namespace pl {

/// Otsu's threshold of a histogram (Otsu 1979): the split into dark (not above it) and bright
/// pixels for which the variance between both is greatest. None if there are not two levels.
///
/// As the hardware finds it, one level a clock, without division: with n pixels of sum s, of which
/// n0 of sum s0 are dark, the variance is d²/(n0 (n - n0)), up to a constant, with d = n0 s - n s0.
/// What is compared is its logarithm, 2 log2 d - log2(n0 (n - n0)), from the first eleven bits of
/// each: of splits whose variance differs by less than 0.5 % either may win. Of several
/// neighbouring ones with the same value, as across a gap between both kinds of pixels, it is the
/// middle one.
std::optional<std::uint8_t> find_otsu_threshold(const Histogram& histogram);

/// log2(`value`) in steps of 2^-14, from the first eleven bits of `value`, which is not 0.
std::uint32_t coarse_log2(std::uint64_t value);

/// From the edge behind a frame's last pixel to the one that may load its threshold: the levels one
/// by one, and the pipeline.
constexpr std::uint64_t otsu_search_clocks = 256 + 16;

}  // namespace pl
