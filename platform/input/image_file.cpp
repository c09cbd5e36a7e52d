#include <input/image_file.h>

#include <filesystem>

#include <input/file_bytes.h>
#include <input/image_check.h>
#include <input/media.h>
#include <input/plain_png.h>
#include <vp/error.h>

namespace platform::input {

namespace {

/// Enough for most_pixels in any of the formats: 16 bits of red, green, blue and alpha.
constexpr std::uintmax_t most_bytes = most_pixels * 8;

/// A file's content, if it begins like an image; what does not may be a long video.
std::optional<std::vector<std::uint8_t>> image_bytes(const std::string& path) {
  const std::vector<std::uint8_t> beginning = read_bytes(path, format_bytes);
  if (announced_format(beginning) == ImageHeader::Format::none) return std::nullopt;
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) > most_bytes) {
    throw vp::InputError("image '" + path + "' is larger than 512 MiB: scale it down first");
  }
  return read_bytes(path, most_bytes);
}

GreyImage plain_pgm(const std::vector<std::uint8_t>& bytes, const ImageHeader& header) {
  GreyImage image{header.width, header.height, {}};
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(header.pixel_offset);
  image.pixels.assign(first, first + static_cast<std::ptrdiff_t>(header.width) * header.height);
  return image;
}

Decoded<GreyImage> decode(const std::vector<std::uint8_t>& bytes, const ImageHeader& header) {
  if (!header.plain_grey || header.may_be_turned) return media().decode_image(bytes);
  if (header.format == ImageHeader::Format::pgm) return plain_pgm(bytes, header);
  std::optional<GreyImage> image = read_plain_png(bytes, header.width, header.height);
  if (!image) return Unreadable::damaged;
  return *std::move(image);
}

GreyImage decoded(const std::vector<std::uint8_t>& bytes, const ImageHeader& header,
                  const std::string& path) {
  Decoded<GreyImage> result = decode(bytes, header);
  if (const Unreadable* fault = std::get_if<Unreadable>(&result)) {
    throw vp::InputError("image '" + path + "' " +
                         (*fault == Unreadable::too_large
                              ? "has " + std::string(too_many_pixels)
                              : "is damaged or truncated: it cannot be decoded"));
  }
  return std::get<GreyImage>(std::move(result));
}

}  // namespace

std::optional<GreyImage> read_image(const std::string& path) {
  const std::optional<std::vector<std::uint8_t>> bytes = image_bytes(path);
  if (!bytes) return std::nullopt;
  return decoded(*bytes, check_image(*bytes, path), path);
}

std::optional<ImageSize> inspect_image(const std::string& path) {
  const std::optional<std::vector<std::uint8_t>> bytes = image_bytes(path);
  if (!bytes) return std::nullopt;
  const ImageHeader header = check_image(*bytes, path);
  const bool known = header.format != ImageHeader::Format::other && !header.may_be_turned;
  if (known) return ImageSize{header.width, header.height};
  const GreyImage image = decoded(*bytes, header, path);
  return ImageSize{image.width, image.height};
}

}  // namespace platform::input
