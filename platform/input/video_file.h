#pragma once

#include <memory>
#include <string>

#include <input/media.h>

namespace platform::input {

/// Opens a video file. Throws vp::InputError if it is no regular file, no video that can be read,
/// or has pictures of more than most_pixels.
std::unique_ptr<VideoStream> open_video(const std::string& path);

}  // namespace platform::input
