#include <result/table.h>

#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

namespace platform::result {

namespace {

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_of("0123456789") != std::string::npos &&
         (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '-' ||
          text[0] == '+');
}

/// Letters on the screen: UTF-8 continues with bytes 10xxxxxx.
std::size_t width(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

}  // namespace

TextTable::TextTable(std::vector<std::string> head) {
  rows_.push_back(std::move(head));
}

void TextTable::add(std::vector<std::string> row) {
  for (std::string& cell : row) cell = vp::visible(cell);
  rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  std::vector<bool> right(widths.size(), rows_.size() > 1);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < rows_[r].size(); ++c) {
      widths[c] = std::max(widths[c], width(rows_[r][c]));
      if (r > 0 && !rows_[r][c].empty() && !is_number(rows_[r][c])) right[c] = false;
    }
  }
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string space(widths[c] - width(row[c]), ' ');
      line += (c == 0 ? "" : "  ") + (right[c] ? space + row[c] : row[c] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string readable(double value) {
  const double size = std::fabs(value);
  if (value == std::floor(value) && size < 1e9) return vp::format_fixed(value, 0);
  if (size >= 1e9 || size < 1e-4) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }
  const int places = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
  return vp::format_fixed(value, std::min(places, 6));
}

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

namespace {

std::string last_parts(const std::string& name, std::size_t count) {
  if (name.find(' ') != std::string::npos) return name;  // an expression
  const std::vector<std::string> parts = vp::split(name, '.');
  const std::size_t first = parts.size() > count ? parts.size() - count : 0;
  return vp::join({parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end()}, ".");
}

}  // namespace

std::vector<std::string> short_names(const std::vector<std::string>& names) {
  for (std::size_t count = 1; count < 8; ++count) {
    std::vector<std::string> result;
    result.reserve(names.size());
    for (const std::string& name : names) result.push_back(last_parts(name, count));
    const std::set<std::string> different(result.begin(), result.end());
    // One part says too little where it is the word for a kind of figure.
    const bool vague = std::any_of(result.begin(), result.end(), [](const std::string& name) {
      const std::set<std::string> words{"mean", "max",       "min",   "nominal", "low",
                                        "high", "frequency", "total", "met",     "frame"};
      return words.count(name) != 0;
    });
    if (different.size() == names.size() && !vague) return result;
  }
  return names;
}

}  // namespace platform::result
