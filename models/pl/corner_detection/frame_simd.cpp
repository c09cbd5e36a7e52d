#include <pl/corner_detection/core.h>

#include <cstring>

// Compiled once for every instruction set; the best one of the host is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pl/corner_detection/frame_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pl::fast::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// At most 64 pixels at a time, so that the reach behind a row is known.
using Pixels = hn::CappedTag<std::uint8_t, 64>;
using Vector = hn::Vec<Pixels>;

/// Circle pixel `n` (modulo 16; 0 on top, clockwise) of the points at `p`.
HWY_INLINE Vector circle(Pixels d, const std::uint8_t* p, std::ptrdiff_t stride, int n) {
  constexpr int dx[16] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  constexpr int dy[16] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  return hn::LoadU(d, p + dy[n & 15] * stride + dx[n & 15]);
}

/// The lower of circle pixels `n` and `n` + 1.
HWY_INLINE Vector pair(Pixels d, const std::uint8_t* p, std::ptrdiff_t stride, int n) {
  return hn::Min(circle(d, p, stride, n), circle(d, p, stride, n + 1));
}

/// The better of the two arcs of nine that hold the eight pixels from `n` on, whose quarters are
/// `first` and `second`.
HWY_INLINE Vector arcs(Pixels d, const std::uint8_t* p, std::ptrdiff_t stride, int n, Vector first,
                       Vector second) {
  return hn::Min(hn::Min(first, second),
                 hn::Max(circle(d, p, stride, n + 15), circle(d, p, stride, n + 8)));
}

/// The greatest of the least pixels of the sixteen arcs: some arc is brighter than a limit if this
/// is.
HWY_INLINE Vector brightest_arc(Pixels d, const std::uint8_t* p, std::ptrdiff_t s) {
  const Vector p1 = pair(d, p, s, 1), p3 = pair(d, p, s, 3), p5 = pair(d, p, s, 5),
               p7 = pair(d, p, s, 7), p9 = pair(d, p, s, 9), p11 = pair(d, p, s, 11),
               p13 = pair(d, p, s, 13), p15 = pair(d, p, s, 15);
  const Vector q1 = hn::Min(p1, p3), q3 = hn::Min(p3, p5), q5 = hn::Min(p5, p7),
               q7 = hn::Min(p7, p9), q9 = hn::Min(p9, p11), q11 = hn::Min(p11, p13),
               q13 = hn::Min(p13, p15), q15 = hn::Min(p15, p1);
  const Vector a = hn::Max(arcs(d, p, s, 1, q1, q5), arcs(d, p, s, 3, q3, q7));
  const Vector b = hn::Max(arcs(d, p, s, 5, q5, q9), arcs(d, p, s, 7, q7, q11));
  const Vector c = hn::Max(arcs(d, p, s, 9, q9, q13), arcs(d, p, s, 11, q11, q15));
  const Vector e = hn::Max(arcs(d, p, s, 13, q13, q1), arcs(d, p, s, 15, q15, q3));
  return hn::Max(hn::Max(a, b), hn::Max(c, e));
}

void mark_corners(const std::uint8_t* points, std::ptrdiff_t stride, std::uint32_t count,
                  std::uint32_t threshold, std::uint64_t* bits) {
  const Pixels d;
  const std::uint32_t lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const Vector zero = hn::Zero(d), margin = hn::Set(d, static_cast<std::uint8_t>(threshold));
  auto* bytes = reinterpret_cast<std::uint8_t*>(bits);
  std::memset(bytes, 0, (count + 63) / 64 * 8);
  for (std::uint32_t x = 0; x < count; x += lanes) {
    const std::uint8_t* p = points + x;
    // Nine bits in hardware: what would not fit into eight is exceeded by no pixel.
    const Vector limit = hn::SaturatedAdd(hn::LoadU(d, p), margin);
    // Nine of sixteen always take in the top or the bottom, and the left or the right pixel.
    const Vector vertical = hn::Max(hn::LoadU(d, p - 3 * stride), hn::LoadU(d, p + 3 * stride));
    const Vector horizontal = hn::Max(hn::LoadU(d, p - 3), hn::LoadU(d, p + 3));
    const Vector compass = hn::SaturatedSub(hn::Min(vertical, horizontal), limit);
    if (hn::AllTrue(d, hn::Eq(compass, zero))) continue;
    const Vector excess = hn::SaturatedSub(brightest_arc(d, p, stride), limit);
    std::uint8_t marks[hn::MaxLanes(d) < 64 ? 8 : hn::MaxLanes(d) / 8];
    const std::size_t written = hn::StoreMaskBits(d, hn::Not(hn::Eq(excess, zero)), marks);
    if (lanes >= 8) {
      std::memcpy(bytes + x / 8, marks, written);
    } else {
      bytes[x / 8] = static_cast<std::uint8_t>(bytes[x / 8] | marks[0] << x % 8);
    }
  }
  if (count % 64 != 0) bits[count / 64] &= (std::uint64_t{1} << count % 64) - 1;
}

}  // namespace pl::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace pl::fast {

HWY_EXPORT(mark_corners);

void mark_corners(const std::uint8_t* points, std::ptrdiff_t stride, std::uint32_t count,
                  std::uint32_t threshold, std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(mark_corners)(points, stride, count, threshold, bits);
}

}  // namespace pl::fast

#endif  // HWY_ONCE
