#pragma once

#include <map>
#include <string>
#include <vector>

namespace platform::input {

/// The numbers of a calibration file by name: a matrix row by row, a scalar as one number. Names
/// are in small letters without underscores.
using CalibrationValues = std::map<std::string, std::vector<double>>;

/// Reads the top level of an OpenCV FileStorage (YAML, XML, JSON) or of plain YAML as ROS writes
/// it; entries that are not numbers are left out. Throws vp::InputError if the file is missing,
/// empty or malformed.
CalibrationValues read_calibration_values(const std::string& path);

}  // namespace platform::input
