#include <marker/poses/convention.h>

#include <Eigen/Dense>

namespace platform::poses {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// OpenCV's dictionaries, and so ours, have the words of AprilTag's families upside down: AprilTag
/// 3 takes the top right corner of OpenCV's upright picture for the bottom left one (tests:
/// peers_test).
constexpr const char* turned_families = "apriltag_";

/// Not of a dictionary of the user's own: its file says what is up.
bool is_turned(const Convention& convention, const FoundPose& found) {
  return convention.turns_apriltag && !found.code_cells &&
         found.family.rfind(turned_families, 0) == 0;
}

/// The axes of the marker's frame, as columns, in those of result.json.
Eigen::Matrix3d axes_of(const Convention& convention, bool turned) {
  const double x = turned ? -1 : 1, z = convention.is_z_out ? -1 : 1;
  return Eigen::Vector3d(x, x * z, z).asDiagonal();
}

std::array<PixelPoint, 4> corners_of(const Convention& convention, bool turned,
                                     const std::array<PixelPoint, 4>& corners_px) {
  constexpr double first_centre_px = 0.5;  // of result.json
  std::array<PixelPoint, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t clockwise = convention.from_bottom_left ? 3 - i : i;
    corners[i] = corners_px[(clockwise + (turned ? 2 : 0)) % 4];
    corners[i].x += convention.first_centre_px - first_centre_px;
    corners[i].y += convention.first_centre_px - first_centre_px;
  }
  return corners;
}

/// Of the translation to a point that is `arm` away, which a turn moves, then of the turn.
PoseCovariance translation_first(const PoseCovariance& covariance, const Eigen::Vector3d& arm) {
  Matrix6 change = Matrix6::Zero();
  change.block<3, 3>(0, 0) << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  change.block<3, 3>(0, 3).setIdentity();
  change.block<3, 3>(3, 0).setIdentity();
  const Matrix6 known = Matrix6::Map(covariance.data());
  PoseCovariance result;
  Matrix6::Map(result.data()) = change * known * change.transpose();
  return result;
}

}  // namespace

const std::vector<Convention>& conventions() {
  static const std::vector<Convention> all{
      {"top-left", false, false, false, 0.5, false,
       "as result.json: top left corner, x right, y down, z away"},
      {"opencv", true, true, false, 0, false,
       "OpenCV's ArUco: middle, x right, y up, z to the viewer"},
      {"apriltag", true, false, true, 0.5, true, "AprilTag 3: middle, x right, y down, z away"},
      {"ros", true, true, true, 0.5, true, "apriltag_ros: middle, x right, y up, z to the viewer"}};
  return all;
}

FoundPose with_side(const FoundPose& found, double side_m) {
  const double ratio = side_m / found.side_m;
  FoundPose result = found;
  result.side_m = side_m;
  if (result.pose) result.pose->translation *= ratio;
  for (std::size_t i = 0; result.covariance && i < 36; ++i) {
    if (i / 6 >= 3) (*result.covariance)[i] *= ratio;
    if (i % 6 >= 3) (*result.covariance)[i] *= ratio;
  }
  return result;
}

FoundPose in_convention(const Convention& convention, const FoundPose& found) {
  FoundPose result = found;
  const bool turned = is_turned(convention, found);
  if (!found.is_board()) result.corners_px = corners_of(convention, turned, found.corners_px);
  if (!found.pose) return result;
  Eigen::Vector3d arm(0, 0, 0);
  if (!found.is_board()) {
    const double half_m = convention.in_middle ? found.side_m / 2 : 0;
    arm = found.pose->rotation * Eigen::Vector3d(half_m, half_m, 0);
    result.pose->rotation = found.pose->rotation * axes_of(convention, turned);
    result.pose->translation += arm;
  }
  if (found.covariance) result.covariance = translation_first(*found.covariance, arm);
  return result;
}

}  // namespace platform::poses
