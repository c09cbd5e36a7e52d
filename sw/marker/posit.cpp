#include <marker/posit.h>
#include <marker/work.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace marker {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// X = rotation · U + translation, with the error of the four corners.
struct Solution {
  Matrix3d rotation;
  Vector3d translation;
  double error;  ///< px; negative if the solution is of no use
};

/// 1 + ε of each corner: its depth over the reference point's.
using Weights = std::array<double, 4>;

class Posit {
 public:
  Posit(const Quad& corners, const Camera& camera, double side)
      : focal_(camera.fx, camera.fy),
        // Equation 4.6: the corners clockwise from the top left, which is the reference point.
        model_{{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}} {
    for (unsigned i = 0; i < 4; ++i) {
      image_[i] = {(corners[i].x - camera.cx) / camera.fx, (corners[i].y - camera.cy) / camera.fy};
    }
  }

  /// POS: pose from orthography and scaling. Two solutions, because the points are coplanar.
  void pos(const Weights& weights, Solution& first, Solution& second) const {
    Vector3d i = Vector3d::Zero(), j = Vector3d::Zero();
    on_plane(weights, i, j);
    // I = i + λn and J = j + μn must be orthogonal and of equal length: (λ + iμ)² = d - 2ic.
    const double d = j.squaredNorm() - i.squaredNorm();
    const double c = i.dot(j);
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
    first = solution({i.x(), i.y(), lambda}, {j.x(), j.y(), mu});
    second = solution({i.x(), i.y(), -lambda}, {j.x(), j.y(), -mu});
  }

  /// The weights that a solution implies.
  Weights weights(const Solution& s) const {
    Weights weights{};
    for (unsigned i = 0; i < 4; ++i) {
      weights[i] = 1 + s.rotation.row(2).dot(model_[i]) / s.translation.z();
    }
    return weights;
  }

  /// Mean distance of corners and projections, in px; in mm at the depth of each corner.
  double error(const Solution& s, double& millimetres) const {
    double px = 0;
    millimetres = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const Vector3d point = s.rotation * model_[i] + s.translation;
      if (!(point.z() > 0)) return -1;
      const Vector2d off = point.head<2>() / point.z() - image_[i];
      px += off.cwiseProduct(focal_).norm() / 4;
      millimetres += off.norm() * point.z() * 1000 / 4;
    }
    return std::isfinite(px) ? px : -1;
  }

 private:
  /// Least squares over the three vectors from the reference point: the pseudo-inverse of (L,0),
  /// (L,L), (0,L).
  void on_plane(const Weights& weights, Vector3d& i, Vector3d& j) const {
    std::array<Vector2d, 3> b;
    for (unsigned k = 0; k < 3; ++k) b[k] = image_[k + 1] * weights[k + 1] - image_[0];
    const double side = model_[1].x();
    const Vector2d u = (2 * b[0] + b[1] - b[2]) / (3 * side);
    const Vector2d v = (2 * b[2] + b[1] - b[0]) / (3 * side);
    i = {u.x(), v.x(), 0};
    j = {u.y(), v.y(), 0};
  }

  Solution solution(const Vector3d& i, const Vector3d& j) const {
    Solution s{Matrix3d::Zero(), Vector3d::Zero(), -1};
    const double length_i = i.norm();
    const double length_j = j.norm();
    if (!(length_i > 0 && length_j > 0)) return s;
    s.rotation.row(0) = i / length_i;
    s.rotation.row(1) = j / length_j;
    s.rotation.row(2) = s.rotation.row(0).cross(s.rotation.row(1));
    const double z = 2 / (length_i + length_j);
    s.translation << image_[0] * z, z;
    double millimetres = 0;
    s.error = error(s, millimetres);
    return s;
  }

  Vector2d focal_;
  std::array<Vector3d, 4> model_;
  std::array<Vector2d, 4> image_;  ///< at focal length 1
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
    Solution first, second;
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
  Solution one, other;
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
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(pose.rotation.data()) = best.rotation;
  Vector3d::Map(pose.translation.data()) = best.translation;
  pose.reprojection_px = posit.error(best, pose.reprojection_mm);
  pose.iterations = iterations;
  return pose;
}

}  // namespace marker
