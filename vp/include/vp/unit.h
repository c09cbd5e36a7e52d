#pragma once

#include <vp/decimal.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

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
