#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::input {

/// What an image file says of itself before it is decoded.
struct ImageHeader {
  /// `pgm` is the binary one (P5), `other` are BMP, JPEG 2000, PBM, PGM and PPM, TIFF and WebP.
  enum class Format { none, png, jpeg, pgm, other };

  Format format = Format::none;
  int width = 0;   ///< px; 0 if the format is `none` or `other`
  int height = 0;  ///< px
  /// 8-bit grey that needs nothing but decompression: read without OpenCV's codecs.
  bool plain_grey = false;
  /// Has Exif data, which may say that the picture lies on its side: width and height may be
  /// swapped.
  bool may_be_turned = false;
  std::size_t pixel_offset = 0;  ///< of the first pixel, for pgm
};

/// So many bytes of a file tell its format.
constexpr std::size_t format_bytes = 12;

/// The format that the first bytes of a file announce.
ImageHeader::Format announced_format(const std::vector<std::uint8_t>& bytes);

/// Reads the header and checks that the file is whole: PNG by its chunks and their checksums, JPEG
/// by its segments up to the end marker, binary PGM by its length. Codecs return half an image
/// without a word otherwise. Throws vp::InputError that names `path`: truncated, damaged,
/// zero-sized, or with more pixels than most_pixels.
ImageHeader check_image(const std::vector<std::uint8_t>& bytes, const std::string& path);

}  // namespace platform::input
