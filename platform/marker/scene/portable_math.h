#pragma once

#include <cstdint>

#include <vp/random.h>

namespace platform {

/// The few functions that the renderer needs, from + - * / alone: libm's may differ in the last bit
/// between versions, and one flipped pixel would change a golden trace.

struct SinCos {
  double sin;
  double cos;
};

/// Natural logarithm of a normal x > 0. Relative error below 1e-14.
double portable_log(double x);

/// e to the power of x, x in [-700, 0]. Relative error below 1e-12.
double portable_exp_negative(double x);

/// Sine and cosine of an angle in degrees, |degrees| < 1e9. Absolute error below 1e-15; exact at
/// multiples of 90.
SinCos portable_sin_cos_degrees(double degrees);

/// Sine and cosine of a fraction of a full turn, [0, 1]. Absolute error below 1e-15; exact at
/// quarters.
SinCos portable_sin_cos_turn(double turn);

/// Normal numbers of mean 0 and deviation 1 by the Box-Muller transform, which makes them in pairs.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : bits_(seed) {}

  double next();

 private:
  vp::RandomBits bits_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace platform
