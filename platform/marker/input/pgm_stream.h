#pragma once

#include <memory>
#include <string>

#include <marker/input/media.h>

namespace platform::input {

/// True if a file holds binary PGM images one behind the other, as `ffmpeg -c:v pgm -f image2pipe`
/// writes them.
bool is_pgm_stream(const std::string& path);

/// Its images. next() throws vp::InputError for one that is cut or damaged.
std::unique_ptr<VideoStream> open_pgm_stream(const std::string& path);

}  // namespace platform::input
