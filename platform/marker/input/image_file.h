#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <marker/scene/grey_image.h>

namespace platform::input {

/// Throws vp::InputError unless `path` is a regular file, or a link to one: a FIFO, a socket or a
/// device might be endless, and opening it might block or do something.
void require_regular_file(const std::string& path);

/// The whole file, or its first `limit` bytes. Throws vp::InputError if it is missing, no regular
/// file, unreadable or empty.
std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit = UINTMAX_MAX);

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
  std::size_t bytes = 0;         ///< of header and pixels, for pgm
  std::size_t maximum = 255;     ///< the sample of white, for pgm
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

/// So many bytes an image has that begins like this, a binary PGM. Throws vp::InputError.
std::size_t pgm_bytes(const std::vector<std::uint8_t>& beginning, const std::string& path);

/// A whole image file's content as 8-bit grey (see read_image). `path` names it.
GreyImage decode_image(const std::vector<std::uint8_t>& bytes, const std::string& path);

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
