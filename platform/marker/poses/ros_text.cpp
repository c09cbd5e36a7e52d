#include <marker/poses/ros_text.h>

#include <fmt/format.h>

#include <cstdlib>

#include <marker/poses/pose_selection.h>

namespace platform::poses {

namespace {

using Warnings = std::vector<std::string>;

constexpr const char* end_of_message = "---\n";

/// A text of YAML that may mean nothing else.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string indented(const std::string& text, std::size_t by) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    result += std::string(by, ' ') + text.substr(at, end - at);
    at = end;
  }
  return result;
}

/// An entry of a list.
std::string item(const std::string& text) {
  std::string result = indented(text, 2);
  result[0] = '-';
  return result;
}

std::string header(const PoseFrame& frame, const TextOptions& options) {
  const std::uint64_t ns = taken_ns(frame);
  return fmt::format("header:\n  stamp:\n    sec: {}\n    nanosec: {}\n  frame_id: {}\n",
                     ns / ns_per_s, ns % ns_per_s, quoted(options.camera_frame));
}

std::string vector(const char* name, const Eigen::Vector3d& v) {
  return fmt::format("{}:\n  x: {:.9f}\n  y: {:.9f}\n  z: {:.9f}\n", name, v.x(), v.y(), v.z());
}

std::string quaternion(const char* name, const Eigen::Matrix3d& rotation) {
  const auto q = quaternion_of(rotation);
  return fmt::format("{}:\n  x: {:.9f}\n  y: {:.9f}\n  z: {:.9f}\n  w: {:.9f}\n", name, q[0], q[1],
                     q[2], q[3]);
}

/// geometry_msgs/Pose.
std::string pose(const char* name, const Pose& pose) {
  return fmt::format("{}:\n", name) + indented(vector("position", pose.translation), 2) +
         indented(quaternion("orientation", pose.rotation), 2);
}

/// geometry_msgs/PoseWithCovariance. Zeros: not known.
std::string pose_with_covariance(const FoundPose& found) {
  std::string text = "pose:\n" + indented(pose("pose", *found.pose), 2) + "  covariance:\n";
  for (const double value : found.covariance.value_or(PoseCovariance{}))
    text += fmt::format("  - {:.5e}\n", value);
  return text;
}

/// As apriltag_ros names its frames.
std::string name_of(const FoundPose& found) {
  return found.is_board() ? found.name : found.family + ":" + found.name;
}

/// The cells of a family's code: of "5x5_50" and "apriltag_36h11" 25 and 36; "aruco_original" has
/// no number in its name, and 5 x 5.
unsigned cells_of(const std::string& family) {
  const std::size_t by = family.find('x'), digit = family.find_first_of("0123456789");
  if (digit == std::string::npos) return 25;
  const auto first = static_cast<unsigned>(std::atoi(family.c_str() + digit));
  return by == digit + 1 ? first * first : first;
}

/// The share of the code's cells that were right.
double score(const FoundPose& found) {
  if (found.is_board() || !found.corrected) return 1;
  const unsigned cells = found.code_cells ? *found.code_cells : cells_of(found.family);
  return 1 - static_cast<double>(*found.corrected) / cells;
}

std::string detection(const PoseFrame& frame, const FoundPose& found, const Pose& middle,
                      const TextOptions& options) {
  const std::string hypothesis = fmt::format("hypothesis:\n  class_id: {}\n  score: {:.6f}\n",
                                             quoted(name_of(found)), score(found)) +
                                 pose_with_covariance(found);
  const std::string box = pose("center", middle) + vector("size", {found.side_m, found.side_m, 0});
  return header(frame, options) + "results:\n" + item(hypothesis) + "bbox:\n" + indented(box, 2) +
         fmt::format("id: {}\n", quoted(found.name));
}

/// Where the marker's middle is, whatever the convention.
Pose middle_of(const FoundPose& found, const TextOptions& options) {
  Pose middle = *found.pose;
  if (options.convention->in_middle || found.is_board()) return middle;
  const double half_m = found.side_m / 2;
  middle.translation += middle.rotation * Eigen::Vector3d(half_m, half_m, 0);
  return middle;
}

}  // namespace

std::string ros_pose(const std::vector<PoseFrame>& frames, const TextOptions& options,
                     Warnings& warnings) {
  require_one_name(frames, options, "pose");
  std::string text;
  for (const PoseFrame& frame : frames) {
    for (const FoundPose& found : placed_in(frame, options, warnings))
      text += header(frame, options) + pose_with_covariance(found) + end_of_message;
  }
  return text;
}

std::string ros_transforms(const std::vector<PoseFrame>& frames, const TextOptions& options,
                           Warnings& warnings) {
  std::string text;
  for (const PoseFrame& frame : frames) {
    std::string transforms;
    for (const FoundPose& found : placed_in(frame, options, warnings)) {
      const std::string transform = vector("translation", found.pose->translation) +
                                    quaternion("rotation", found.pose->rotation);
      transforms += item(header(frame, options) +
                         fmt::format("child_frame_id: {}\ntransform:\n", quoted(name_of(found))) +
                         indented(transform, 2));
    }
    text +=
        (transforms.empty() ? "transforms: []\n" : "transforms:\n" + transforms) + end_of_message;
  }
  return text;
}

std::string ros_detections(const std::vector<PoseFrame>& frames, const TextOptions& options,
                           Warnings& warnings) {
  std::string text;
  for (const PoseFrame& frame : frames) {
    if (!frame.taken_us) {
      warnings.push_back("frame " + std::to_string(frame.index) +
                         " is left out: it does not say when its image was taken");
      continue;
    }
    std::string detections;
    for (const FoundPose& found : found_in(frame, options)) {
      if (found.pose)
        detections += item(detection(frame, found, middle_of(found, options), options));
    }
    text += header(frame, options) +
            (detections.empty() ? "detections: []\n" : "detections:\n" + detections) +
            end_of_message;
  }
  return text;
}

}  // namespace platform::poses
