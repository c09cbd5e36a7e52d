#include <report/error_measure.h>

#include <cmath>

namespace platform::report {

MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth) {
  MarkerError error;
  for (std::size_t i = 0; i < found.corners_px.size(); ++i) {
    const double dx = found.corners_px[i].x - truth.corners_px[i].x;
    const double dy = found.corners_px[i].y - truth.corners_px[i].y;
    error.corner_px += std::sqrt(dx * dx + dy * dy) / 4;
  }
  if (found.has_pose) {
    error.translation_mm = translation_error_mm(found.pose, truth.pose);
    error.rotation_deg = rotation_error_deg(found.pose, truth.pose);
  }
  return error;
}

const GroundTruth* truth_of(const FrameReport& frame, const FoundMarker& found) {
  return frame.truth && frame.truth->marker_id == found.id ? &*frame.truth : nullptr;
}

}  // namespace platform::report
