#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <scene/grey_image.h>

namespace platform::input {

/// A video, picture by picture.
class VideoStream {
 public:
  virtual ~VideoStream() = default;
  /// The next picture in grey; nothing when the video is over.
  virtual std::optional<GreyImage> next() = 0;
  /// What the file's header promises; 0 if it says nothing.
  virtual std::uint64_t promised_frames() const = 0;
};

/// What needs OpenCV's codecs. They come with 240 libraries that take 0.1 s to load, so this
/// interface is all that the program knows of them: a plug-in implements it and is loaded when it
/// is first needed.
class Media {
 public:
  virtual ~Media() = default;
  /// True if the file begins like an image of a format that read_image() knows.
  virtual bool is_image(const std::string& path) const = 0;
  /// Decodes to 8 bits of grey: colour by the codec's or OpenCV's luma, 16 bits by their upper 8,
  /// alpha ignored, turned upright where the file says how. Nothing if the file is damaged or
  /// truncated.
  virtual std::optional<GreyImage> read_image(const std::string& path) const = 0;
  /// Null if the file is no video that can be read.
  virtual std::unique_ptr<VideoStream> open_video(const std::string& path) const = 0;
};

/// Raised with every change of the classes above: the plug-in's entry point carries it in its name.
#define MARKERVP_MEDIA_ENTRY markervp_media_1

/// The plug-in, loaded on the first call from `libmarkervp_media.so` in one of library_folders().
/// Throws vp::InputError if it is missing or does not fit.
const Media& media();

/// The same from the first of `folders` that has it, without remembering it.
const Media& load_media(const std::vector<std::string>& folders);

}  // namespace platform::input

/// The plug-in's entry point.
extern "C" __attribute__((visibility("default"))) const platform::input::Media*
MARKERVP_MEDIA_ENTRY();
