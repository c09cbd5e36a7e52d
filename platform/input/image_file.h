#pragma once

#include <optional>
#include <string>

#include <scene/grey_image.h>

namespace platform::input {

/// Reads an image file as 8-bit grey (see Media::read_image). Plain 8-bit grey PNG and PGM files
/// are read directly, all others by OpenCV; the pixels are the same either way. Nothing if the file
/// is no image of a format in ImageHeader::Format. Throws vp::InputError if it is missing, no
/// regular file, unreadable, empty, truncated, damaged, zero-sized, or has more than most_pixels.
std::optional<GreyImage> read_image(const std::string& path);

/// Size of an image, px.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// The same checks with as little decoding as they need; nothing if the file is no image at all.
std::optional<ImageSize> inspect_image(const std::string& path);

}  // namespace platform::input
