#include <report/words.h>

#include <algorithm>
#include <cmath>

#include <report/error_measure.h>
#include <vp/text.h>

namespace platform::report {

namespace {

constexpr double degrees_per_radian = 57.29577951308232;

std::string degrees(double radians) {
  return vp::format_fixed(radians * degrees_per_radian, 1);
}

}  // namespace

std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string angles_text(const Eigen::Matrix3d& r) {
  return "pitch " + degrees(std::atan2(r(2, 1), r(2, 2))) + " yaw " +
         degrees(std::asin(std::clamp(-r(2, 0), -1.0, 1.0))) + " roll " +
         degrees(std::atan2(r(1, 0), r(0, 0))) + " deg";
}

std::string error_text(const FoundMarker& found, const GroundTruth& truth) {
  const MarkerError error = measure_error(found, truth);
  const std::string text = "corner " + vp::format_fixed(error.corner_px, 2) + " px";
  if (!found.has_pose) return text;
  return text + "   translation " + vp::format_fixed(error.translation_mm, 1) + " mm   rotation " +
         vp::format_fixed(error.rotation_deg, 2) + " deg";
}

}  // namespace platform::report
