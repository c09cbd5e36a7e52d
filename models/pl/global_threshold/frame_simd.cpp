#include <pl/global_threshold/core.h>

#include <cstring>

// Compiled once for every instruction set; the best one of the host is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pl/global_threshold/frame_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pl::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void pack_dark(const std::uint8_t* pixels, std::size_t words, std::uint8_t threshold,
               std::uint32_t* binary) {
  const hn::CappedTag<std::uint8_t, 32> d;  // whole words at any width
  const std::size_t lanes = hn::Lanes(d);
  const auto limit = hn::Set(d, threshold);
  const auto zero = hn::Zero(d);
  for (std::size_t w = 0; w < words; ++w, pixels += 32) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 32; i += lanes) {
      const auto above = hn::SaturatedSub(hn::LoadU(d, pixels + i), limit);
      std::uint8_t marks[8] = {};
      hn::StoreMaskBits(d, hn::Eq(above, zero), marks);
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

HWY_EXPORT(pack_dark);

void pack_dark(const std::uint8_t* pixels, std::size_t words, std::uint8_t threshold,
               std::uint32_t* binary) {
  HWY_DYNAMIC_DISPATCH(pack_dark)(pixels, words, threshold, binary);
}

}  // namespace pl

#endif  // HWY_ONCE
