#include <marker/rectification.h>
#include <marker/work.h>

namespace marker {
namespace {

/// The pixel nearest to a point of pixel indices. White outside; NaN compares false and is white
/// too.
bool is_dark_at(const BinaryImage& image, Point point) {
  const double x = point.x + 0.5;
  const double y = point.y + 0.5;
  if (!(x >= 0 && x < image.width && y >= 0 && y < image.height)) return false;
  return image.is_dark(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
}

std::uint32_t count_dark(const BinaryImage& image, const Homography& homography, std::uint32_t left,
                         std::uint32_t top, std::uint32_t side) {
  std::uint32_t dark = 0;
  for (std::uint32_t j = top; j < top + side; ++j) {
    for (std::uint32_t i = left; i < left + side; ++i) {
      Point point{};
      if (transform(homography, {i + 0.5, j + 0.5}, point) && is_dark_at(image, point)) ++dark;
    }
  }
  return dark;
}

}  // namespace

std::uint32_t canonical_width(double wanted) {
  if (!(wanted > min_canonical_width)) return min_canonical_width;
  if (wanted >= max_canonical_width) return max_canonical_width;
  return (static_cast<std::uint32_t>(wanted) + cells_per_side / 2) / cells_per_side *
         cells_per_side;
}

Homography make_homography(const Quad& c, double width) {
  work(Work::homographies, 1);
  const double u1 = c[0].x, v1 = c[0].y, u2 = c[1].x, v2 = c[1].y;
  const double u3 = c[2].x, v3 = c[2].y, u4 = c[3].x, v4 = c[3].y;
  const double d =
      width * (u2 * v3 - u3 * v2 - u2 * v4 + u4 * v2 + u3 * v4 - u4 * v3);  // all of D.1 to D.6
  if (!(d > 0 || d < 0)) return {0, 0, u1, 0, 0, v1, 0, 0, false};

  Homography h{};
  h.h1 = (u1 * u3 * v2 - u2 * u3 * v1 - u1 * u4 * v2 + u2 * u4 * v1 - u1 * u3 * v4 + u1 * u4 * v3 +
          u2 * u3 * v4 - u2 * u4 * v3) /
         d;
  h.h2 = (-u1 * u2 * v3 + u2 * u3 * v1 + u1 * u2 * v4 - u1 * u4 * v2 + u1 * u4 * v3 - u3 * u4 * v1 -
          u2 * u3 * v4 + u3 * u4 * v2) /
         d;
  h.u1 = u1;
  h.h4 = (u1 * v2 * v3 - u2 * v1 * v3 - u1 * v2 * v4 + u2 * v1 * v4 - u3 * v1 * v4 + u4 * v1 * v3 +
          u3 * v2 * v4 - u4 * v2 * v3) /
         d;
  h.h5 = (-u1 * v2 * v3 + u3 * v1 * v2 + u2 * v1 * v4 - u4 * v1 * v2 + u1 * v3 * v4 - u3 * v1 * v4 -
          u2 * v3 * v4 + u4 * v2 * v3) /
         d;
  h.v1 = v1;
  h.h7 = (u1 * v3 - u3 * v1 - u1 * v4 - u2 * v3 + u3 * v2 + u4 * v1 + u2 * v4 - u4 * v2) / d;
  h.h8 = (-u1 * v2 + u2 * v1 + u1 * v4 - u2 * v3 + u3 * v2 - u4 * v1 - u3 * v4 + u4 * v3) / d;
  h.valid = true;
  return h;
}

bool transform(const Homography& h, Point canonical, Point& image) {
  const double w = h.h7 * canonical.x + h.h8 * canonical.y + 1;
  if (!(w > 0)) return false;
  image.x = (h.h1 * canonical.x + h.h2 * canonical.y + h.u1) / w;
  image.y = (h.h4 * canonical.x + h.h5 * canonical.y + h.v1) / w;
  return true;
}

void rectify(const BinaryImage& image, const Homography& homography, std::uint32_t width,
             CellCounts& cells) {
  const FunctionScope scope(Function::rectification);
  const std::uint32_t cell = width / cells_per_side;
  const std::uint32_t side = cell - 2;
  cells.samples_per_cell = side * side;
  for (std::uint32_t row = 0; row < cells_per_side; ++row) {
    for (std::uint32_t column = 0; column < cells_per_side; ++column) {
      cells.dark[row][column] =
          count_dark(image, homography, column * cell + 1, row * cell + 1, side);
    }
  }
  const std::uint32_t samples = cells_per_side * cells_per_side * cells.samples_per_cell;
  work(Work::grid_samples, samples);
  if (image.in_dma_memory) work(Work::grid_samples_dma, samples);
}

}  // namespace marker
