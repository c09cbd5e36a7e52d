#pragma once

#include <string>
#include <vector>

#include <marker/poses/pose_text.h>

/// What the formats have in common: which poses they write.
namespace platform::poses {

/// What a frame shows of what is asked for, in the convention that is asked for.
std::vector<FoundPose> found_in(const PoseFrame& frame, const TextOptions& options);

/// The same with poses only, each name once: of a marker that is seen twice it is unknown which one
/// is meant, so none of them counts, and a warning says so.
std::vector<FoundPose> placed_in(const PoseFrame& frame, const TextOptions& options,
                                 std::vector<std::string>& warnings);

/// Throws vp::InputError if no frame shows what is asked for.
void check_name(const std::vector<PoseFrame>& frames, const TextOptions& options);

/// Throws vp::InputError unless all poses are of one marker, or of the board.
void require_one_name(const std::vector<PoseFrame>& frames, const TextOptions& options,
                      const std::string& format);

/// When the image was taken, ns of simulated time. Throws vp::InputError if the run does not tell.
std::uint64_t taken_ns(const PoseFrame& frame);

/// A rotation as ROS and others have it: x, y, z, w; w is not negative.
std::array<double, 4> quaternion_of(const Eigen::Matrix3d& rotation);

}  // namespace platform::poses
