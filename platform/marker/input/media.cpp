#include <cstdlib>

#include <host/process.h>
#include <marker/input/image_file.h>
#include <marker/input/media.h>
#include <marker/input/pgm_stream.h>
#include <vp/error.h>

#define MARKERVP_TEXT_OF(name) #name
#define MARKERVP_TEXT(name) MARKERVP_TEXT_OF(name)

namespace platform::input {

const Media& load_media(const std::vector<std::string>& folders) {
  // imgcodecs reads its limit once, when it is loaded.
  ::setenv("OPENCV_IO_MAX_IMAGE_PIXELS", std::to_string(most_pixels).c_str(), 1);
  const auto entry = reinterpret_cast<decltype(&MARKERVP_MEDIA_ENTRY)>(
      host::load_plugin(folders, "libmarkervp_media.so", MARKERVP_TEXT(MARKERVP_MEDIA_ENTRY),
                        "image and video files cannot be read"));
  return *entry();
}

const Media& media() {
  static const Media& loaded = load_media(host::library_folders());
  return loaded;
}

std::unique_ptr<VideoStream> open_video(const std::string& path) {
  require_regular_file(path);
  if (is_pgm_stream(path)) return open_pgm_stream(path);
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
