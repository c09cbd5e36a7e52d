#pragma once

#include <cstdint>

namespace calibration {

/// The same numbers on every machine (xorshift64*).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E37'79B9'7F4A'7C15u + 1) {}

  /// 0 … `end` − 1.
  std::uint32_t below(std::uint32_t end) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>((state_ * 0x2545'F491'4F6C'DD1Du) >> 32) % end;
  }
  /// `first` … `last`.
  std::int32_t between(std::int32_t first, std::int32_t last) {
    return first + static_cast<std::int32_t>(below(static_cast<std::uint32_t>(last - first) + 1));
  }
  /// 0 ≤ x < 1.
  double unit() { return below(1u << 24) / static_cast<double>(1u << 24); }

 private:
  std::uint64_t state_;
};

}  // namespace calibration
