#include <marker/posit.h>
#include <marker/work.h>

#include <cmath>

namespace marker {
namespace {

/// A vector in the marker's frame; its plane is w = 0.
struct Vector {
  double u, v, w;
};

double dot(const Vector& a, const Vector& b) {
  return a.u * b.u + a.v * b.v + a.w * b.w;
}

Vector operator/(const Vector& a, double s) {
  return {a.u / s, a.v / s, a.w / s};
}

/// R by rows and T, with the error of the four corners.
struct Solution {
  Vector row1, row2, row3;
  double x, y, z;
  double error;  ///< px; negative if the solution is of no use
};

using Weights =
    std::array<double, 4>;  ///< 1 + ε of each corner: its depth over the reference point's

class Posit {
 public:
  Posit(const Quad& corners, const Camera& camera, double side) : camera_(camera), side_(side) {
    for (unsigned i = 0; i < 4; ++i) {
      image_[i] = {(corners[i].x - camera.cx) / camera.fx, (corners[i].y - camera.cy) / camera.fy};
    }
  }

  /// POS: pose from orthography and scaling. Two solutions, because the points are coplanar.
  void pos(const Weights& weights, Solution& first, Solution& second) const {
    std::array<double, 3> x{}, y{};
    for (unsigned i = 0; i < 3; ++i) {
      x[i] = image_[i + 1].x * weights[i + 1] - image_[0].x;
      y[i] = image_[i + 1].y * weights[i + 1] - image_[0].y;
    }
    const Vector i0 = on_plane(x);
    const Vector j0 = on_plane(y);
    // I = i0 + λn and J = j0 + μn must be orthogonal and of equal length: (λ + iμ)² = d - 2ic.
    const double d = dot(j0, j0) - dot(i0, i0);
    const double c = dot(i0, j0);
    const double s = std::sqrt(d * d + 4 * c * c);
    double lambda = 0;
    double mu = 0;
    if (d >= 0) {
      lambda = std::sqrt((d + s) / 2);
      if (lambda > 0) mu = -c / lambda;
    } else {
      mu = std::sqrt((s - d) / 2);
      lambda = -c / mu;
    }
    first = solution({i0.u, i0.v, lambda}, {j0.u, j0.v, mu});
    second = solution({i0.u, i0.v, -lambda}, {j0.u, j0.v, -mu});
  }

  /// The weights that a solution implies.
  Weights weights(const Solution& s) const {
    Weights weights{};
    for (unsigned i = 0; i < 4; ++i) weights[i] = 1 + dot(s.row3, model(i)) / s.z;
    return weights;
  }

  /// Mean distance of corners and projections, in px; in mm at the depth of each corner.
  double error(const Solution& s, double& millimetres) const {
    double px = 0;
    millimetres = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const double z = dot(s.row3, model(i)) + s.z;
      if (!(z > 0)) return -1;
      const double x = (dot(s.row1, model(i)) + s.x) / z - image_[i].x;
      const double y = (dot(s.row2, model(i)) + s.y) / z - image_[i].y;
      px += std::sqrt(camera_.fx * x * camera_.fx * x + camera_.fy * y * camera_.fy * y) / 4;
      millimetres += std::sqrt(x * x + y * y) * z * 1000 / 4;
    }
    return std::isfinite(px) ? px : -1;
  }

 private:
  /// Equation 4.6: the corners clockwise from the top left, which is the reference point.
  Vector model(unsigned i) const {
    return {i == 1 || i == 2 ? side_ : 0, i == 2 || i == 3 ? side_ : 0, 0};
  }

  /// Least squares over the three vectors from the reference point: the pseudo-inverse of (L,0),
  /// (L,L), (0,L).
  Vector on_plane(const std::array<double, 3>& b) const {
    return {(2 * b[0] + b[1] - b[2]) / (3 * side_), (2 * b[2] + b[1] - b[0]) / (3 * side_), 0};
  }

  Solution solution(const Vector& i, const Vector& j) const {
    Solution s{};
    s.error = -1;
    const double length_i = std::sqrt(dot(i, i));
    const double length_j = std::sqrt(dot(j, j));
    if (!(length_i > 0 && length_j > 0)) return s;
    s.row1 = i / length_i;
    s.row2 = j / length_j;
    s.row3 = {s.row1.v * s.row2.w - s.row1.w * s.row2.v, s.row1.w * s.row2.u - s.row1.u * s.row2.w,
              s.row1.u * s.row2.v - s.row1.v * s.row2.u};
    s.z = 2 / (length_i + length_j);
    s.x = image_[0].x * s.z;
    s.y = image_[0].y * s.z;
    double millimetres = 0;
    s.error = error(s, millimetres);
    return s;
  }

  Camera camera_;
  double side_;
  Quad image_{};  ///< at focal length 1
};

bool is_better(const Solution& a, const Solution& b) {
  return a.error >= 0 && (b.error < 0 || a.error < b.error);
}

bool is_below(const Solution& s, double limit) {
  return s.error >= 0 && s.error < limit;
}

/// So many steps in a row may bring no smaller error (decision: with two, exact corners seen from
/// the side do not converge).
constexpr unsigned patience = 3;

/// One of the two solutions of the first step on its way.
class Track {
 public:
  explicit Track(const Solution& start) : now_(start), best_(start) {}

  /// One step of POSIT. False, and nothing changed, if the track ended.
  bool advance(const Posit& posit) {
    if (now_.error < 0 || steps_without_gain_ == patience) return false;
    Solution first{}, second{};
    posit.pos(posit.weights(now_), first, second);
    now_ = is_better(second, first) ? second : first;
    if (is_better(now_, best_)) {
      best_ = now_;
      steps_without_gain_ = 0;
    } else {
      ++steps_without_gain_;
    }
    return true;
  }

  const Solution& best() const { return best_; }

 private:
  Solution now_, best_;
  unsigned steps_without_gain_ = 0;
};

}  // namespace

Pose estimate_pose(const Quad& corners, const Camera& camera, const PositOptions& options) {
  const FunctionScope scope(Function::pose_estimation);
  work(Work::poses, 1);
  Pose pose{};
  if (!(camera.fx > 0 && camera.fy > 0 && options.side > 0)) return pose;

  const Posit posit(corners, camera, options.side);
  Solution one{}, other{};
  posit.pos({1, 1, 1, 1}, one, other);
  Track first(one), second(other);
  std::uint32_t steps = 1;
  std::uint32_t iterations = 1;
  while (iterations < options.limit && !is_below(first.best(), options.stop) &&
         !is_below(second.best(), options.stop)) {
    const bool first_moved = first.advance(posit);
    const bool second_moved = second.advance(posit);
    if (!first_moved && !second_moved) break;
    steps += (first_moved ? 1 : 0) + (second_moved ? 1 : 0);
    ++iterations;
  }
  work(Work::posit_iterations, steps);
  const Solution& best = is_better(second.best(), first.best()) ? second.best() : first.best();
  if (best.error < 0) return pose;

  pose.valid = true;
  pose.rotation = {best.row1.u, best.row1.v, best.row1.w, best.row2.u, best.row2.v,
                   best.row2.w, best.row3.u, best.row3.v, best.row3.w};
  pose.translation = {best.x, best.y, best.z};
  pose.reprojection_px = posit.error(best, pose.reprojection_mm);
  pose.iterations = iterations;
  return pose;
}

}  // namespace marker
