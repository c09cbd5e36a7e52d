#include <pl/otsu_threshold/core.h>

#include <array>

namespace pl {

namespace {

constexpr unsigned index_bits = 10, fraction_bits = 14;
using Table = std::array<std::uint16_t, 1u << index_bits>;

/// log2(1 + i/1024), bit by bit: whether the square of what is left reaches 2.
constexpr Table make_table() {
  Table table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint64_t x = std::uint64_t{table.size() + i} << 20;  // 1 to 2 in steps of 2^-30
    for (unsigned bit = 0; bit < fraction_bits; ++bit) {
      x = x * x >> 30;
      const bool set = x >> 31 != 0;
      if (set) x >>= 1;
      table[i] = static_cast<std::uint16_t>(table[i] << 1 | set);
    }
  }
  return table;
}
constexpr Table log_table = make_table();

}  // namespace

std::uint32_t coarse_log2(std::uint64_t value) {
  const auto exponent = static_cast<unsigned>(63 - __builtin_clzll(value));
  const std::uint64_t index =
      exponent >= index_bits ? value >> (exponent - index_bits) : value << (index_bits - exponent);
  return exponent << fraction_bits | log_table[index & (log_table.size() - 1)];
}

std::optional<std::uint8_t> find_otsu_threshold(const Histogram& histogram) {
  std::uint64_t n = 0, s = 0;
  for (std::uint32_t level = 0; level < histogram.size(); ++level) {
    n += histogram[level];
    s += std::uint64_t{level} * histogram[level];
  }
  std::optional<std::uint32_t> best;
  std::uint32_t first = 0, last = 0;
  std::uint64_t n0 = 0, s0 = 0;
  for (std::uint32_t level = 0; level < histogram.size(); ++level) {
    n0 += histogram[level];
    s0 += std::uint64_t{level} * histogram[level];
    if (n0 == 0 || n0 == n) continue;
    // More than 0: a pixel above the threshold is brighter than one that is not.
    const std::uint32_t variance = 2 * coarse_log2(n0 * s - n * s0) - coarse_log2(n0 * (n - n0));
    if (!best || variance > *best) {
      best = variance;
      first = last = level;
    } else if (variance == *best && last + 1 == level) {
      last = level;
    }
  }
  if (!best) return std::nullopt;
  return static_cast<std::uint8_t>((first + last) / 2);
}

}  // namespace pl
