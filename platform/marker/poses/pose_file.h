#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <marker/poses/convention.h>

namespace platform::poses {

/// What a frame of a run shows.
struct PoseFrame {
  std::string input;
  std::uint64_t index = 0;
  std::optional<double> taken_us = {};  ///< simulated time; none: the run does not tell
  std::vector<FoundPose> found = {};    ///< markers, then the board, as result.json has them
};

/// The frames of a result.json, or of the folder that has one. Throws vp::InputError for what is
/// none.
std::vector<PoseFrame> read_poses(const std::string& path);

}  // namespace platform::poses
