#pragma once

#include <optional>
#include <string>
#include <vector>

#include <marker/input/calibration_file.h>

namespace platform::input {

/// Entries of a camera file in the words of OpenCV and ROS, where they were in those of another
/// program:
///
///   Kalibr      a camchain of one camera: `intrinsics` fu fv pu pv, `distortion_coeffs`
///   EuRoC       the sensor.yaml of a data set: the same at the top level
///   MATLAB      cameraParameters, as text: a transposed `IntrinsicMatrix` or a `K`, radial and
///               tangential coefficients apart, the first pixel at (1, 1)
///   ORB-SLAM    `Camera.fx`, `Camera.k1` … of PinHole and KannalaBrandt8
///
/// Others are returned as they are. `what`: the file, for messages. Throws vp::InputError: several
/// cameras, a projection that is not a pinhole's, numbers that are not as many as they should be.
std::vector<CalibrationEntry> in_known_words(std::vector<CalibrationEntry> entries,
                                             const std::string& what);

/// The entries of a file that is neither YAML, JSON nor XML: an ost.txt of ROS, or the script
/// Calib_Results.m of Caltech's toolbox. None: it is neither. Throws vp::InputError if it is and
/// cannot be read.
std::optional<std::vector<CalibrationEntry>> read_script(const std::string& text,
                                                         const std::string& what);

}  // namespace platform::input
