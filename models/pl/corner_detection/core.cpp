#include <pl/corner_detection/core.h>

#include <algorithm>

namespace pl {

namespace fast {

Thresholded threshold(const Circle& circle, std::uint8_t point, std::uint32_t threshold) {
  Thresholded result;
  const std::uint32_t limit = point + threshold;  // nine bits: does not wrap
  for (unsigned n = 0; n < 16; ++n) {
    if (circle[n] <= limit) continue;
    result.bright = static_cast<std::uint16_t>(result.bright | 1u << n);
    result.difference[n] = static_cast<std::uint8_t>(circle[n] - limit);
  }
  return result;
}

bool contiguous(std::uint16_t bright) {
  // Runs of 2, 4, 8 and then 9 on the ring laid out twice.
  const std::uint32_t ring = bright | std::uint32_t{bright} << 16;
  const std::uint32_t two = ring & ring >> 1;
  const std::uint32_t four = two & two >> 2;
  const std::uint32_t eight = four & four >> 4;
  return (eight & ring >> 8 & 0xFFFF) != 0;
}

std::uint32_t strength(const std::array<std::uint8_t, 16>& difference) {
  std::uint32_t sum = 0;
  for (std::uint8_t d : difference) sum += d;
  return sum;
}

std::uint32_t direction(std::uint16_t bright) {
  constexpr std::uint16_t north = 0xC007, south = 0x07C0, east = 0x007C, west = 0x7C00;
  constexpr std::uint16_t regions[] = {north, south, east, west};
  std::uint32_t best = 0;
  int most = -1;
  for (std::uint32_t d = 0; d < 4; ++d) {
    const int count = __builtin_popcount(bright & regions[d]);
    if (count > most) {
      most = count;
      best = d;
    }
  }
  return best;
}

}  // namespace fast

CornerCore::CornerCore(const Geometry& geometry, std::uint32_t threshold)
    : width_(geometry.width),
      threshold_(threshold),
      pixels_(8 * geometry.width),
      scores_(4 * geometry.width) {}

void CornerCore::reset() {
  std::fill(pixels_.begin(), pixels_.end(), 0);
  std::fill(scores_.begin(), scores_.end(), Score{});
  x_ = y_ = 0;
}

bool CornerCore::push(std::uint8_t pixel, std::uint32_t x, std::uint32_t y, Corner& corner) {
  x_ = x;
  y_ = y;
  pixels_[(y % 8) * width_ + x] = pixel;
  // The one new point of interest: right of and below the centre. Windows that wrap around a line's
  // end do not count.
  if (x < 6 || y < 6) return false;
  scores_[((y - 3) % 4) * width_ + x - 3] = score(x - 3, y - 3);
  if (x < 2 * reach || y < 2 * reach) return false;
  const std::uint32_t cx = x - reach, cy = y - reach;
  const Score centre = scores(cy)[cx];
  if (centre.strength == 0 || !is_maximum(cx, cy)) return false;
  corner = {cx, cy, centre.strength, centre.direction};
  return true;
}

CornerCore::Score CornerCore::score(std::uint32_t x, std::uint32_t y) const {
  const std::uint8_t *m3 = row(y - 3) + x, *m2 = row(y - 2) + x, *m1 = row(y - 1) + x,
                     *p0 = row(y) + x, *p1 = row(y + 1) + x, *p2 = row(y + 2) + x,
                     *p3 = row(y + 3) + x;
  // Nine of sixteen always take in the top or the bottom, and the left or the right pixel.
  const std::uint32_t limit = *p0 + threshold_;
  if (*m3 <= limit && *p3 <= limit) return {};
  if (p0[3] <= limit && p0[-3] <= limit) return {};
  const fast::Circle circle = {m3[0], m3[1],  m2[2],  m1[3],  p0[3],  p1[3],  p2[2],  p3[1],
                               p3[0], p3[-1], p2[-2], p1[-3], p0[-3], m1[-3], m2[-2], m3[-1]};
  const fast::Thresholded t = fast::threshold(circle, *p0, threshold_);
  if (!fast::contiguous(t.bright)) return {};
  return {static_cast<std::uint16_t>(fast::strength(t.difference)),
          static_cast<std::uint8_t>(fast::direction(t.bright))};
}

// Strictly greater than the neighbours that came before in raster order, at least equal to those
// that come after.
bool CornerCore::is_maximum(std::uint32_t x, std::uint32_t y) const {
  const Score *above = scores(y - 1) + x, *here = scores(y) + x, *below = scores(y + 1) + x;
  const std::uint16_t s = here->strength;
  return s > above[-1].strength && s > above[0].strength && s > above[1].strength &&
         s > here[-1].strength && s >= here[1].strength && s >= below[-1].strength &&
         s >= below[0].strength && s >= below[1].strength;
}

}  // namespace pl
