#pragma once

#include <array>
#include <memory>

#include <marker/optics.h>
#include <Eigen/Core>

namespace platform {

/// A point in the image, px. The centre of the first pixel is (0.5, 0.5).
struct PixelPoint {
  double x = 0;
  double y = 0;
};

/// No image and no camera is larger.
constexpr int largest_side_px = 16384;

/// What light the grey levels of a camera stand for.
struct Response {
  bool is_linear = false;                           ///< twice the level is twice the light
  std::shared_ptr<const marker::LightTable> light;  ///< none, and not linear: it is not known
};

/// Ideal pinhole camera, looking along +Z with x right and y down. The defaults are the thesis'
/// camera (table 5.1).
struct Camera {
  int width = 640;     ///< px
  int height = 480;    ///< px
  double fx = 381.36;  ///< focal length, px
  double fy = 381.36;  ///< focal length, px
  double cx = 320.0;   ///< principal point, px
  double cy = 240.0;   ///< principal point, px
  /// How the lens bends its pictures: coefficients in the order of their model, then zeros. Scenes
  /// are drawn without it.
  std::array<double, 12> distortion{};
  marker::LensModel lens_model = marker::LensModel::brown_conrady;
  Response response = {};

  /// The thesis' camera with `width` x `height` pixels over the same horizontal field of view: the
  /// focal length grows with the width, pixels stay square, the principal point is the centre.
  /// Throws vp::InputError if a size is out of range.
  static Camera for_resolution(int width, int height);
};

/// Throws vp::InputError unless sizes are 1 to 16384 px, focal lengths positive and everything
/// finite.
void validate(const Camera& camera);

/// Side of the thesis' marker, m (thesis 5.1.1).
constexpr double marker_side_m = 0.30;

/// Where the marker is as the camera sees it: X = R * U + T (equation A.6). Camera frame: x right,
/// y down, z forward. Marker frame: origin in the marker's own top left corner, u right, v down, w
/// away from the viewer.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation{0, 0, 1};  ///< m
};

/// Rotations about one axis of the camera, positive from y to z, z to x and x to y. Exact at
/// multiples of 90 degrees, and the same on every host: Eigen's own take libm's sine and cosine.
Eigen::Matrix3d rotation_x(double degrees);
Eigen::Matrix3d rotation_y(double degrees);
Eigen::Matrix3d rotation_z(double degrees);

/// A point of the marker frame, m, in the camera frame, m.
Eigen::Vector3d transform(const Pose& pose, const Eigen::Vector3d& marker_point);

/// The camera's centre in the marker frame, m: -R^T * T.
Eigen::Vector3d camera_position(const Pose& pose);

/// The pose whose marker *centre* lies at `centre` (camera frame, m): handy to describe a view.
Pose pose_from_centre(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre,
                      double side_m = marker_side_m);

/// Image of a point of the camera frame, px. The point must lie in front of the camera (z > 0).
PixelPoint project(const Camera& camera, const Eigen::Vector3d& camera_point);

/// The four outer corners of the marker in the image, px, clockwise from the marker's own top left.
/// Throws vp::InputError if a corner is not in front of the camera.
std::array<PixelPoint, 4> project_marker(const Camera& camera, const Pose& pose,
                                         double side_m = marker_side_m);

/// Angle of the rotation that leads from one pose to the other, degrees, 0 to 180.
double rotation_error_deg(const Pose& a, const Pose& b);

/// Distance between the two translations, mm.
double translation_error_mm(const Pose& a, const Pose& b);

/// Throws vp::InputError unless everything is finite and the rotation is one (orthonormal,
/// determinant +1, within 1e-6).
void validate(const Pose& pose);

}  // namespace platform
