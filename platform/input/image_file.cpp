#include <input/image_file.h>

#include <input/file_bytes.h>
#include <input/image_check.h>
#include <input/media.h>
#include <input/plain_png.h>
#include <vp/error.h>

namespace platform::input {

namespace {

/// Direct reading allocates what the header says; larger images go to OpenCV, which refuses absurd
/// ones.
constexpr std::uint64_t largest_direct_px = 1u << 26;

GreyImage decoded(std::optional<GreyImage> image, const std::string& path) {
  if (!image) {
    throw vp::InputError("image '" + path + "' is damaged or truncated: it cannot be decoded");
  }
  if (image->width < 1 || image->height < 1) {
    throw vp::InputError("image '" + path + "' has no pixels: its size is zero");
  }
  return *std::move(image);
}

GreyImage plain_pgm(const std::vector<std::uint8_t>& bytes, const ImageHeader& header) {
  GreyImage image{header.width, header.height, {}};
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(header.pixel_offset);
  image.pixels.assign(first, first + static_cast<std::ptrdiff_t>(header.width) * header.height);
  return image;
}

bool is_direct(const ImageHeader& header) {
  const auto width = static_cast<std::uint64_t>(header.width);
  return header.plain_grey && !header.may_be_turned &&
         width * static_cast<std::uint64_t>(header.height) <= largest_direct_px;
}

/// A file of a format that is not checked here may be a long video: only its beginning is read.
bool is_checked_format(const std::string& path) {
  return announced_format(read_bytes(path, 8)) != ImageHeader::Format::other;
}

std::optional<GreyImage> read_other(const std::string& path) {
  if (!media().is_image(path)) return std::nullopt;
  return decoded(media().read_image(path), path);
}

}  // namespace

std::optional<GreyImage> read_image(const std::string& path) {
  if (!is_checked_format(path)) return read_other(path);
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  const ImageHeader header = check_image(bytes, path);
  if (!is_direct(header)) return decoded(media().read_image(path), path);
  if (header.format == ImageHeader::Format::pgm) return plain_pgm(bytes, header);
  return decoded(read_plain_png(bytes, header.width, header.height), path);
}

std::optional<ImageSize> inspect_image(const std::string& path) {
  if (is_checked_format(path)) {
    const ImageHeader header = check_image(read_bytes(path), path);
    if (!header.may_be_turned) return ImageSize{header.width, header.height};
  }
  const std::optional<GreyImage> image = read_image(path);
  if (!image) return std::nullopt;
  return ImageSize{image->width, image->height};
}

}  // namespace platform::input
