#pragma once

#include <array>

#include <marker/scene/pose.h>
#include <nlohmann/json.hpp>

/// Members of result.json that the marker application adds. Decimal places: px 6, rotations and
/// metres 9, mm and degrees 6; covariances and motions have six digits.
///
/// `reprojection_px` and `iterations` are there if the program tells them. A marker without pose
/// has neither, no `pose`, and its error has `corner_px` only.
namespace platform {

nlohmann::ordered_json corners_json(const std::array<PixelPoint, 4>& corners_px);
nlohmann::ordered_json pose_json(const Pose& pose);

}  // namespace platform
