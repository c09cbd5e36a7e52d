#include <marker/scene/pose.h>

#include <cmath>
#include <cstddef>
#include <string>

#include <marker/scene/portable_math.h>
#include <vp/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace platform {

namespace {

void require_size(int size, const char* what) {
  if (size < 1 || size > largest_side_px) {
    throw vp::InputError("camera " + std::string(what) + " is " + std::to_string(size) +
                         " px: give 1 to " + std::to_string(largest_side_px) + " px");
  }
}

void require_focal_length(double focal_length, const char* what) {
  if (!std::isfinite(focal_length) || focal_length <= 0) {
    throw vp::InputError("camera focal length " + std::string(what) + " is " +
                         std::to_string(focal_length) + " px: give a positive number of pixels");
  }
}

}  // namespace

Camera Camera::for_resolution(int width, int height) {
  const Camera standard;
  const double scale = static_cast<double>(width) / standard.width;
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = standard.fx * scale;
  camera.fy = standard.fy * scale;
  camera.cx = width / 2.0;
  camera.cy = height / 2.0;
  validate(camera);
  return camera;
}

void validate(const Camera& camera) {
  require_size(camera.width, "width");
  require_size(camera.height, "height");
  require_focal_length(camera.fx, "fx");
  require_focal_length(camera.fy, "fy");
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
    throw vp::InputError(
        "camera principal point is not a number: give two finite coordinates in px");
  }
}

namespace {

constexpr double rotation_tolerance = 1e-6;
constexpr double pi = 3.14159265358979323846;

/// The matrix of these rows.
Eigen::Matrix3d rows(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  Eigen::Matrix3d matrix;
  matrix << x.transpose(), y.transpose(), z.transpose();
  return matrix;
}

}  // namespace

Eigen::Matrix3d rotation_x(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return rows({1, 0, 0}, {0, c, -s}, {0, s, c});
}

Eigen::Matrix3d rotation_y(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return rows({c, 0, s}, {0, 1, 0}, {-s, 0, c});
}

Eigen::Matrix3d rotation_z(double degrees) {
  const auto [s, c] = portable_sin_cos_degrees(degrees);
  return rows({c, -s, 0}, {s, c, 0}, {0, 0, 1});
}

Eigen::Vector3d transform(const Pose& pose, const Eigen::Vector3d& marker_point) {
  return pose.rotation * marker_point + pose.translation;
}

Eigen::Vector3d camera_position(const Pose& pose) {
  return -(pose.rotation.transpose() * pose.translation);
}

Pose pose_from_centre(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre,
                      double side_m) {
  return {rotation, centre - rotation * Eigen::Vector3d(side_m / 2, side_m / 2, 0)};
}

PixelPoint project(const Camera& camera, const Eigen::Vector3d& camera_point) {
  return {camera.fx * camera_point.x() / camera_point.z() + camera.cx,
          camera.fy * camera_point.y() / camera_point.z() + camera.cy};
}

std::array<PixelPoint, 4> project_marker(const Camera& camera, const Pose& pose, double side_m) {
  const std::array<Eigen::Vector3d, 4> corners{
      {{0, 0, 0}, {side_m, 0, 0}, {side_m, side_m, 0}, {0, side_m, 0}}};
  std::array<PixelPoint, 4> projected;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d point = transform(pose, corners[i]);
    if (!(point.z() > 0)) {
      throw vp::InputError("marker corner " + std::to_string(i) +
                           " lies at Z = " + std::to_string(point.z()) +
                           " m, behind the camera: move the marker to Z > 0");
    }
    projected[i] = project(camera, point);
  }
  return projected;
}

double rotation_error_deg(const Pose& a, const Pose& b) {
  const Eigen::Matrix3d between = a.rotation.transpose() * b.rotation;
  return Eigen::AngleAxisd(between).angle() * 180.0 / pi;
}

double translation_error_mm(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() * 1000.0;
}

void validate(const Pose& pose) {
  if (!pose.translation.allFinite()) {
    throw vp::InputError("pose translation is not a number: give three finite values in m");
  }
  const Eigen::Matrix3d product = pose.rotation * pose.rotation.transpose();
  const double off = (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(pose.rotation.allFinite() && off <= rotation_tolerance)) {
    throw vp::InputError("pose rotation is not orthonormal: give a 3x3 rotation matrix");
  }
  if (pose.rotation.determinant() < 0) {
    throw vp::InputError("pose rotation mirrors (determinant -1): give a 3x3 rotation matrix");
  }
}

}  // namespace platform
