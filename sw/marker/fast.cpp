#include <marker/fast.h>
#include <marker/work.h>

namespace marker {
namespace {

/// Of the circle; points nearer to the border have none.
constexpr std::uint32_t radius = 3;
/// Points nearer to the border have no complete neighbourhood.
constexpr std::uint32_t reach = radius + 1;

/// Index 0 on top, clockwise (thesis figure A.8).
constexpr std::array<std::int8_t, 16> circle_x = {0, 1,  2,  3,  3,  3,  2,  1,
                                                  0, -1, -2, -3, -3, -3, -2, -1};
constexpr std::array<std::int8_t, 16> circle_y = {-3, -3, -2, -1, 0, 1,  2,  3,
                                                  3,  3,  2,  1,  0, -1, -2, -3};

/// Nine neighbouring ones of sixteen on the ring: runs of 2, 4, 8 and then 9.
bool has_nine_contiguous(std::uint32_t bright) {
  const std::uint32_t ring = bright | bright << 16;
  const std::uint32_t two = ring & ring >> 1;
  const std::uint32_t four = two & two >> 2;
  const std::uint32_t eight = four & four >> 4;
  return (eight & ring >> 8 & 0xFFFF) != 0;
}

/// The region of five pixels with the most bright ones; the first of equals in the order of the
/// codes.
Direction direction_of(std::uint32_t bright) {
  constexpr std::uint16_t regions[] = {0xC007, 0x07C0, 0x007C, 0x7C00};  // N S E W
  std::uint32_t best = 0, most = 0;
  for (std::uint32_t d = 0; d < 4; ++d) {
    std::uint32_t count = 0;
    for (std::uint32_t region = bright & regions[d]; region != 0; region &= region - 1) ++count;
    if (count > most) {
      most = count;
      best = d;
    }
  }
  return static_cast<Direction>(best);
}

/// Strictly greater than the neighbours that come before in raster order, at least equal to those
/// that come after.
bool is_maximum(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below) {
  const std::uint16_t s = *here;
  return s > above[-1] && s > above[0] && s > above[1] && s > here[-1] && s >= here[1] &&
         s >= below[-1] && s >= below[0] && s >= below[1];
}

}  // namespace

void CornerDetector::detect(const GreyImage& image, std::uint32_t threshold, FeatureSet& features) {
  const FunctionScope scope(Function::corner_detection);
  threshold_ = threshold;
  survivors_ = bright_ = points_ = 0;
  lay_circle(static_cast<std::int32_t>(image.width));
  const std::uint32_t before = features.corner_count + features.lost_corners;
  score(image, radius);
  score(image, radius + 1);
  for (std::uint32_t y = reach; y + reach < image.height; ++y) {
    score(image, y + 1);
    suppress(image, y, features);
  }
  count_work(image, features.corner_count + features.lost_corners - before);
}

void CornerDetector::lay_circle(std::int32_t width) {
  for (std::uint32_t n = 0; n < 16; ++n) circle_[n] = circle_y[n] * width + circle_x[n];
}

void CornerDetector::score(const GreyImage& image, std::uint32_t y) {
  Row& row = rows_[y % 3];
  std::uint16_t* const strength = row.strength.data();
  std::uint16_t* const bright = row.bright.data();
  const std::uint8_t* const line = image.pixels + y * image.width;
  const std::int32_t down = static_cast<std::int32_t>(radius * image.width);
  const std::uint32_t end = image.width - radius;
  for (std::uint32_t x = radius; x < end; ++x) {
    const std::uint8_t* const point = line + x;
    const std::uint32_t limit = *point + threshold_;
    const std::uint32_t north = point[-down] > limit, east = point[3] > limit,
                        south = point[down] > limit, west = point[-3] > limit;
    strength[x] = 0;
    // Two adjacent ones: one of north and south, and one of east and west.
    if (((north | south) & (east | west)) == 0) continue;
    MARKERVP_COUNT(survivors_);
    strength[x] = static_cast<std::uint16_t>(examine(point, bright + x));
  }
}

/// The whole test: the strength (equations 3.1, 4.1 and 4.2), 0 if the point is no corner.
std::uint32_t CornerDetector::examine(const std::uint8_t* point, std::uint16_t* bright) {
  const std::int32_t* const circle = circle_.data();
  const std::int32_t limit = static_cast<std::int32_t>(*point + threshold_);
  std::uint32_t above = 0;
  std::int32_t strength = 0;
  for (std::uint32_t n = 0; n < 16; ++n) {
    const std::int32_t difference = point[circle[n]] - limit;
    if (difference <= 0) continue;
    MARKERVP_COUNT(bright_);
    above |= 1u << n;
    strength += difference;
  }
  if (!has_nine_contiguous(above)) return 0;
  MARKERVP_COUNT(points_);
  *bright = static_cast<std::uint16_t>(above);
  return static_cast<std::uint32_t>(strength);
}

void CornerDetector::suppress(const GreyImage& image, std::uint32_t y, FeatureSet& features) {
  const std::uint16_t* const above = rows_[(y - 1) % 3].strength.data();
  const std::uint16_t* const here = rows_[y % 3].strength.data();
  const std::uint16_t* const below = rows_[(y + 1) % 3].strength.data();
  const std::uint32_t end = image.width - reach;
  for (std::uint32_t x = reach; x < end; ++x) {
    if (here[x] == 0 || !is_maximum(above + x, here + x, below + x)) continue;
    // The packet of the PL has room for ten of the twelve bits.
    features.push(Corner{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                         static_cast<std::uint16_t>(here[x] >> 2),
                         direction_of(rows_[y % 3].bright[x]), 0});
  }
}

void CornerDetector::count_work(const GreyImage& image, std::uint32_t corners) const {
  const std::uint64_t rows = image.height - 2 * radius;
  work(Work::corner_frames, 1);
  work(Work::corner_rows, rows);
  work(Work::corner_pixels, rows * (image.width - 2 * radius));
  work(Work::corner_survivors, survivors_);
  work(Work::corner_bright, bright_);
  work(Work::corner_points, points_);
  work(Work::corners_found, corners);
}

}  // namespace marker
