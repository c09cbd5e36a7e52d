#include <cmath>

#include <marker/scene/portable_math.h>

namespace platform {

namespace {

constexpr double ln_2 = 0.69314718055994530942;
constexpr double sqrt_half = 0.70710678118654752440;
constexpr double half_pi = 1.57079632679489661923;

/// Taylor series, |x| <= pi/4: the first term left out is below 3e-17.
SinCos sin_cos_small(double x) {
  const double x2 = x * x;
  double s = 1.0 / 1307674368000.0;  // 1/15!
  s = 1.0 / 6227020800.0 - x2 * s;
  s = 1.0 / 39916800.0 - x2 * s;
  s = 1.0 / 362880.0 - x2 * s;
  s = 1.0 / 5040.0 - x2 * s;
  s = 1.0 / 120.0 - x2 * s;
  s = 1.0 / 6.0 - x2 * s;
  s = x - x * x2 * s;
  double c = 1.0 / 20922789888000.0;  // 1/16!
  c = 1.0 / 87178291200.0 - x2 * c;
  c = 1.0 / 479001600.0 - x2 * c;
  c = 1.0 / 3628800.0 - x2 * c;
  c = 1.0 / 40320.0 - x2 * c;
  c = 1.0 / 720.0 - x2 * c;
  c = 1.0 / 24.0 - x2 * c;
  c = 0.5 - x2 * c;
  c = 1.0 - x2 * c;
  return {s, c};
}

/// `quarters` quarter turns plus `rest` radians, |rest| <= pi/4.
SinCos sin_cos_reduced(long long quarters, double rest) {
  const SinCos small = sin_cos_small(rest);
  switch (quarters & 3) {
    case 0:
      return small;
    case 1:
      return {small.cos, -small.sin};
    case 2:
      return {-small.sin, -small.cos};
    default:
      return {-small.cos, small.sin};
  }
}

}  // namespace

double portable_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // exact
  if (mantissa < sqrt_half) {
    mantissa *= 2;
    --exponent;
  }
  // log(m) = 2 atanh((m - 1) / (m + 1)); the argument is at most 0.172.
  const double s = (mantissa - 1) / (mantissa + 1);
  const double s2 = s * s;
  double sum = 1.0 / 17;
  sum = 1.0 / 15 + s2 * sum;
  sum = 1.0 / 13 + s2 * sum;
  sum = 1.0 / 11 + s2 * sum;
  sum = 1.0 / 9 + s2 * sum;
  sum = 1.0 / 7 + s2 * sum;
  sum = 1.0 / 5 + s2 * sum;
  sum = 1.0 / 3 + s2 * sum;
  sum = 1.0 + s2 * sum;
  return exponent * ln_2 + 2 * s * sum;
}

double portable_exp_negative(double x) {
  constexpr int squarings = 10;
  const double small = x / (1 << squarings);
  double power = 1;
  for (int n = 16; n >= 1; --n) power = 1 + power * small / n;
  for (int i = 0; i < squarings; ++i) power *= power;
  return power;
}

SinCos portable_sin_cos_degrees(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  const double rest = degrees - 90 * quarters;
  return sin_cos_reduced(static_cast<long long>(quarters), rest / 90 * half_pi);
}

SinCos portable_sin_cos_turn(double turn) {
  const double quarters = std::floor(turn * 4 + 0.5);
  return sin_cos_reduced(static_cast<long long>(quarters), (turn * 4 - quarters) * half_pi);
}

double GaussianNoise::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2 * portable_log(bits_.next_unit()));
  const SinCos angle = portable_sin_cos_turn(bits_.next_unit());
  spare_ = radius * angle.sin;
  has_spare_ = true;
  return radius * angle.cos;
}

}  // namespace platform
