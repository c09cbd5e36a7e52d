#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <report/result.h>
#include <report/summary.h>

/// Phrases that console and pictures share.

namespace platform::report {

/// "1 blob", "2 blobs".
std::string counted(std::uint64_t count, const std::string& noun);

/// "31 corners   36 feature words   threshold 128". What was lost has a warning.
std::string counts_text(const FrameReport& frame);

/// "pitch 0.1 yaw 30.0 roll -2.5 deg": the angles of R = Rz(roll) * Ry(yaw) * Rx(pitch).
std::string angles_text(const Eigen::Matrix3d& rotation);

/// "corner 0.91 px   translation 12.3 mm   rotation 0.44 deg", what is known of it.
std::string error_text(const FoundMarker& found, const GroundTruth& truth);

/// Lines are at most this long, unless a name alone is longer.
constexpr std::size_t console_width = 100;

/// A few lines on one frame: marker, corners, pose, error where the truth is known, counts, time
/// per stage. `total` is the number of frames of the run, where known.
std::string frame_text(const FrameReport& frame, std::optional<std::uint64_t> total = std::nullopt);

/// What the run amounts to: frames, FPS, latency, mean errors, and a table of the stages. Of a
/// program that reported no frame: when it ended, and how.
std::string summary_text(const Summary& summary, const RunFacts& facts);

}  // namespace platform::report
