#pragma once

#include <cstdint>

namespace vp {

/// SplitMix64 (Steele, Lea, Flood 2014): 64 random bits a call, the same on every host.
class RandomBits {
 public:
  explicit RandomBits(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  /// Uniform in (0, 1], in steps of 2^-53: never 0, so that its logarithm exists.
  double next_unit() {
    constexpr double step = 1.0 / 9007199254740992.0;  // 2^-53
    return static_cast<double>((next() >> 11) + 1) * step;
  }

 private:
  std::uint64_t state_;
};

}  // namespace vp
