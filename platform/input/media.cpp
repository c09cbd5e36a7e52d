#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include <host/process.h>
#include <input/image_file.h>
#include <input/media.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#define MARKERVP_TEXT_OF(name) #name
#define MARKERVP_TEXT(name) MARKERVP_TEXT_OF(name)

namespace platform::input {

namespace {

constexpr const char* plugin_name = "libmarkervp_media.so";

}  // namespace

const Media& load_media(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    const std::string path = (std::filesystem::path(folder) / plugin_name).string();
    if (!std::filesystem::exists(path)) continue;
    // imgcodecs reads its limit once, when it is loaded.
    ::setenv("OPENCV_IO_MAX_IMAGE_PIXELS", std::to_string(most_pixels).c_str(), 1);
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      throw vp::InputError("image and video files cannot be read: '" + path + "': " +
                           vp::load_problem(path, ::dlerror()) + "; install markervp completely");
    }
    const auto entry = reinterpret_cast<decltype(&MARKERVP_MEDIA_ENTRY)>(
        ::dlsym(library, MARKERVP_TEXT(MARKERVP_MEDIA_ENTRY)));
    if (entry == nullptr) {
      throw vp::InputError("'" + path +
                           "' is of another version than this program; install both anew");
    }
    return *entry();
  }
  throw vp::InputError("image and video files cannot be read: " + std::string(plugin_name) +
                       " is missing in " + vp::one_of(folders) + "; install markervp completely");
}

const Media& media() {
  static const Media& loaded = load_media(host::library_folders());
  return loaded;
}

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
