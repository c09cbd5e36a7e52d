#pragma once

#include <cstdint>
#include <string>

#include <report/result.h>

/// Phrases that console and pictures share.
namespace platform::report {

/// "1 blob", "2 blobs".
std::string counted(std::uint64_t count, const std::string& noun);

/// "pitch 0.1 yaw 30.0 roll -2.5 deg": the angles of R = Rz(roll) * Ry(yaw) * Rx(pitch).
std::string angles_text(const Eigen::Matrix3d& rotation);

/// "corner 0.91 px   translation 12.3 mm   rotation 0.44 deg", what is known of it.
std::string error_text(const FoundMarker& found, const GroundTruth& truth);

}  // namespace platform::report
