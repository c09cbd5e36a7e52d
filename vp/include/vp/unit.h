#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// The dimension of a value. The comment names the base unit, in which models keep the number, and
/// what may be written.
enum class Unit {
  none,         ///< a plain number
  address,      ///< a plain number, printed in hexadecimal
  frequency,    ///< Hz: Hz kHz MHz GHz
  time,         ///< ps: ps ns us (µs) ms s
  bytes,        ///< B: B KiB MiB GiB
  pixels,       ///< px
  length,       ///< m: um (µm) mm m
  power,        ///< W: uW (µW) mW W
  energy,       ///< J: pJ nJ uJ (µJ) mJ J
  voltage,      ///< V: mV V
  cycles,       ///< cycles (cycle)
  percent,      ///< %
  angle,        ///< deg
  temperature,  ///< C (°C)
};

/// The units a value of this dimension may be written in, smallest first; empty for a plain number.
std::vector<std::string> allowed_units(Unit unit);

/// The unit in which models keep the value: "Hz", "ps", … ; "" for a plain number.
std::string base_unit(Unit unit);

/// Reads "50 MHz", "50MHz", "0.3 m", "24 px" into the base unit, exactly.
/// Throws InputError if the number or its unit is malformed, missing, or of another dimension; the
/// message continues a sentence that began with the key and value: "has no unit: write it in Hz,
/// kHz, MHz or GHz".
Decimal parse_quantity(std::string_view text, Unit unit);

/// The value in the unit that makes it readable: "50 MHz", "148.5 MHz", "60 mm". parse_quantity()
/// reads it back exactly.
std::string format_quantity(const Decimal& value, Unit unit);

/// A time in picoseconds, readable: "12.345 us".
std::string format_time(std::uint64_t ps);

/// Values in base units for defaults and tests: `50_MHz` is 50'000'000 Hz, `60_ns` is 60'000 ps.
inline namespace literals {
constexpr std::uint64_t operator""_Hz(unsigned long long value) {
  return value;
}
constexpr std::uint64_t operator""_kHz(unsigned long long value) {
  return value * 1'000;
}
constexpr std::uint64_t operator""_MHz(unsigned long long value) {
  return value * 1'000'000;
}
constexpr std::uint64_t operator""_ps(unsigned long long value) {
  return value;
}
constexpr std::uint64_t operator""_ns(unsigned long long value) {
  return value * 1'000;
}
constexpr std::uint64_t operator""_us(unsigned long long value) {
  return value * 1'000'000;
}
constexpr std::uint64_t operator""_ms(unsigned long long value) {
  return value * 1'000'000'000;
}
constexpr std::uint64_t operator""_s(unsigned long long value) {
  return value * 1'000'000'000'000;
}
constexpr std::uint64_t operator""_KiB(unsigned long long value) {
  return value << 10;
}
constexpr std::uint64_t operator""_MiB(unsigned long long value) {
  return value << 20;
}
constexpr std::uint64_t operator""_GiB(unsigned long long value) {
  return value << 30;
}
}  // namespace literals

}  // namespace vp
