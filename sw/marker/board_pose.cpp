#include <marker/board_pose.h>
#include <marker/rectification.h>
#include <marker/work.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace marker {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
template <int size>
using RowMajor = Eigen::Matrix<double, size, size, Eigen::RowMajor>;

Places square_at(double u, double v, double side) {
  return {{{u, v, 0}, {u + side, v, 0}, {u + side, v + side, 0}, {u, v + side, 0}}};
}

Vector3d vector(const Place& place) {
  return {place[0], place[1], place[2]};
}

/// A solution whose sum of squared errors is so many times that of the other at first does not come
/// near it.
constexpr double rival = 1e4;
/// And one that is so much worse at last is not true, whatever the markers share.
constexpr double far_worse = 100;

struct Solution {
  Matrix3d rotation;
  Vector3d translation;
};

// ---- The two poses of one square ----------------------------------------------------------------

/// The frame of a marker on its board: origin in the marker's middle.
struct Frame {
  Matrix3d axes;
  Vector3d middle;
  double side;
};

Frame frame_of(const Places& places) {
  const Vector3d a = vector(places[0]), b = vector(places[1]), d = vector(places[3]);
  Frame frame;
  frame.side = (b - a).norm();
  frame.middle = (b + d) / 2;
  frame.axes.col(0) = (b - a).normalized();
  frame.axes.col(1) = (d - a).normalized();
  frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  return frame;
}

/// Where the middle of a square is seen at focal length 1, and how the image moves with it.
struct Tangent {
  Vector2d at;
  Matrix2d jacobian;
};

bool tangent_of(const Quad& seen, double side, Tangent& tangent) {
  const Homography h = make_homography({seen[0], seen[1], seen[3], seen[2]}, side);
  Point middle{};
  if (!h.valid || !transform(h, {side / 2, side / 2}, middle)) return false;
  const double depth = (h.h7 + h.h8) * side / 2 + 1;
  tangent.at = {middle.x, middle.y};
  tangent.jacobian << h.h1 - middle.x * h.h7, h.h2 - middle.x * h.h8,  //
      h.h4 - middle.y * h.h7, h.h5 - middle.y * h.h8;
  tangent.jacobian /= depth;
  return true;
}

/// The shortest rotation that leads the z axis to the ray through `at`.
Matrix3d towards(const Vector2d& at) {
  const Vector3d ray = Vector3d(at.x(), at.y(), 1).normalized();
  return Eigen::Quaterniond(1 + ray.z(), -ray.y(), ray.x(), 0).normalized().toRotationMatrix();
}

/// Collins and Bartoli, section 4: R is that of the ray, times a rotation whose upper left part is
/// the tangent's, scaled to a largest singular value of 1; what is missing has two signs.
bool rotations_of(const Tangent& tangent, Matrix3d& first, Matrix3d& second) {
  const Matrix3d ray = towards(tangent.at);
  const Matrix2d b = ray.topLeftCorner<2, 2>() - tangent.at * ray.bottomLeftCorner<1, 2>();
  const Matrix2d a = b.inverse() * tangent.jacobian;
  const Matrix2d square = a * a.transpose();
  const double difference = square(0, 0) - square(1, 1);
  const double root = std::sqrt(difference * difference + 4 * square(0, 1) * square(0, 1));
  const double scale = std::sqrt((square.trace() + root) / 2);
  if (!(scale > 0)) return false;
  const Matrix2d upper = a / scale;
  const Matrix2d missing = Matrix2d::Identity() - upper.transpose() * upper;
  const double u = std::sqrt(missing(0, 0) > 0 ? missing(0, 0) : 0);
  double v = std::sqrt(missing(1, 1) > 0 ? missing(1, 1) : 0);
  if (missing(0, 1) < 0) v = -v;
  for (const double sign : {1.0, -1.0}) {
    Matrix3d r;
    r.topLeftCorner<2, 2>() = upper;
    r.bottomLeftCorner<1, 2>() << sign * u, sign * v;
    r.col(2) = r.col(0).cross(r.col(1));
    (sign > 0 ? first : second) = ray * r;
  }
  return true;
}

// ---- All corners --------------------------------------------------------------------------------

/// How the eight coordinates of a marker's corners move with the pose, and how far they are off in
/// the seventh column. By hand, since Eigen's general code takes five times as long.
struct Rows {
  double at[8][7];

