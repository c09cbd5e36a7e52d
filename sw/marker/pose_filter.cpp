#include <marker/pose_filter.h>
#include <marker/work.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace marker {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Deviations of the speeds that a first frame does not show: m/s and rad/s (assumed: what the
/// camera may meet).
constexpr double usual_speed = 5;
constexpr double usual_turn = 10;

/// Squared distance, in deviations, of a pose from where the motion leads, beyond which it is
/// another motion. By chance alone one of 300 000 is so far off (chi squared of six; decision).
constexpr double farthest = 36;

Eigen::Map<const Rotation> rotation_of(const BoardPose& pose) {
  return Eigen::Map<const Rotation>(pose.rotation.data());
}

Vector3d translation_of(const BoardPose& pose) {
  return Vector3d::Map(pose.translation.data());
}

Eigen::Map<const Matrix6d> matrix(const std::array<double, 36>& values) {
  return Eigen::Map<const Matrix6d>(values.data());
}

/// The pose after a small turn about the camera's axes and a shift.
void move(BoardPose& pose, const Vector6d& by) {
  const Quaterniond turn(1, by[0] / 2, by[1] / 2, by[2] / 2);
  const Rotation turned = turn.normalized().toRotationMatrix() * rotation_of(pose);
  Rotation::Map(pose.rotation.data()) = turned;
  Vector3d::Map(pose.translation.data()) += by.tail<3>();
}

/// What move() needs to lead from one to the other.
Vector6d difference(const BoardPose& from, const BoardPose& to) {
  const Matrix3d between = rotation_of(to) * rotation_of(from).transpose();
  const Quaterniond turn(between);
  Vector6d result;
  result << 2 / turn.w() * turn.vec(), translation_of(to) - translation_of(from);
  return result;
}

/// factor⁻¹ · columns, of a lower triangular factor. One column at a time: for several at once
/// Eigen allocates memory, and a program on the chip has none to give.
Matrix6d solve(const Matrix6d& factor, const Matrix6d& columns) {
  Matrix6d result;
  for (int i = 0; i < 6; ++i) {
    const Vector6d column = columns.col(i);
    result.col(i) = factor.triangularView<Eigen::Lower>().solve(column);
  }
  return result;
}

Vector6d both(double turn, double shift) {
  Vector6d result;
  result << turn, turn, turn, shift, shift, shift;
  return result;
}

}  // namespace

/// A pose beside the one expected.
struct PoseTrack::Weighed {
  Matrix6d factor;    ///< lower Cholesky factor of the difference's covariance
  Vector6d surprise;  ///< the difference in these units
  double distance;    ///< squared, in deviations
  double unlikely;    ///< with what the corners say of the pose
};

void PoseTrack::begin(const BoardPose& seen) {
  work(Work::tracks_begun, 1);
  frames_ = 1;
  pose_ = seen;
  speed_ = {};
  mixed_ = {};
  const Vector6d deviation = both(usual_turn, usual_speed);
  Matrix6d::Map(of_speeds_.data()) = deviation.cwiseAbs2().asDiagonal();
}

/// Accelerations a that last for the whole time t lead to shifts a t² / 2 and speeds a t.
void PoseTrack::predict(double seconds, const PoseFilterOptions& options) {
  work(Work::poses_predicted, 1);
  const double t = seconds;
  move(pose_, t * Vector6d::Map(speed_.data()));
  Matrix6d::Map(pose_.covariance.data()) +=
      t * (matrix(mixed_) + matrix(mixed_).transpose()) + t * t * matrix(of_speeds_);
  Matrix6d::Map(mixed_.data()) += t * matrix(of_speeds_);
  const Vector6d change = t * both(options.turn_acceleration, options.acceleration);
  for (unsigned i = 0; i < 6; ++i) {
    const double square = change[i] * change[i];
    pose_.covariance[7 * i] += square * t * t / 4;
    mixed_[7 * i] += square * t / 2;
    of_speeds_[7 * i] += square;
  }
}

PoseTrack::Weighed PoseTrack::weigh(const BoardPose& seen) const {
  work(Work::poses_weighed, 1);
  Weighed weighed;
  weighed.factor = (matrix(pose_.covariance) + matrix(seen.covariance)).llt().matrixL();
  weighed.surprise = weighed.factor.triangularView<Eigen::Lower>().solve(difference(pose_, seen));
  weighed.distance = weighed.surprise.squaredNorm();
  weighed.unlikely = weighed.distance + seen.chi_squared;
  return weighed;
}

void PoseTrack::correct(const Weighed& weighed) {
  work(Work::poses_corrected, 1);
  ++frames_;
  const Matrix6d pose = solve(weighed.factor, matrix(pose_.covariance));
  const Matrix6d speeds = solve(weighed.factor, matrix(mixed_));
  move(pose_, pose.transpose() * weighed.surprise);
  Vector6d::Map(speed_.data()) += speeds.transpose() * weighed.surprise;
  Matrix6d::Map(pose_.covariance.data()) -= pose.transpose() * pose;
  Matrix6d::Map(mixed_.data()) -= pose.transpose() * speeds;
  Matrix6d::Map(of_speeds_.data()) -= speeds.transpose() * speeds;
}

PoseMotion PoseTrack::follow(BoardPoses& poses, double time, const PoseFilterOptions& options) {
  const FunctionScope scope(Function::pose_filter);
  const BoardPose* seen = &poses.best;
  bool follows = false;
  if (frames_ != 0) {
    predict(time - time_, options);
    const Weighed best = weigh(poses.best);
    const Weighed* likely = &best;
    Weighed other;
    if (poses.other.chi_squared < best.unlikely) {
      other = weigh(poses.other);
      if (other.unlikely < best.unlikely) {
        likely = &other;
        seen = &poses.other;
      }
    }
    follows = likely->distance < farthest;
    if (follows) correct(*likely);
  }
  if (!follows) begin(*seen);
  time_ = time;
  pose_.chi_squared = seen->chi_squared;
  poses.best = pose_;
  return {frames_, {speed_[3], speed_[4], speed_[5]}, {speed_[0], speed_[1], speed_[2]}};
}

void PoseFilter::follow(Detections& found, double time) {
  if (found.board.valid) found.board_motion = board_.follow(found.board, time, options_);
  for (std::uint32_t i = 0; i < found.count; ++i) times_seen_[found.markers[i].marker.id] = 0;
  for (std::uint32_t i = 0; i < found.count; ++i) ++times_seen_[found.markers[i].marker.id];
  for (std::uint32_t i = 0; i < found.count; ++i) {
    Detection& detection = found.markers[i];
    const std::uint16_t id = detection.marker.id;
    if (!detection.pose.valid || times_seen_[id] != 1) continue;
    detection.motion = markers_[id].follow(detection.pose, time, options_);
  }
}

}  // namespace marker
