#pragma once

#include <optional>
#include <string>
#include <vector>

#include <marker/poses/convention.h>
#include <marker/poses/pose_file.h>

namespace platform::poses {

/// How large markers are.
struct SideRule {
  int first_id = 0, last_id = 0;
  double side_m = 0;
};

/// "7=0.05m", "10-19=0.2m", or "0.1m" for all. Throws vp::InputError.
SideRule side_rule(const std::string& text);

/// How poses are written.
struct TextOptions {
  const Convention* convention = nullptr;
  std::string camera_frame = "camera_optical_frame";  ///< frame_id of ROS' messages
  std::optional<std::string> name = {};  ///< only this marker, "7", or "board"; none: all
  std::vector<SideRule> sides = {};  ///< the last one that fits counts; none: as the run took it
};

/// Poses as a text.
struct Format {
  const char* name;  ///< "csv"
  const char* description;
  /// See poses_text().
  std::string (*write)(const std::vector<PoseFrame>& frames, const TextOptions& options,
                       std::vector<std::string>& warnings);
};

/// A line a marker: `csv`. A line a frame: `json`. A trajectory: `tum`. ROS 2, as
/// `ros2 topic echo` prints messages: `pose`, `transforms`, `detections`.
const std::vector<Format>& formats();

/// Throws vp::InputError for what the format cannot say, and for a name that no frame has; what it
/// leaves out is added to `warnings`.
std::string poses_text(const Format& format, const std::vector<PoseFrame>& frames,
                       const TextOptions& options, std::vector<std::string>& warnings);

}  // namespace platform::poses
