#include <report/error_measure.h>

#include <Eigen/Core>

namespace platform::report {

MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth) {
  MarkerError error;
  for (std::size_t i = 0; i < found.corners_px.size(); ++i) {
    const PixelPoint &a = found.corners_px[i], &b = truth.corners_px[i];
    error.corner_px += Eigen::Vector2d(a.x - b.x, a.y - b.y).norm() / 4;
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
