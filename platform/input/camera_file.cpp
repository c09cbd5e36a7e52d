#include <input/camera_file.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <input/calibration_values.h>
#include <vp/error.h>

namespace platform::input {

namespace {

constexpr double pixel_centre = 0.5;
constexpr std::size_t matrix_size = 9;

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw vp::InputError("camera file '" + path + "' " + problem);
}

const std::vector<double>* first_of(const CalibrationValues& values,
                                    const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found = values.find(name);
    if (found != values.end()) return &found->second;
  }
  return nullptr;
}

int side(const std::vector<double>& values, const std::string& path) {
  const double side = values.size() == 1 ? values[0] : 0;
  if (!(side >= 1 && side <= largest_side_px) || side != std::floor(side)) {
    refuse(path, "has an image width or height that is not 1 to 16384 px");
  }
  return static_cast<int>(side);
}

void read_matrix(const CalibrationValues& values, const std::string& path, Camera& camera) {
  const std::vector<double>* k = first_of(values, {"cameramatrix", "k", "intrinsicmatrix"});
  if (k == nullptr) refuse(path, "has no camera_matrix (OpenCV or ROS calibration expected)");
  if (k->size() != matrix_size) refuse(path, "has a camera_matrix that is not 3x3");
  const bool finite = std::all_of(k->begin(), k->end(), [](double v) { return std::isfinite(v); });
  const std::vector<double>& m = *k;
  const bool affine = m[3] == 0 && m[6] == 0 && m[7] == 0 && m[8] == 1;
  if (!finite || !affine || !(m[0] > 0) || !(m[4] > 0)) {
    refuse(path, "has a camera_matrix that is not [fx 0 cx; 0 fy cy; 0 0 1] with fx, fy > 0");
  }
  if (m[1] != 0) refuse(path, "has a skewed camera_matrix: calibrate without skew");
  camera.fx = m[0];
  camera.fy = m[4];
  camera.cx = m[2] + pixel_centre;
  camera.cy = m[5] + pixel_centre;
}

}  // namespace

CalibratedCamera read_camera_file(const std::string& path) {
  const CalibrationValues values = read_calibration_values(path);
  CalibratedCamera result;
  result.name = std::filesystem::path(path).filename().string();
  read_matrix(values, path, result.camera);
  const std::vector<double>* width = first_of(values, {"imagewidth", "width"});
  const std::vector<double>* height = first_of(values, {"imageheight", "height"});
  if ((width == nullptr) != (height == nullptr)) {
    refuse(path, "has only one of image_width and image_height");
  }
  result.has_size = width != nullptr;
  if (result.has_size) {
    result.camera.width = side(*width, path);
    result.camera.height = side(*height, path);
  }
  const auto* distortion =
      first_of(values, {"distortioncoefficients", "distcoeffs", "distortion", "d"});
  if (distortion != nullptr) result.distortion = *distortion;
  return result;
}

Camera camera_for(const CalibratedCamera& calibrated, ImageSize size) {
  Camera camera = calibrated.camera;
  const bool fits = camera.width == size.width && camera.height == size.height;
  if (calibrated.has_size && !fits) {
    throw vp::InputError("camera file '" + calibrated.name + "' is for images of " +
                         std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                         " px, not " + std::to_string(size.width) + "x" +
                         std::to_string(size.height) + ": calibrate at the image's own size");
  }
  camera.width = size.width;
  camera.height = size.height;
  return camera;
}

bool has_distortion(const CalibratedCamera& calibrated) {
  return std::any_of(calibrated.distortion.begin(), calibrated.distortion.end(),
                     [](double value) { return value != 0; });
}

}  // namespace platform::input
