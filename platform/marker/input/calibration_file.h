#pragma once

#include <string>
#include <vector>

namespace platform::input {

/// One entry of a calibration file.
struct CalibrationEntry {
  std::string name;             ///< as the file spells it, behind the names around it: "roi.width"
  std::vector<double> numbers;  ///< row by row; empty unless all of it is numbers
  std::string text;             ///< of a single value, and of a list that is not all numbers
  bool is_list = false;         ///< a list or a matrix, which may be empty
  std::size_t rows = 0, columns = 0;  ///< of a matrix that says so; 0: it does not
};

/// How a message ends that refuses a camera file of another format.
constexpr const char* accepted_calibrations =
    "OpenCV's FileStorage (YAML, XML or JSON), a camera_info YAML or ost.txt of ROS, a camchain of "
    "Kalibr or MATLAB's parameters, with camera_matrix or K and distortion_coefficients or D";

/// Every entry of an OpenCV FileStorage (YAML, XML, JSON) or of plain YAML as ROS writes it, in the
/// order of the file; a name may come twice. Throws vp::InputError if the file is missing, empty,
/// malformed, or of another format, which the message names if it is a well-known one.
std::vector<CalibrationEntry> read_calibration_file(const std::string& path);

/// The same of a text that is OpenCV's FileStorage or plain YAML, and need not be a camera's.
/// `what`: the file, for messages.
std::vector<CalibrationEntry> read_file_storage(const std::string& text, const std::string& what);

/// In small letters, without separators: "Camera_Matrix" and "cameraMatrix" are the same.
std::string plain_name(const std::string& name);

}  // namespace platform::input
