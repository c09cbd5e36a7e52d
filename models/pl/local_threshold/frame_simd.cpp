#include <pl/local_threshold/core.h>

#include <algorithm>
#include <cstring>

// Compiled once for every instruction set; the best one of the host is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pl/local_threshold/frame_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pl::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void pack_locally_dark(const std::uint8_t* pixels, std::size_t words, const LocalRule& rule,
                       const std::uint32_t* before, const std::uint32_t* behind,
                       const std::uint32_t* counts, std::uint32_t* binary) {
  const hn::CappedTag<std::uint32_t, 32> d;  // whole words at any width
  const hn::Rebind<std::uint8_t, decltype(d)> bytes;
  const std::size_t lanes = hn::Lanes(d);
  const auto level = hn::Set(d, rule.level), offset = hn::Set(d, rule.offset);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 32;
         i += lanes, pixels += lanes, before += lanes, behind += lanes, counts += lanes) {
      const auto pixel = hn::PromoteTo(d, hn::LoadU(bytes, pixels));
      const auto sum = hn::Sub(hn::LoadU(d, behind), hn::LoadU(d, before));
      const auto count = hn::LoadU(d, counts);
      auto distance = hn::Mul(count, offset);
      if (rule.relative != 0)
        distance = hn::Max(distance, hn::ShiftRightSame(sum, static_cast<int>(rule.relative)));
      // Not above, by the larger of both: Highway 1.0 compares unsigned words for equality alone.
      const auto limit = hn::Add(hn::Mul(count, pixel), distance);
      const auto darker = hn::Eq(hn::Max(limit, sum), sum);
      std::uint8_t marks[8] = {};
      hn::StoreMaskBits(d, hn::Or(darker, hn::Eq(hn::Max(pixel, level), level)), marks);
      std::uint32_t part;
      std::memcpy(&part, marks, sizeof part);
      word |= part << i;
    }
    binary[w] = word;
  }
}

}  // namespace pl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace pl {

HWY_EXPORT(pack_locally_dark);

void find_dark(const std::uint8_t* image, const Geometry& geometry, const LocalRule& rule,
               std::vector<std::uint32_t>& words) {
  const std::uint32_t width = geometry.width, height = geometry.height, radius = rule.radius;
  words.resize(geometry.pixels() / 32);
  std::vector<std::uint32_t> columns(width), counts(width);
  // Sums of all columns to the left of one, with the window's reach beyond both ends of the row.
  std::vector<std::uint32_t> sums(width + 2 * radius + 1);
  const auto add_row = [&](std::uint32_t row, std::uint32_t sign) {
    const std::uint8_t* pixels = image + std::size_t{row} * width;
    for (std::uint32_t x = 0; x < width; ++x) columns[x] += sign * pixels[x];
  };
  for (std::uint32_t row = 0; row < radius; ++row) add_row(row, 1);
  for (std::uint32_t y = 0; y < height; ++y) {
    if (y + radius < height) add_row(y + radius, 1);
    if (y > radius) add_row(y - radius - 1, ~0u);
    if (y <= radius || y + radius >= height) {
      const std::uint32_t rows = window_reach(y, radius, height);
      for (std::uint32_t x = 0; x < width; ++x) counts[x] = rows * window_reach(x, radius, width);
    }
    std::uint32_t sum = 0;
    for (std::uint32_t x = 0; x < width; ++x) sums[radius + 1 + x] = sum += columns[x];
    std::fill(sums.end() - radius, sums.end(), sum);
    HWY_DYNAMIC_DISPATCH(pack_locally_dark)
    (image + std::size_t{y} * width, width / 32, rule, sums.data(), sums.data() + 2 * radius + 1,
     counts.data(), &words[std::size_t{y} * width / 32]);
  }
}

}  // namespace pl

#endif  // HWY_ONCE
