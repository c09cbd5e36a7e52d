#include <sweep/csv_line.h>

#include <array>
#include <charconv>
#include <cmath>

#include <vp/decimal.h>

namespace platform::sweep {

namespace {

/// Between them a number's shortest digits, written out, are at most 22.
constexpr double least_plain = 1e-5, most_plain = 1e15;

void append_field(std::string& line, const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += c;
    line += c;
  }
  line += '"';
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i != 0) line += ',';
    append_field(line, fields[i]);
  }
  line += '\n';
  return line;
}

std::string csv_number(double value) {
  const double size = std::abs(value);
  if (size < least_plain || size > most_plain) return vp::Decimal(value).text();
  // The same digits, without taking the number apart: most figures of a sweep are such.
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

}  // namespace platform::sweep
