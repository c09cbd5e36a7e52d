#include <marker/input/camera_file.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <marker/lens_models.h>

namespace platform::input {

bool is_off_centre(const Camera& camera) {
  constexpr double usual = 0.25;
  return std::abs(camera.cx - camera.width / 2.0) > usual * camera.width ||
         std::abs(camera.cy - camera.height / 2.0) > usual * camera.height;
}

namespace {

/// How far from the axis, at focal length 1, the picture shows a ray: of a fisheye lens by its
/// angle, else by its tangent. None beyond what the model has.
std::optional<double> seen_radius(const Camera& camera, double ray) {
  const std::array<double, 12>& k = camera.distortion;
  const double r2 = ray * ray;
  if (camera.lens_model == marker::LensModel::equidistant) {
    if (ray > marker::widest_angle) return std::nullopt;
    return ray * (1 + r2 * (k[0] + r2 * (k[1] + r2 * (k[2] + r2 * k[3]))));
  }
  const double below = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  if (!(below > 0)) return std::nullopt;
  return ray * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / below;
}

}  // namespace

std::optional<double> lens_reach_px(const CalibratedCamera& calibrated, ImageSize usual) {
  const Camera& known = calibrated.camera;
  const Camera camera =
      camera_for(calibrated, calibrated.has_size ? ImageSize{known.width, known.height} : usual);
  double corner = 0;
  for (const double x : {0, camera.width}) {
    for (const double y : {0, camera.height}) {
      corner =
          std::max(corner, std::hypot((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy));
    }
  }
  double seen = 0;
  for (int step = 1; seen < corner; ++step) {
    constexpr double step_size = 1e-3;
    const std::optional<double> next = seen_radius(camera, step * step_size);
    if (!next || !(*next > seen)) return seen * std::min(camera.fx, camera.fy);
    seen = *next;
  }
  return std::nullopt;
}

}  // namespace platform::input
