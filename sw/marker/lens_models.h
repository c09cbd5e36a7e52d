#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>

#include <array>
#include <cstdint>

namespace marker {

/// How a lens bends its pictures, by the names of OpenCV and ROS. The numbers are those of
/// hal_frame.lens_model.
enum class LensModel : std::uint32_t {
  brown_conrady,  ///< plumb_bob: k1 k2 p1 p2 k3
  rational,       ///< rational_polynomial, and with a thin prism: … k4 k5 k6 s1 s2 s3 s4
  equidistant,    ///< OpenCV's fisheye, Kannala–Brandt: k1 k2 k3 k4 of the angle
};
inline constexpr std::uint32_t lens_model_count = 3;

/// A camera with a lens of any of these models.
struct GeneralLens {
  Camera camera;
  LensModel model = LensModel::brown_conrady;
  std::array<double, 12> coefficients{};  ///< in the model's order; the rest is 0

  bool is_pinhole() const;
};

/// A ray farther off the axis has no ideal point: the plane of ideal points ends where their
/// distances grow without limit (decision). Radians.
inline constexpr double widest_angle = 1.31;

/// Where the picture shows an ideal point. Image px.
Point distort(const GeneralLens& lens, Point ideal);

/// Where a pinhole camera would see a point of the picture. False if the model has no such point:
/// where it folds back, or beyond the widest angle. Adds how often the lens was asked.
bool undistort(const GeneralLens& lens, Point image, Point& ideal, std::uint32_t& steps);

/// How the way of ideal points along `direction`, of length 1, grows in the picture: its gradient
/// around the image of `ideal`, ideal px for one px. Where a fisheye lens squeezes the picture, it
/// is longer than 1.
Point gradient(const GeneralLens& lens, Point ideal, Point direction);

}  // namespace marker
