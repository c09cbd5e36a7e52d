#pragma once

#include <optional>
#include <string>
#include <vector>

#include <marker/input/image_file.h>
#include <marker/scene/pose.h>

namespace platform::input {

/// A camera as a calibration found it.
struct CalibratedCamera {
  std::string name;  ///< of the file, without folders
  Camera camera;  ///< principal point in this project's pixel coordinates; size only if `has_size`
  bool has_size = false;
  marker::LensModel lens_model = marker::LensModel::brown_conrady;
  std::vector<double> distortion;  ///< in the order of the model; empty: none
  Response response = {};          ///< what the file says of it
  /// What is odd in the file and does not keep it from being used: "has ...".
  std::vector<std::string> oddities = {};
};

/// Reads a camera calibration: an OpenCV FileStorage (YAML, XML or JSON), a ROS camera_info YAML,
/// or a file that calibration_dialect.h knows. Lens models by name: plumb_bob (Brown-Conrady),
/// rational_polynomial, with or without a thin prism, and equidistant (OpenCV's fisheye).
/// Known names, in any upper and lower case, with or without underscores: `camera_matrix` or `K`
/// (3x3), `distortion_coefficients`, `dist_coeffs` or `D`, `image_width` and `image_height` or
/// `width` and `height`. Files put the centre of the first pixel at (0, 0); here it is (0.5, 0.5).
/// `response` is what light the grey levels stand for: "linear", "srgb", "rec709", an exponent, or
/// the light of 256 levels.
/// Throws vp::InputError: missing, malformed, of another format; another lens model, coefficients
/// that the model does not have or that may be another's, or distortion under an unknown name; a
/// response that is not known or falls; no camera matrix, focal length not positive, skew; images
/// that are binned, cut or turned; contradictions.
CalibratedCamera read_camera_file(const std::string& path);

/// The camera for images of `size`. Throws vp::InputError if the file is for another size.
Camera camera_for(const CalibratedCamera& calibrated, ImageSize size);

/// True if the lens bends the image.
bool has_distortion(const CalibratedCamera& calibrated);

/// Where the lens's model folds back: px from the principal point, beyond which no ray leads to a
/// pixel. None if it does not within the picture, which is of the `usual` size if the file does not
/// say. Radial part only.
std::optional<double> lens_reach_px(const CalibratedCamera& calibrated, ImageSize usual);

/// True if the principal point is so far from the middle that the file may be for another size.
bool is_off_centre(const Camera& camera);

}  // namespace platform::input
