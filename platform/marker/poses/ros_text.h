#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <marker/poses/pose_text.h>

/// Messages of ROS 2 as a text, which needs no ROS: YAML, "---" behind each, as
/// `ros2 topic echo` prints and `ros2 topic pub --yaml-file` reads them.
namespace platform::poses {

constexpr std::uint64_t ns_per_s = 1'000'000'000;

/// geometry_msgs/msg/PoseWithCovarianceStamped, one for each frame that shows the marker.
std::string ros_pose(const std::vector<PoseFrame>& frames, const TextOptions& options,
                     std::vector<std::string>& warnings);

/// tf2_msgs/msg/TFMessage, one a frame: from the camera to "4x4_250:7", apriltag_ros' names.
std::string ros_transforms(const std::vector<PoseFrame>& frames, const TextOptions& options,
                           std::vector<std::string>& warnings);

/// vision_msgs/msg/Detection3DArray, one a frame. A hypothesis' score is the share of the code's
/// cells that were right.
std::string ros_detections(const std::vector<PoseFrame>& frames, const TextOptions& options,
                           std::vector<std::string>& warnings);

}  // namespace platform::poses
