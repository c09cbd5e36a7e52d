#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <utility>

namespace vp {
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