  void weigh(const CornerWeights& weights) {
    const double* weight = weights.data() + weights.size();
    // From the last one on: each needs those before it as they were.
    for (unsigned i = 8; i-- > 0;) {
      weight -= i + 1;
      double row[7] = {};
      for (unsigned k = 0; k <= i; ++k) {
        for (unsigned c = 0; c < 7; ++c) row[c] += weight[k] * at[k][c];
      }
      for (unsigned c = 0; c < 7; ++c) at[i][c] = row[c];
    }
  }
};

/// JᵀΩJ, JᵀΩr and rᵀΩr: the products of such columns, lower half.
struct Normal {
  double at[7][7];

  void add(const Rows& rows) {
    // No sum waits for the one before: the Cortex-A9's takes long, and begins one each clock.
    for (const double(&row)[7] : rows.at) {
      for (unsigned i = 0; i < 7; ++i) {
        for (unsigned k = 0; k <= i; ++k) at[i][k] += row[i] * row[k];
      }
    }
  }
  double error() const { return at[6][6]; }

  /// The Cholesky factor of JᵀΩJ, with the inverse of its diagonal.
  struct Factor {
    double at[6][6];

    /// What leads to `right`.
    Vector6d solve(Vector6d right) const {
      for (unsigned i = 0; i < 6; ++i) {
        for (unsigned k = 0; k < i; ++k) right[i] -= at[i][k] * right[k];
        right[i] *= at[i][i];
      }
      for (unsigned i = 6; i-- > 0;) {
        for (unsigned k = i + 1; k < 6; ++k) right[i] -= at[k][i] * right[k];
        right[i] *= at[i][i];
      }
      return right;
    }
  };
  Factor factor() const {
    Factor factor;
    for (unsigned i = 0; i < 6; ++i) {
      for (unsigned k = 0; k <= i; ++k) {
        double rest = at[i][k];
        for (unsigned j = 0; j < k; ++j) rest -= factor.at[i][j] * factor.at[k][j];
        factor.at[i][k] = k < i ? rest * factor.at[k][k] : 1 / std::sqrt(rest);
      }
    }
    return factor;
  }
  Vector6d gradient() const { return Eigen::Map<const Vector6d>(at[6]); }
};

/// A pose on its way to the one that fits best.
struct Descent {
  Solution solution;
  Normal normal;
  double error;
  bool is_seen;  ///< all corners are in front of the camera

  BoardPose pose(const Normal::Factor& factor) const {
    BoardPose pose{};
    RowMajor<3>::Map(pose.rotation.data()) = solution.rotation;
    Vector3d::Map(pose.translation.data()) = solution.translation;
    for (unsigned column = 0; column < 6; ++column) {
      RowMajor<6>::Map(pose.covariance.data()).col(column) =
          factor.solve(Vector6d(Vector6d::Unit(column)));
    }
    pose.chi_squared = error;
    return pose;
  }
};

class Corners {
 public:
  Corners(const SeenMarker* markers, std::uint32_t count, const Camera& camera)
      : markers_(markers), count_(count), camera_(camera) {}

  /// Both poses of the largest marker, as all markers see them.
  bool start(std::array<Descent, 2>& descents) const {
    const SeenMarker& marker = largest();
    const Frame frame = frame_of(marker.places);
    Quad seen{};
    for (unsigned i = 0; i < 4; ++i) {
      seen[i] = {(marker.corners[i].x - camera_.cx) / camera_.fx,
                 (marker.corners[i].y - camera_.cy) / camera_.fy};
    }
    Tangent tangent;
    if (!(frame.side > 0) || !tangent_of(seen, frame.side, tangent) ||
        !rotations_of(tangent, descents[0].solution.rotation, descents[1].solution.rotation)) {
      return false;
    }
    for (Descent& descent : descents) {
      Solution& s = descent.solution;
      s.rotation = s.rotation * frame.axes.transpose();
      s.translation = translation(marker.places, seen, s.rotation);
      descent.is_seen = weigh(s, descent.normal);
      descent.error = descent.normal.error();
    }
    return true;
  }

  /// Gauss–Newton; a step that makes it worse is halved.
  void refine(Descent& descent) const {
    auto& [solution, normal, error, is_seen] = descent;
    for (unsigned step = 0; step < most_steps; ++step) {
      Vector6d move = -normal.factor().solve(normal.gradient());
      // Gain in the linear model. So small a step is taken without another evaluation.
      const double gain = -normal.gradient().dot(move);
      if (gain < least_gain * (1 + error)) {
        solution = moved(solution, move);
        error -= gain;
        return;
      }
      Solution next;
      Normal next_normal;
      unsigned halvings = 0;
      for (;; ++halvings) {
        next = moved(solution, move);
        if (weigh(next, next_normal) && next_normal.error() <= error) break;
        if (halvings == most_halvings) return;
        move /= 2;
      }
      solution = next;
      normal = next_normal;
      error = normal.error();
    }
  }

