#include <vp/decimal.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

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

}  // namespace vp
