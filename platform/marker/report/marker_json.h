#pragma once

#include <array>

#include <marker/report/marker_frame.h>
#include <marker/scene/pose.h>
#include <nlohmann/json.hpp>

/// Members of result.json that the marker application adds. Decimal places: px 6, rotations and
/// metres 9, mm and degrees 6; covariances and motions have six digits.
///
/// `iterations` and `corrected` are there if the program tells them, and `code_cells` if the marker
/// is of a dictionary of the user's own. A marker without pose has neither `reprojection_px` nor
/// `pose`, and its error has `corner_px` only. `taken_us` is when the image was taken, in simulated
/// time: the middle of its exposure, or the start of its work.
namespace platform {

nlohmann::ordered_json corners_json(const std::array<PixelPoint, 4>& corners_px);
nlohmann::ordered_json pose_json(const Pose& pose);
nlohmann::ordered_json covariance_json(const PoseCovariance& covariance);

}  // namespace platform
