#include <scene/noise.h>
#include <scene/portable_math.h>

#include <cmath>

namespace platform {

std::uint64_t RandomBits::next() {
  state_ += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double RandomBits::next_unit() {
  constexpr double step = 1.0 / 9007199254740992.0;  // 2^-53
  return static_cast<double>((next() >> 11) + 1) * step;
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
