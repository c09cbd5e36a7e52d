#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <scene/grey_image.h>

namespace platform::picture {

/// A colour picture, three bytes a pixel (red, green, blue), row by row from the top left, no
/// padding.
struct Picture {
  int width = 0;   ///< px
  int height = 0;  ///< px
  std::vector<std::uint8_t> rgb;
};

/// A PNG file's bytes of a grey image. Equal images give equal bytes.
std::string encode_png(const GreyImage& image);

/// Writes a PNG file, whole or not at all. Equal pictures give equal bytes. Throws vp::InputError
/// if it cannot be written.
void write_png(const Picture& picture, const std::string& path);

}  // namespace platform::picture
