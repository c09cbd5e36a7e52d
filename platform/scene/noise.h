#pragma once

#include <cstdint>

namespace platform {

/// SplitMix64 (Steele, Lea, Flood 2014): 64 random bits a call, the same on every host.
class RandomBits {
 public:
  explicit RandomBits(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next();

  /// Uniform in (0, 1], in steps of 2^-53: never 0, so that its logarithm exists.
  double next_unit();

 private:
  std::uint64_t state_;
};

/// Normal numbers of mean 0 and deviation 1 by the Box-Muller transform, which makes them in pairs.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : bits_(seed) {}

  double next();

 private:
  RandomBits bits_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace platform
