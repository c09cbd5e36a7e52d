#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <facts/result.h>
#include <facts/summary.h>

/// Phrases that console and pictures share.

namespace platform::result {

/// "1 blob", "2 blobs".
std::string counted(std::uint64_t count, const std::string& noun);

/// "31 corners   36 feature words   threshold 128". What was lost has a warning.
std::string counts_text(const facts::FrameReport& frame);

/// "pitch 0.1 yaw 30.0 roll -2.5 deg": the angles of R = Rz(roll) * Ry(yaw) * Rx(pitch).
std::string angles_text(const Eigen::Matrix3d& rotation);

/// "corner 0.91 px   translation 12.3 mm   rotation 0.44 deg", what is known of it.
std::string error_text(const facts::FoundMarker& found, const GroundTruth& truth);

/// Lines are at most this long, unless a name alone is longer.
constexpr std::size_t console_width = 100;

/// A few lines on one frame: marker, corners, pose, error where the truth is known, counts, time
/// per stage. `total` is the number of frames of the run, where known.
std::string frame_text(const facts::FrameReport& frame,
                       std::optional<std::uint64_t> total = std::nullopt);

/// What the run amounts to: frames, FPS, latency, mean errors, and a table of the stages. Of a
/// program that reported no frame: when it ended, and how.
std::string summary_text(const facts::Summary& summary, const facts::RunFacts& facts);

/// One line a clock beyond the speed grade.
std::vector<std::string> clock_warnings(const facts::ClockReport& clocks);
/// One line a clock that is not what was asked for, or that no chip makes.
std::string clock_text(const facts::ClockReport& clocks);

/// One line a module that misses timing: "pl.blob_detection misses timing: …".
std::vector<std::string> timing_warnings(const facts::TimingReport& timing);
/// One line for each kind of primitive that is short.
std::vector<std::string> resource_warnings(const facts::ResourceReport& resources);
/// A junction above what the device is specified for.
std::vector<std::string> power_warnings(const facts::PowerReport& power);

/// "power", "timing" and "fits" for the console, a line each.
std::string design_text(const std::optional<facts::PowerReport>& power,
                        const facts::ResourceReport& resources, const facts::TimingReport& timing);

}  // namespace platform::result
