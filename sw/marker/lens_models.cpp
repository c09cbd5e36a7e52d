#include <marker/angles.h>
#include <marker/lens_models.h>
#include <marker/work.h>

#include <algorithm>
#include <cmath>

namespace marker {
namespace {

/// Steps of Newton's method, and how near it must come, squared, at focal length 1.
constexpr unsigned most_steps = 20;
constexpr double close = 1e-20;

/// A point at focal length 1 behind the lens, and how it moves with the point before it.
struct Bent {
  Point at;
  double xx, xy, yx, yy;  ///< derivatives: xy is that of x by y
  bool valid;             ///< false: beyond the model's pole
};

/// Brown–Conrady's radial polynomial over another one, tangential terms, thin prism. Not inlined:
/// so one unit of work says what it costs.
[[gnu::noinline]] Bent bend(const std::array<double, 12>& k, Point p) {
  const double x2 = p.x * p.x, y2 = p.y * p.y, xy = p.x * p.y, r2 = x2 + y2;
  const double p1 = k[2], p2 = k[3];
  const double above = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double below = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  Bent bent{};
  bent.valid = below > 0;
  if (!bent.valid) return bent;
  const double radial = above / below;
  const double above_slope = k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]);
  const double below_slope = k[5] + r2 * (2 * k[6] + r2 * 3 * k[7]);
  const double slope = 2 * (above_slope - radial * below_slope) / below;  // d radial = slope·r·dr
  const double prism_x = k[8] + 2 * k[9] * r2, prism_y = k[10] + 2 * k[11] * r2;
  bent.at.x = p.x * radial + 2 * p1 * xy + p2 * (r2 + 2 * x2) + r2 * (k[8] + k[9] * r2);
  bent.at.y = p.y * radial + p1 * (r2 + 2 * y2) + 2 * p2 * xy + r2 * (k[10] + k[11] * r2);
  const double both = xy * slope + 2 * p1 * p.x + 2 * p2 * p.y;
  bent.xx = radial + x2 * slope + 2 * p1 * p.y + 6 * p2 * p.x + 2 * p.x * prism_x;
  bent.xy = both + 2 * p.y * prism_x;
  bent.yx = both + 2 * p.x * prism_y;
  bent.yy = radial + y2 * slope + 6 * p1 * p.y + 2 * p2 * p.x + 2 * p.y * prism_y;
  return bent;
}

/// False where the model folds back: its determinant changes sign there.
bool straighten(const std::array<double, 12>& k, Point wanted, Point& p,
                [[maybe_unused]] std::uint32_t& steps) {
  p = wanted;
  for (unsigned step = 0; step < most_steps; ++step) {
    const Bent bent = bend(k, p);
    MARKERVP_COUNT(steps);
    const double determinant = bent.xx * bent.yy - bent.xy * bent.yx;
    if (!(bent.valid && determinant > 0 && bent.xx > 0)) return false;
    const double dx = wanted.x - bent.at.x, dy = wanted.y - bent.at.y;
    if (dx * dx + dy * dy < close) return true;
    p.x += (bent.yy * dx - bent.xy * dy) / determinant;
    p.y += (bent.xx * dy - bent.yx * dx) / determinant;
  }
  return false;
}

/// The radius in the picture, at focal length 1, of a ray at this angle, and its slope.
struct Radius {
  double radius, slope;
};

Radius radius_of(const std::array<double, 12>& k, double angle) {
  const double s = angle * angle;
  return {angle * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))),
          1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3])))};
}

Point bend_equidistant(const std::array<double, 12>& k, Point p) {
  const double r = std::sqrt(p.x * p.x + p.y * p.y);
  if (!(r > 0)) return p;
  return radius_of(k, angle_of(r)).radius / r * p;
}

bool straighten_equidistant(const std::array<double, 12>& k, Point wanted, Point& p,
                            [[maybe_unused]] std::uint32_t& steps) {
  p = wanted;
  const double radius = std::sqrt(wanted.x * wanted.x + wanted.y * wanted.y);
  if (!(radius > 0)) return true;
  double angle = std::min(radius, widest_angle);
  for (unsigned step = 0; step < most_steps; ++step) {
    const Radius at = radius_of(k, angle);
    MARKERVP_COUNT(steps);
    if (!(at.slope > 0)) return false;
    const double off = radius - at.radius;
    if (off * off < close) {
      if (!(angle > 0 && angle <= widest_angle)) return false;
      p = tangent(angle) / radius * wanted;
      return true;
    }
    angle += off / at.slope;
  }
  return false;
}

}  // namespace

bool GeneralLens::is_pinhole() const {
  return model != LensModel::equidistant &&
         std::all_of(coefficients.begin(), coefficients.end(), [](double k) { return k == 0; });
}

Point distort(const GeneralLens& lens, Point ideal) {
  if (lens.is_pinhole()) return ideal;
  const Camera& c = lens.camera;
  const Point p{(ideal.x - c.cx) / c.fx, (ideal.y - c.cy) / c.fy};
  const bool is_fisheye = lens.model == LensModel::equidistant;
  work(is_fisheye ? Work::lens_angles : Work::lens_bends, 1);
  const Point bent =
      is_fisheye ? bend_equidistant(lens.coefficients, p) : bend(lens.coefficients, p).at;
  return {bent.x * c.fx + c.cx, bent.y * c.fy + c.cy};
}

bool undistort(const GeneralLens& lens, Point image, Point& ideal,
               [[maybe_unused]] std::uint32_t& steps) {
  ideal = image;
  if (lens.is_pinhole()) return true;
  const Camera& c = lens.camera;
  const Point wanted{(image.x - c.cx) / c.fx, (image.y - c.cy) / c.fy};
  Point p{};
  const bool is_fisheye = lens.model == LensModel::equidistant;
  [[maybe_unused]] std::uint32_t asked = 0;
  const bool found = is_fisheye ? straighten_equidistant(lens.coefficients, wanted, p, asked)
                                : straighten(lens.coefficients, wanted, p, asked);
  work(is_fisheye ? Work::lens_radii : Work::lens_bends, asked);
  if (is_fisheye) work(Work::lens_tangents, 1);
  MARKERVP_ADD(steps, asked);
  if (found) ideal = {p.x * c.fx + c.cx, p.y * c.fy + c.cy};
  return found;
}

Point gradient(const GeneralLens& lens, Point ideal, Point direction) {
  if (lens.is_pinhole()) return direction;
  // By differences over a pixel: exact enough to lay strips.
  constexpr double half = 0.5;
  const Point right = distort(lens, ideal + Point{half, 0}) - distort(lens, ideal - Point{half, 0});
  const Point down = distort(lens, ideal + Point{0, half}) - distort(lens, ideal - Point{0, half});
  const double determinant = right.x * down.y - right.y * down.x;
  if (!(determinant > 0)) return direction;
  return {(direction.x * down.y - direction.y * right.y) / determinant,
          (direction.y * right.x - direction.x * down.x) / determinant};
}

}  // namespace marker
