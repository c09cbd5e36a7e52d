#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <marker/scene/grey_image.h>

namespace platform::input {

/// An image, or a picture of a video, with more pixels than these is refused before it is decoded:
/// a header of a few bytes must not claim the memory of the machine.
constexpr std::uint64_t most_pixels = 8192 * 8192;

/// How a message continues that says so.
constexpr const char* too_many_pixels = "more pixels than 8192x8192: scale it down first";

/// Why codecs give nothing.
enum class Unreadable {
  damaged,
  too_large,
  no_levels  ///< its floating-point samples are no grey levels
};

/// What an image's samples are.
enum class Samples { whole, floating };

template <typename Content>
using Decoded = std::variant<Content, Unreadable>;

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
  /// Decodes an image file's content to 8 bits of grey: colour by the codec's or OpenCV's luma, 16
  /// bits by their upper 8, alpha ignored, turned upright where the file says how. Floating-point
  /// samples are shares of white if none is above 1, else levels up to 255.
  virtual Decoded<GreyImage> decode_image(const std::vector<std::uint8_t>& bytes,
                                          Samples samples) const = 0;
  /// Opens a regular file. Reads no other file that it names, and gives up after half a minute of
  /// searching for a picture.
  virtual Decoded<std::unique_ptr<VideoStream>> open_video(const std::string& path) const = 0;
};

/// Raised with every change of the classes above: the plug-in's entry point carries it in its name.
#define MARKERVP_MEDIA_ENTRY markervp_media_3

/// The plug-in, loaded on the first call from `libmarkervp_media.so` in one of library_folders().
/// Throws vp::InputError if it is missing or does not fit.
const Media& media();

/// The same from the first of `folders` that has it, without remembering it.
const Media& load_media(const std::vector<std::string>& folders);

/// Opens a video file. Throws vp::InputError if it is no regular file, no video that can be read,
/// or has pictures of more than most_pixels.
std::unique_ptr<VideoStream> open_video(const std::string& path);

}  // namespace platform::input

/// The plug-in's entry point.
extern "C" __attribute__((visibility("default"))) const platform::input::Media*
MARKERVP_MEDIA_ENTRY();
