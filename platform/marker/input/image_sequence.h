#pragma once

#include <string>
#include <vector>

namespace platform::input {

/// The files of "frames/%04d.png", as ffmpeg and OpenCV name the pictures of a video.
struct ImageSequence {
  std::vector<std::string> files;  ///< in the order of their numbers
  std::string gap;                 ///< "frames/0007.png" if that is missing between two; or empty
};

/// True if the last part of a path has one number to be filled in: %d, %4d or %04d.
bool is_sequence(const std::string& path);

/// Throws vp::InputError if the folder cannot be read, or has no file of that name.
ImageSequence find_sequence(const std::string& path);

}  // namespace platform::input
