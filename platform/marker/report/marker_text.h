#pragma once

#include <string>
#include <vector>

#include <facts/summary.h>
#include <marker/report/marker_frame.h>
#include <Eigen/Core>

/// Phrases that the console and the pictures of the marker application share.
namespace platform {

/// "pitch 0.1 yaw 30.0 roll -2.5 deg": the angles of R = Rz(roll) * Ry(yaw) * Rx(pitch).
std::string angles_text(const Eigen::Matrix3d& rotation);

/// "corner 0.91 px   translation 12.3 mm   rotation 0.44 deg", what is known of it.
std::string error_text(const FoundMarker& found, const GroundTruth& truth);

/// What a run's summary says of markers: the mean errors, where the truth is known.
std::vector<std::string> marker_summary(const facts::Summary& summary);

}  // namespace platform
