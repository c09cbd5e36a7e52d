#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vp {

/// An exact decimal number: mantissa · 10^exponent. Values with units go through it, so that 148.5
/// MHz is 148500000 Hz to the last digit and every printed value reads back as itself. Nothing here
/// depends on the locale.
class Decimal {
 public:
  using Whole = __int128;

  /// Most digits a number may be written with.
  static constexpr int max_digits = 24;

  Decimal() = default;
  Decimal(Whole mantissa, int exponent);
  /// The shortest decimal that reads back as `value`, which must be finite.
  explicit Decimal(double value);

  /// Reads "12", "-0.5", "1e6", "0x41200000"; nothing for anything else or more than max_digits
  /// digits.
  static std::optional<Decimal> parse(std::string_view text);

  /// The value times factor · 10^power, exactly. factor is at most 2^30.
  Decimal scaled(std::uint32_t factor, int power) const;

  /// The value if it is a whole number that fits into 100 bits.
  std::optional<Whole> whole() const;
  /// The nearest double.
  double to_double() const;
  /// Without an exponent where that is readable: "148.5", "0.06", "-3"; "1e-12" for the very small
  /// and large.
  std::string text() const;

  bool negative() const { return mantissa_ < 0; }
  bool zero() const { return mantissa_ == 0; }
  /// Power of ten of the leading digit: 2 for 148.5, -2 for 0.06. 0 for zero.
  int magnitude() const;

 private:
  void normalise();
  std::string digits() const;

  Whole mantissa_ = 0;  ///< no trailing zeros
  int exponent_ = 0;
};

}  // namespace vp