  /// `is_likely`: what the markers share is worth its time.
  BoardPose pose(const Descent& descent, bool is_likely) const {
    const Normal::Factor factor = descent.normal.factor();
    BoardPose pose = descent.pose(factor);
    if (is_likely && shares()) add_shared(descent.solution, factor, pose);
    return pose;
  }

 private:
  static constexpr unsigned most_steps = 30;
  static constexpr unsigned most_halvings = 8;
  /// Of the sum of squared errors, absolute and relative: a tenth of a standard deviation, after
  /// which the last step leaves less than a hundredth.
  static constexpr double least_gain = 1e-2;

  const SeenMarker& largest() const {
    const SeenMarker* largest = markers_;
    double most = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const Quad& q = markers_[i].corners;
      const double area = cross(q[0], q[1], q[2]) + cross(q[0], q[2], q[3]);
      if (area > most) {
        most = area;
        largest = &markers_[i];
      }
    }
    return *largest;
  }

  /// True if the markers have something that they share.
  bool shares() const {
    for (std::uint32_t i = 0; i < count_; ++i) {
      for (const double way : markers_[i].common) {
        if (way != 0) return true;
      }
    }
    return false;
  }

  /// A deviation of what the markers share moves the pose by N⁻¹JᵀΩc, and leaves of the corners'
  /// errors what the pose cannot follow; so much of their χ² says nothing.
  void add_shared(const Solution& s, const Normal::Factor& factor, BoardPose& pose) const {
    Vector6d slope = Vector6d::Zero();
    double with_error = 0, square = 0;
    work(Work::marker_weighings, count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      Rows rows;
      if (!look(s, markers_[i], rows)) return;
      rows.weigh(markers_[i].weights);
      const double* weight = markers_[i].weights.data();
      for (const double(&row)[7] : rows.at) {
        double way = 0;
        for (std::ptrdiff_t k = 0; k <= &row - rows.at; ++k)
          way += *weight++ * markers_[i].common[k];
        slope += way * Eigen::Map<const Vector6d>(row);
        with_error += way * row[6];
        square += way * way;
      }
    }
    const Vector6d move = factor.solve(slope);
    RowMajor<6>::Map(pose.covariance.data()) += move * move.transpose();
    const double unfollowed = square - slope.dot(move);
    pose.chi_squared -= with_error * with_error / (1 + std::max(unfollowed, 0.0));
    pose.chi_squared = std::max(pose.chi_squared, 0.0);
  }

  /// Least squares over the rays on which the corners lie.
  static Vector3d translation(const Places& places, const Quad& seen, const Matrix3d& rotation) {
    Matrix3d a = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (unsigned i = 0; i < 4; ++i) {
      const Vector3d turned = rotation * vector(places[i]);
      Eigen::Matrix<double, 2, 3> ray;
      ray << 1, 0, -seen[i].x, 0, 1, -seen[i].y;
      a += ray.transpose() * ray;
      b -= ray.transpose() * (ray * turned);
    }
    return a.ldlt().solve(b);
  }

  static Solution moved(const Solution& s, const Vector6d& move) {
    const Eigen::Quaterniond turn(1, move[0] / 2, move[1] / 2, move[2] / 2);
    return {turn.normalized().toRotationMatrix() * s.rotation, s.translation + move.tail<3>()};
  }

  /// Over all markers. False if a corner is not in front of the camera.
  bool weigh(const Solution& s, Normal& normal) const {
    work(Work::pose_steps, 1);
    work(Work::marker_weighings, count_);
    normal = {};
    for (std::uint32_t i = 0; i < count_; ++i) {
      Rows rows;
      if (!look(s, markers_[i], rows)) return false;
      rows.weigh(markers_[i].weights);
      normal.add(rows);
    }
    return true;
  }

  bool look(const Solution& s, const SeenMarker& marker, Rows& rows) const {
    for (unsigned i = 0; i < 4; ++i) {
      const Vector3d turned = s.rotation * vector(marker.places[i]);
      const Vector3d p = turned + s.translation;
      if (!(p.z() > 0)) return false;
      const double x = p.x() / p.z(), y = p.y() / p.z();
      const Vector3d dx = camera_.fx / p.z() * Vector3d(1, 0, -x);
      const Vector3d dy = camera_.fy / p.z() * Vector3d(0, 1, -y);
      // A turn ω moves the point by ω × turned.
      const Vector3d turn_x = turned.cross(dx), turn_y = turned.cross(dy);
      double* const row_x = rows.at[2 * i];
      double* const row_y = rows.at[2 * i + 1];
      for (unsigned k = 0; k < 3; ++k) {
        row_x[k] = turn_x[k];
        row_x[3 + k] = dx[k];
        row_y[k] = turn_y[k];
        row_y[3 + k] = dy[k];
      }
      row_x[6] = camera_.fx * x + camera_.cx - marker.corners[i].x;
      row_y[6] = camera_.fy * y + camera_.cy - marker.corners[i].y;
    }
    return true;
  }

  const SeenMarker* markers_;
  std::uint32_t count_;
  const Camera& camera_;
};

}  // namespace

