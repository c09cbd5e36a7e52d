#include <marker/camera.h>
#include <marker/work.h>

namespace marker {
namespace {

/// A point at focal length 1 behind the lens, and how it moves with the point before it.
struct Bent {
  Point at;
  double xx, xy, yy;  ///< derivatives; the matrix is symmetric
};

Bent bend(const Lens& lens, Point p) {
  const double x2 = p.x * p.x, y2 = p.y * p.y, xy = p.x * p.y, r2 = x2 + y2;
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double slope =
      2 * (lens.k1 + r2 * (2 * lens.k2 + r2 * 3 * lens.k3));  // d radial = slope·r·dr
  Bent bent{};
  bent.at.x = p.x * radial + 2 * lens.p1 * xy + lens.p2 * (r2 + 2 * x2);
  bent.at.y = p.y * radial + lens.p1 * (r2 + 2 * y2) + 2 * lens.p2 * xy;
  bent.xx = radial + x2 * slope + 2 * lens.p1 * p.y + 6 * lens.p2 * p.x;
  bent.xy = xy * slope + 2 * lens.p1 * p.x + 2 * lens.p2 * p.y;
  bent.yy = radial + y2 * slope + 6 * lens.p1 * p.y + 2 * lens.p2 * p.x;
  return bent;
}

}  // namespace

Point distort(const Lens& lens, Point ideal) {
  if (lens.is_pinhole()) return ideal;
  const Camera& c = lens.camera;
  const Point bent = bend(lens, {(ideal.x - c.cx) / c.fx, (ideal.y - c.cy) / c.fy}).at;
  return {bent.x * c.fx + c.cx, bent.y * c.fy + c.cy};
}

bool undistort(const Lens& lens, Point image, Point& ideal) {
  std::uint32_t steps = 0;
  return undistort(lens, image, ideal, steps);
}

bool undistort(const Lens& lens, Point image, Point& ideal, [[maybe_unused]] std::uint32_t& steps) {
  ideal = image;
  if (lens.is_pinhole()) return true;
  const Camera& c = lens.camera;
  const Point wanted{(image.x - c.cx) / c.fx, (image.y - c.cy) / c.fy};
  constexpr unsigned most_steps = 20;
  constexpr double close = 1e-20;  // squared, at focal length 1: far below a pixel
  Point p = wanted;
  for (unsigned step = 0; step < most_steps; ++step) {
    const Bent bent = bend(lens, p);
    MARKERVP_COUNT(steps);
    const double dx = wanted.x - bent.at.x, dy = wanted.y - bent.at.y;
    // Where the model folds back its determinant changes sign.
    const double determinant = bent.xx * bent.yy - bent.xy * bent.xy;
    if (!(determinant > 0 && bent.xx > 0)) return false;
    if (dx * dx + dy * dy < close) {
      ideal = {p.x * c.fx + c.cx, p.y * c.fy + c.cy};
      return true;
    }
    p.x += (bent.yy * dx - bent.xy * dy) / determinant;
    p.y += (bent.xx * dy - bent.xy * dx) / determinant;
  }
  return false;
}

}  // namespace marker
