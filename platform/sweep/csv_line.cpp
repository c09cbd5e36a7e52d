#include <sweep/csv_line.h>

#include <vp/decimal.h>

namespace platform::sweep {

namespace {

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
  return vp::Decimal(value).text();
}

}  // namespace platform::sweep
