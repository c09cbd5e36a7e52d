#include <cli/map_fields.h>

#include <fmt/format.h>

namespace platform::cli {

std::string bits_text(std::uint32_t mask) {
  constexpr unsigned most_ranges = 4;
  std::string text;
  unsigned ranges = 0;
  for (int high = 31; high >= 0; --high) {
    if ((mask >> high & 1) == 0) continue;
    int low = high;
    while (low > 0 && (mask >> (low - 1) & 1) != 0) --low;
    if (!text.empty()) text += ", ";
    text += high == low ? std::to_string(high) : fmt::format("{}:{}", high, low);
    ++ranges;
    high = low;
  }
  return ranges > most_ranges ? fmt::format("0x{:08X}", mask) : text;
}

FieldsOnce::Found FieldsOnce::find(const report::HardwareMap::Register& r) {
  if (r.fields.empty()) return {none_, ""};
  const auto [place, first] = shown_.emplace(r.fields_of_kind, r.name);
  if (first) return {r.fields, ""};
  return {none_, place->second};
}

}  // namespace platform::cli
