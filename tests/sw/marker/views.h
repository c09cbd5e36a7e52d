#pragma once

#include <Eigen/Geometry>
#include <array>

/// Rotations, for tests of poses.
namespace views {

constexpr double pi = 3.14159265358979323846;

/// About X, then Y, then Z of the marker, degrees.
inline Eigen::Matrix3d turn(double pitch, double yaw, double roll) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(pitch * pi / 180, Vector3d::UnitX()) *
          AngleAxisd(yaw * pi / 180, Vector3d::UnitY()) *
          AngleAxisd(roll * pi / 180, Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// Of any pose of sw/marker.
template <class Pose>
Eigen::Matrix3d rotation_of(const Pose& pose) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation.data());
}

template <class Pose>
Eigen::Vector3d translation_of(const Pose& pose) {
  return Eigen::Vector3d(pose.translation.data());
}

/// Degrees.
inline double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle() * 180 / pi;
}

}  // namespace views
