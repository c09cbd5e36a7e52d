#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <input/input_frame.h>
#include <input/input_options.h>

namespace platform::input {

/// Renders the scenes among these inputs now, once, for this process and those that it forks:
/// rendering takes longer than simulating a frame. Stops when those kept fill `most_bytes`; others
/// are rendered when they are needed. Throws vp::InputError for an unknown input.
void keep_scenes(const std::vector<std::string>& inputs, const InputOptions& options,
                 std::size_t most_bytes);

/// A kept scene as that camera sees it; null if it was not kept.
const InputFrame* kept_scene(const std::string& name, const Camera& camera);

}  // namespace platform::input
