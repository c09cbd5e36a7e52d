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

/// The search behind a frame, while nobody counts pixels.
class OtsuSearch {
 public:
  /// From the edge behind a frame's last pixel to the one that may load its threshold: the levels
  /// one by one, and the pipeline.
  static constexpr std::uint64_t clocks = 256 + 16;

  /// On the edge behind a frame's last pixel. What was not found until then never is.
  void start(std::uint64_t cycle, const Histogram& histogram);
  void stop() { due_ = never; }
  /// Where no frame runs: the threshold that is loaded on this edge, once.
  std::optional<std::uint8_t> take(std::uint64_t cycle);
  /// The edge that loads it.
  std::uint64_t due() const { return due_; }

 private:
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  std::uint64_t due_ = never;
  std::uint8_t found_ = 0;
};

}  // namespace pl