Places single_marker(double side) {
  return square_at(0, 0, side);
}

bool GridBoard::find(std::uint32_t id, Places& places) const {
  if (id < first_id || id - first_id >= columns * rows) return false;
  const std::uint32_t index = id - first_id;
  places = square_at(index % columns * (side + gap),
                     // Whole rows. NOLINTNEXTLINE(bugprone-integer-division)
                     static_cast<double>(index / columns) * (side + gap), side);
  return true;
}

bool CharucoBoard::find(std::uint32_t id, Places& places) const {
  // Two rows together have a white square in each column.
  if (columns == 0) return false;
  const std::uint32_t pair = id / columns, within = id % columns;
  const std::uint32_t in_first = (columns + (white_first ? 1 : 0)) / 2;
  const std::uint32_t row = 2 * pair + (within < in_first ? 0 : 1);
  if (row >= rows) return false;
  const std::uint32_t place = within < in_first ? within : within - in_first;
  const bool starts_white = (row % 2 == 0) == white_first;
  const double margin = (square - side) / 2;
  places = square_at((2 * place + (starts_white ? 0 : 1)) * square + margin, row * square + margin,
                     side);
  return true;
}

std::array<double, 64> independent_corners(double sigma) {
  std::array<double, 64> covariance{};
  for (unsigned i = 0; i < 8; ++i) covariance[9 * i] = sigma * sigma;
  return covariance;
}

CornerWeights weights_of(const std::array<double, 64>& covariance) {
  work(Work::markers_weighted, 1);
  CornerWeights weights;
  double factor[8][8];  // Cholesky's, with the inverse of its diagonal
  double inverse[8][8];
  double* weight = weights.data();
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned k = 0; k <= i; ++k) {
      double rest = covariance[i * 8 + k];
      for (unsigned j = 0; j < k; ++j) rest -= factor[i][j] * factor[k][j];
      factor[i][k] = k < i ? rest * factor[k][k] : 1 / std::sqrt(rest);
    }
    for (unsigned k = 0; k < i; ++k) {
      double sum = 0;
      for (unsigned j = k; j < i; ++j) sum -= factor[i][j] * inverse[j][k];
      *weight++ = inverse[i][k] = sum * factor[i][i];
    }
    *weight++ = inverse[i][i] = factor[i][i];
  }
  return weights;
}

BoardPoses estimate_board_pose(const SeenMarker* markers, std::uint32_t count,
                               const Camera& camera) {
  const FunctionScope scope(Function::pose_estimation);
  work(Work::board_poses, 1);
  BoardPoses poses{};
  if (count == 0 || !(camera.fx > 0 && camera.fy > 0)) return poses;
  const Corners corners(markers, count, camera);
  std::array<Descent, 2> descents;
  if (!corners.start(descents)) return poses;
  auto& [first, second] = descents;
  if (!first.is_seen || (second.is_seen && second.error < first.error)) std::swap(first, second);
  if (!first.is_seen) return poses;
  corners.refine(first);
  if (!std::isfinite(first.error)) return poses;
  poses.valid = true;
  poses.best = poses.other = corners.pose(first, true);
  if (!second.is_seen) return poses;
  if (second.error < rival * (1 + first.error)) corners.refine(second);
  const bool may_be_true = second.error < far_worse * (1 + first.error);
  poses.other = corners.pose(second, may_be_true);
  if (second.error < first.error) std::swap(poses.best, poses.other);
  return poses;
}

}  // namespace marker
