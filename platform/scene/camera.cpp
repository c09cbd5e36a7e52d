#include <scene/camera.h>
#include <vp/error.h>

#include <cmath>
#include <string>

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

}  // namespace platform
