#include <input/video_file.h>

#include <input/file_bytes.h>
#include <vp/error.h>

namespace platform::input {

std::unique_ptr<VideoStream> open_video(const std::string& path) {
  require_regular_file(path);
  Decoded<std::unique_ptr<VideoStream>> video = media().open_video(path);
  const Unreadable* fault = std::get_if<Unreadable>(&video);
  if (fault == nullptr) return std::get<std::unique_ptr<VideoStream>>(std::move(video));
  if (*fault == Unreadable::too_large) {
    throw vp::InputError("video '" + path + "' has pictures of " + too_many_pixels);
  }
  throw vp::InputError("'" + path + "' is neither an image nor a video that can be read: " +
                       "convert it to PNG or AVI");
}

}  // namespace platform::input
