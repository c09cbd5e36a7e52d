#include <pl/corner_detection/frame.h>

#include <algorithm>

#include <pl/corner_detection/core.h>

namespace pl {

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
