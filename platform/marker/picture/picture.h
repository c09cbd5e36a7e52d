#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <facts/result.h>
#include <marker/scene/grey_image.h>

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

/// The image with what was found in it: corners as small triangles that point like the tip, blobs'
/// boxes (thin), candidates, the marker's outline with its corners numbered clockwise from its own
/// top left, the axes u, v, w, the ID; below a strip with time, pose and error, and the legend. The
/// image is enlarged by whole numbers so that single pixels and features stay visible (twice at 640
/// px); colours are Okabe and Ito's, told apart with any colour vision.
Picture annotate(const GreyImage& image, const facts::UnitReport& frame);

/// File name of a frame's picture: "0007_photo.png". Unusual characters of the input's name become
/// '_'.
std::string picture_name(const facts::UnitReport& frame);

}  // namespace platform::picture
