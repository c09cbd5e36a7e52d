#include <vp/error.h>

#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace vp {

namespace {

constexpr int max_exponent = 400;
constexpr Decimal::Whole whole_limit = Decimal::Whole{1} << 100;

/// Division of 128 bits is slow, and few numbers need them.
constexpr Decimal::Whole most_of_a_word = std::numeric_limits<std::uint64_t>::max();

bool ends_in_zero(Decimal::Whole value) {
  if (value >= 0 && value <= most_of_a_word) return static_cast<std::uint64_t>(value) % 10 == 0;
  return value % 10 == 0;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::optional<Decimal> parse_hexadecimal(std::string_view digits) {
  std::uint64_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return Decimal(value, 0);
}

/// Reads "e-12" and the like; an empty text is exponent 0.
std::optional<int> parse_exponent(std::string_view text) {
  if (text.empty()) return 0;
  if (text[0] != 'e' && text[0] != 'E') return std::nullopt;
  text.remove_prefix(1);
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  if (text.empty() || !is_digit(text[0])) return std::nullopt;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > max_exponent)
    return std::nullopt;
  return negative ? -value : value;
}

}  // namespace

Decimal::Decimal(Whole mantissa, int exponent) : mantissa_(mantissa), exponent_(exponent) {
  normalise();
}

Decimal::Decimal(double value) {
  if (!std::isfinite(value)) throw std::logic_error("vp::Decimal: not a finite number");
  char buffer[64];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
  (void)error;  // the shortest form of a double has at most 24 characters
  *this = *parse(std::string_view(buffer, end - buffer));
}

std::optional<Decimal> Decimal::parse(std::string_view text) {
  bool negative = false;
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
    negative = text[0] == '-';
    text.remove_prefix(1);
  }
  if (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") {
    if (negative) return std::nullopt;
    return parse_hexadecimal(text.substr(2));
  }
  Whole mantissa = 0;
  int significant = 0;
  int fraction_digits = 0;
  bool any = false;
  bool point = false;
  std::size_t i = 0;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !point)); ++i) {
    if (text[i] == '.') {
      point = true;
      continue;
    }
    any = true;
    fraction_digits += point;
    mantissa = mantissa * 10 + (text[i] - '0');
    if (mantissa != 0 && ++significant > max_digits) return std::nullopt;
  }
  const std::optional<int> exponent = parse_exponent(text.substr(i));
  if (!any || !exponent || fraction_digits > max_exponent) return std::nullopt;
  return Decimal(negative ? -mantissa : mantissa, *exponent - fraction_digits);
}

Decimal Decimal::scaled(std::uint32_t factor, int power) const {
  return {mantissa_ * factor, exponent_ + power};
}

void Decimal::normalise() {
  while (mantissa_ != 0 && ends_in_zero(mantissa_)) {
    mantissa_ /= 10;
    ++exponent_;
  }
  if (mantissa_ == 0) exponent_ = 0;
}

std::optional<Decimal::Whole> Decimal::whole() const {
  if (exponent_ < 0) return std::nullopt;
  Whole value = mantissa_;
  for (int i = 0; i < exponent_ && value < whole_limit && value > -whole_limit; ++i) value *= 10;
  return std::clamp(value, -whole_limit, whole_limit);
}

std::string Decimal::digits() const {
  Whole rest = negative() ? -mantissa_ : mantissa_;
  std::string low;  // of a number that is longer than most, backwards
  for (; rest > most_of_a_word; rest /= 10) {
    low += static_cast<char>('0' + static_cast<int>(rest % 10));
  }
  return std::to_string(static_cast<std::uint64_t>(rest)) + std::string(low.rbegin(), low.rend());
}

int Decimal::magnitude() const {
  return zero() ? 0 : static_cast<int>(digits().size()) - 1 + exponent_;
}

double Decimal::to_double() const {
  const std::string written = (negative() ? "-" : "") + digits() + "e" + std::to_string(exponent_);
  double value = 0.0;
  const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), value);
  (void)end;
  if (error != std::errc::result_out_of_range) return value;
  if (magnitude() < 0) return 0.0;
  return negative() ? -std::numeric_limits<double>::infinity()
                    : std::numeric_limits<double>::infinity();
}

std::string Decimal::text() const {
  constexpr int longest = 20;  // digits written out before an exponent is used: every 64-bit number
  constexpr int smallest = -7;
  const std::string all = digits();
  const int leading = zero() ? 0 : static_cast<int>(all.size()) - 1 + exponent_;
  const std::string sign = negative() ? "-" : "";
  if (leading >= longest || leading < smallest) {
    const std::string fraction = all.size() > 1 ? "." + all.substr(1) : "";
    return sign + all.substr(0, 1) + fraction + "e" + std::to_string(leading);
  }
  if (exponent_ >= 0) return sign + all + std::string(exponent_, '0');
  if (leading < 0) return sign + "0." + std::string(-leading - 1, '0') + all;
  return sign + all.substr(0, leading + 1) + "." + all.substr(leading + 1);
}

