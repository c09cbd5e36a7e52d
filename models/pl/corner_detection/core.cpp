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

namespace {

/// Radius of the circle: points nearer to the border have no score.
constexpr std::uint32_t radius = 3;
constexpr std::uint32_t reach = CornerCore::reach;
constexpr std::uint32_t circle_rows = 2 * radius + 1;

/// Calls `visit` with the column of every set bit, from left to right.
template <class Visit>
void for_each_column(const std::vector<std::uint64_t>& bits, Visit visit) {
  std::uint32_t first = radius;
  for (std::uint64_t word : bits) {
    for (; word != 0; word &= word - 1) {
      visit(first + static_cast<std::uint32_t>(__builtin_ctzll(word)));
    }
    first += 64;
  }
}

fast::Thresholded look(const std::uint8_t* p, std::ptrdiff_t w, std::uint32_t threshold) {
  const fast::Circle circle = {p[-3 * w], p[-3 * w + 1], p[-2 * w + 2], p[-w + 3],
                               p[3],      p[w + 3],      p[2 * w + 2],  p[3 * w + 1],
                               p[3 * w],  p[3 * w - 1],  p[2 * w - 2],  p[w - 3],
                               p[-3],     p[-w - 3],     p[-2 * w - 2], p[-3 * w - 1]};
  return fast::threshold(circle, *p, threshold);
}

}  // namespace

CornerFrame::CornerFrame(const Geometry& geometry, std::uint32_t threshold)
    : geometry_(geometry),
      threshold_(threshold),
      next_(reach),
      last_rows_(circle_rows * (geometry.width + fast::mark_corners_overread)) {
  for (ScoreRow& row : rows_) {
    row.corners.resize((geometry.width - 2 * radius + 63) / 64);
    row.strength.resize(geometry.width);
  }
}

std::uint64_t CornerFrame::clock(const Geometry& geometry, std::uint32_t x, std::uint32_t y) {
  return CornerCore::latency + std::uint64_t{y + reach} * geometry.width + x + reach;
}

void CornerFrame::begin(const std::uint8_t* image) {
  image_ = image;
  next_ = reach;
  for (ScoreRow& row : rows_) row.y = none;
}

void CornerFrame::rewind(std::uint32_t row) {
  for (ScoreRow& scores : rows_) {
    if (scores.y != none && scores.y + radius >= row) scores.y = none;
  }
  next_ = std::max(reach, std::min(next_, row - std::min(row, reach)));
}

void CornerFrame::advance(std::uint32_t rows, std::vector<StampedWord>& corners) {
  for (; next_ + reach < rows; ++next_) {
    for (std::uint32_t y = next_ - 1; y <= next_ + 1; ++y) {
      if (scores(y).y != y) score(y);
    }
    if (scores(next_).any) find_maxima(next_, corners);
  }
}

void CornerFrame::detect(const std::uint8_t* image, std::vector<StampedWord>& corners) {
  begin(image);
  advance(geometry_.height, corners);
}

void CornerFrame::score(std::uint32_t y) {
  ScoreRow& row = scores(y);
  if (row.any) for_each_column(row.corners, [&row](std::uint32_t x) { row.strength[x] = 0; });
  row.y = y;
  mark(y, row.corners.data());
  const std::uint8_t* pixels = image_ + std::size_t{y} * geometry_.width;
  row.any = false;
  for_each_column(row.corners, [&](std::uint32_t x) {
    row.any = true;
    row.strength[x] = static_cast<std::uint16_t>(
        fast::strength(look(pixels + x, geometry_.width, threshold_).difference));
  });
}

void CornerFrame::mark(std::uint32_t y, std::uint64_t* bits) {
  const std::uint32_t width = geometry_.width, count = width - 2 * radius;
  const std::uint8_t* row = image_ + std::size_t{y} * width;
  const std::uint32_t rows_behind = geometry_.height - 1 - (y + radius);
  if (rows_behind * width >= fast::mark_corners_overread) {
    fast::mark_corners(row + radius, width, count, threshold_, bits);
    return;
  }
  // Nothing may be read behind the frame's end.
  const std::size_t stride = width + fast::mark_corners_overread;
  for (std::uint32_t i = 0; i < circle_rows; ++i) {
    const std::uint8_t* source = row + (std::ptrdiff_t{i} - radius) * width;
    std::copy(source, source + width, &last_rows_[i * stride]);
  }
  fast::mark_corners(&last_rows_[radius * stride + radius], static_cast<std::ptrdiff_t>(stride),
                     count, threshold_, bits);
}

// Strictly greater than the neighbours that came before in raster order, at least equal to those
// that come after.
void CornerFrame::find_maxima(std::uint32_t y, std::vector<StampedWord>& corners) {
  const std::uint16_t *above = scores(y - 1).strength.data(), *here = scores(y).strength.data(),
                      *below = scores(y + 1).strength.data();
  const std::uint8_t* pixels = image_ + std::size_t{y} * geometry_.width;
  const marker_logic::WordFormat words = geometry_.words();
  for_each_column(scores(y).corners, [&](std::uint32_t x) {
    if (x < reach || x + reach >= geometry_.width) return;
    const std::uint16_t s = here[x];
    if (s <= std::max({above[x - 1], above[x], above[x + 1], here[x - 1]})) return;
    if (s < std::max({here[x + 1], below[x - 1], below[x], below[x + 1]})) return;
    const std::uint32_t direction =
        fast::direction(look(pixels + x, geometry_.width, threshold_).bright);
    corners.push_back({clock(geometry_, x, y), words.corner(s, direction, x, y)});
  });
}

}  // namespace pl
