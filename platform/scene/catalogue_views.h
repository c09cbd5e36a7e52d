#pragma once

#include <vector>

#include <scene/scene.h>

namespace platform {

/// Squares in the last picture of thesis 5.2.4, the marker included.
constexpr int most_squares = 15;

/// The marker and `count` - 1 squares around it, 1 to 15 (thesis 5.2.4).
void fill_squares(Scene& scene, int count);

/// A view of thesis 5.2.1. The thesis names the IDs but not the places: decision.
struct IdentificationView {
  int marker_id;
  Eigen::Vector3d centre;  ///< of the marker in the camera frame, m
  double pitch;            ///< degrees; the rotation is Rx(pitch) * Ry(yaw) * Rz(roll)
  double yaw;              ///< degrees
  double roll;             ///< degrees
};

const std::vector<IdentificationView>& identification_views();

Pose pose_of(const IdentificationView& view);

/// The picture that a run without input shows: about 110 feature words.
void fill_demo(Scene& scene);

}  // namespace platform