namespace {

/// One way to write a value: `1 name` is factor · 10^power base units.
struct Spelling {
  const char* name;
  std::uint32_t factor = 1;
  int power = 0;
  bool alias = false;  ///< read, but never written or listed
};

const std::vector<Spelling>& spellings(Unit unit) {
  static const std::vector<Spelling> plain{};
  static const std::vector<Spelling> frequency{
      {"Hz"}, {"fps", 1, 0, true}, {"kHz", 1, 3}, {"MHz", 1, 6}, {"GHz", 1, 9}};
  static const std::vector<Spelling> time{
      {"ps"},       {"ns", 1, 3}, {"us", 1, 6}, {"µs", 1, 6, true}, {"μs", 1, 6, true},
      {"ms", 1, 9}, {"s", 1, 12}};
  static const std::vector<Spelling> bytes{
      {"B"}, {"KiB", 1u << 10}, {"MiB", 1u << 20}, {"GiB", 1u << 30}};
  static const std::vector<Spelling> pixels{{"px"}};
  static const std::vector<Spelling> length{
      {"um", 1, -6}, {"µm", 1, -6, true}, {"μm", 1, -6, true}, {"mm", 1, -3}, {"m"}};
  static const std::vector<Spelling> power{
      {"uW", 1, -6}, {"µW", 1, -6, true}, {"μW", 1, -6, true}, {"mW", 1, -3}, {"W"}};
  static const std::vector<Spelling> energy{
      {"pJ", 1, -12},      {"nJ", 1, -9}, {"uJ", 1, -6}, {"µJ", 1, -6, true},
      {"μJ", 1, -6, true}, {"mJ", 1, -3}, {"J"}};
  static const std::vector<Spelling> voltage{{"mV", 1, -3}, {"V"}};
  static const std::vector<Spelling> cycles{{"cycles"}, {"cycle", 1, 0, true}};
  static const std::vector<Spelling> percent{{"%"}};
  static const std::vector<Spelling> angle{{"deg"}, {"°", 1, 0, true}};
  static const std::vector<Spelling> temperature{{"C"}, {"°C", 1, 0, true}};
  switch (unit) {
    case Unit::none:
    case Unit::address:
      return plain;
    case Unit::frequency:
      return frequency;
    case Unit::time:
      return time;
    case Unit::bytes:
      return bytes;
    case Unit::pixels:
      return pixels;
    case Unit::length:
      return length;
    case Unit::power:
      return power;
    case Unit::energy:
      return energy;
    case Unit::voltage:
      return voltage;
    case Unit::cycles:
      return cycles;
    case Unit::percent:
      return percent;
    case Unit::angle:
      return angle;
    case Unit::temperature:
      return temperature;
  }
  return plain;
}

/// Splits "50MHz" into "50" and "MHz".
std::pair<std::string_view, std::string_view> split_number(std::string_view text) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  std::size_t end = 0;
  if (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") {
    end = std::min(text.find_first_not_of("0123456789abcdefABCDEF", 2), text.size());
  } else {
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) ++end;
    while (digit(end) || (end < text.size() && text[end] == '.')) ++end;
    if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
      const bool sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+');
      std::size_t exponent_end = end + 1 + sign;
      if (digit(exponent_end)) {
        while (digit(exponent_end)) ++exponent_end;
        end = exponent_end;
      }
    }
  }
  return {text.substr(0, end), trim(text.substr(end))};
}

std::string format_address(const Decimal& value) {
  const auto whole = value.whole();
  if (!whole || *whole < 0) return value.text();
  std::string digits;
  for (Decimal::Whole rest = *whole; rest != 0; rest /= 16) {
    digits.insert(digits.begin(), "0123456789abcdef"[static_cast<int>(rest % 16)]);
  }
  return "0x" + std::string(digits.size() < 8 ? 8 - digits.size() : 0, '0') + digits;
}

std::string format_bytes(const Decimal& value) {
  const auto whole = value.whole();
  if (!whole || *whole == 0) return value.text() + " B";
  Decimal::Whole number = *whole;
  const auto& units = spellings(Unit::bytes);
  std::size_t unit = 0;
  for (; unit + 1 < units.size() && number % 1024 == 0; ++unit) number /= 1024;
  return Decimal(number, 0).text() + " " + units[unit].name;
}

}  // namespace

std::vector<std::string> allowed_units(Unit unit) {
  std::vector<std::string> names;
  for (const Spelling& spelling : spellings(unit)) {
    if (!spelling.alias) names.emplace_back(spelling.name);
  }
  return names;
}

std::string base_unit(Unit unit) {
  for (const Spelling& spelling : spellings(unit)) {
    if (!spelling.alias && spelling.factor == 1 && spelling.power == 0) return spelling.name;
  }
  return "";
}

Decimal parse_quantity(std::string_view text, Unit unit) {
  const auto [number, name] = split_number(trim(text));
  const std::string allowed = one_of(allowed_units(unit));
  const std::optional<Decimal> value = Decimal::parse(number);
  if (!value) {
    throw InputError("is not a number" +
                     (allowed.empty() ? "" : ": write a number and " + allowed));
  }
  if (allowed.empty()) {
    if (!name.empty())
      throw InputError("has a unit '" + std::string(name) + "': write a plain number");
    return *value;
  }
  if (name.empty()) throw InputError("has no unit: write it in " + allowed);
  for (const Spelling& spelling : spellings(unit)) {
    if (name == spelling.name) return value->scaled(spelling.factor, spelling.power);
  }
  throw InputError("has the wrong unit '" + std::string(name) + "': write it in " + allowed);
}

std::string format_quantity(const Decimal& value, Unit unit) {
  if (unit == Unit::address) return format_address(value);
  if (unit == Unit::bytes) return format_bytes(value);
  const auto& units = spellings(unit);
  if (units.empty()) return value.text();
  if (value.zero()) return "0 " + base_unit(unit);
  const Spelling* chosen = nullptr;
  for (const Spelling& spelling : units) {
    if (spelling.alias) continue;
    if (chosen == nullptr || value.magnitude() >= spelling.power) chosen = &spelling;
  }
  return value.scaled(1, -chosen->power).text() + " " + chosen->name;
}

std::string format_time(std::uint64_t ps) {
  return format_quantity(Decimal(ps, 0), Unit::time);
}

}  // namespace vp
