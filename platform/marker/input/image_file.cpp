#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include <marker/input/image_file.h>
#include <marker/input/image_kind.h>
#include <marker/input/media.h>
#include <marker/scene/grey_image.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::input {

namespace {

namespace fs = std::filesystem;

std::string kind_name(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a FIFO";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

/// A camera's pictures come through a program that knows how to set it up.
std::string advice(const fs::path& path, fs::file_type type) {
  const bool is_camera =
      type == fs::file_type::character && path.filename().string().rfind("video", 0) == 0;
  return is_camera ? "; of a camera send pictures: ffmpeg -f v4l2 -i " + path.string() +
                         " -frames:v 100 -f yuv4mpegpipe - | markervp run -"
                   : "";
}

}  // namespace

void require_regular_file(const std::string& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::not_found)
    error = make_error_code(std::errc::no_such_file_or_directory);
  if (error) throw vp::InputError("'" + path + "' cannot be read: " + error.message());
  if (type != fs::file_type::regular) {
    throw vp::InputError("'" + path + "' cannot be read: it is " + kind_name(type) +
                         ", and must be a file" + advice(path, type));
  }
}

std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit) {
  require_regular_file(path);
  vp::InputFile file(path, "image");
  std::vector<std::uint8_t> bytes(
      static_cast<std::size_t>(std::min<std::uintmax_t>(file.size(), limit)));
  const auto deadline = vp::InputFile::HostClock::now() + vp::InputFile::patience;
  for (std::size_t at = 0; at < bytes.size();) {
    char* const to = reinterpret_cast<char*>(bytes.data()) + at;
    const std::size_t read = file.read(to, bytes.size() - at, deadline);
    if (read == 0) throw vp::InputError("'" + path + "' cannot be read: it ends early");
    at += read;
  }
  if (bytes.empty()) throw vp::InputError("'" + path + "' is empty");
  return bytes;
}

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 8> png_signature{0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};

[[noreturn]] void refuse_image(const std::string& path, const std::string& problem) {
  throw vp::InputError("image '" + path + "' " + problem);
}

[[noreturn]] void refuse_truncated(const std::string& path) {
  refuse_image(path, "is truncated: its end is missing");
}

void check_sides(const ImageHeader& header, const std::string& path) {
  if (header.width < 1 || header.height < 1) refuse_image(path, "has no pixels: its size is zero");
  const auto width = static_cast<std::uint64_t>(header.width);
  const auto height = static_cast<std::uint64_t>(header.height);
  if (width * height > most_pixels) {
    refuse_image(path, "has " + std::to_string(width) + "x" + std::to_string(height) + " px, " +
                           too_many_pixels);
  }
}

std::uint32_t big_endian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

// ---- PNG: chunks of length, type, data and checksum (W3C PNG, section 5.3)
// -----------------------------------------

constexpr std::size_t chunk_overhead = 12;
constexpr std::size_t ihdr_size = 13;

void read_ihdr(const Bytes& bytes, std::size_t data, ImageHeader& header) {
  header.width = static_cast<int>(std::min(big_endian(bytes, data, 4), 0x7FFFFFFFu));
  header.height = static_cast<int>(std::min(big_endian(bytes, data + 4, 4), 0x7FFFFFFFu));
  const bool eight_bits = bytes[data + 8] == 8;
  const bool grey = bytes[data + 9] == 0;
  const bool interlaced = bytes[data + 12] != 0;
  header.plain_grey = eight_bits && grey && !interlaced;
}

ImageHeader check_png(const Bytes& bytes, const std::string& path) {
  ImageHeader header;
  header.format = ImageHeader::Format::png;
  std::size_t at = png_signature.size();
  if (bytes.size() < at) refuse_truncated(path);
  for (;;) {
    if (bytes.size() - at < chunk_overhead) refuse_truncated(path);
    const std::size_t length = big_endian(bytes, at, 4);
    if (bytes.size() - at - chunk_overhead < length) refuse_truncated(path);
    const std::string type(bytes.begin() + static_cast<std::ptrdiff_t>(at + 4),
                           bytes.begin() + static_cast<std::ptrdiff_t>(at + 8));
    const uLong sum = ::crc32(0, &bytes[at + 4], static_cast<uInt>(length + 4));
    if (sum != big_endian(bytes, at + 8 + length, 4)) {
      refuse_image(path, "is damaged: the checksum of its part '" + type + "' is wrong");
    }
    if (at == png_signature.size()) {
      if (type != "IHDR" || length != ihdr_size)
        refuse_image(path, "is damaged: it has no PNG header");
      read_ihdr(bytes, at + 8, header);
    }
    if (type == "acTL") {
      refuse_image(path, "is an animated PNG: save its pictures one by one, or as a video (AVI)");
    }
    header.may_be_turned = header.may_be_turned || type == "eXIf";
    if (type == "IEND") return header;
    at += length + chunk_overhead;
  }
}

// ---- JPEG: segments between markers (ITU-T T.81, annex B)
// -----------------------------------------------------------

constexpr std::uint8_t jpeg_start = 0xD8;
constexpr std::uint8_t jpeg_end = 0xD9;
constexpr std::uint8_t jpeg_scan = 0xDA;
constexpr std::uint8_t jpeg_exif = 0xE1;

/// Encoders make a dozen. Each takes a decoder through the whole image, and may be 100 bytes long.
constexpr int most_scans = 100;

/// Markers that stand alone: RST0…7 and TEM.
bool is_bare(std::uint8_t marker) {
  return (marker >= 0xD0 && marker <= 0xD7) || marker == 0x01;
}

/// SOF0…15 without DHT, JPG and DAC.
bool is_frame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Position of the next marker's code at or after `at`, past entropy-coded data; nothing at the
/// end.
std::optional<std::size_t> next_marker(const Bytes& bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    const std::uint8_t code = bytes[at + 1];
    if (bytes[at] == 0xFF && code != 0x00 && code != 0xFF) return at + 1;
  }
  return std::nullopt;
}

ImageHeader check_jpeg(const Bytes& bytes, const std::string& path) {
  ImageHeader header;
  header.format = ImageHeader::Format::jpeg;
  int scans = 0;
  std::size_t at = 2;
  while (const std::optional<std::size_t> marker = next_marker(bytes, at)) {
    const std::uint8_t code = bytes[*marker];
    at = *marker + 1;
    if (code == jpeg_end) {
      if (scans == 0) refuse_image(path, "is damaged: it ends before its pixels");
      return header;
    }
    if (is_bare(code)) continue;
    if (bytes.size() - at < 2) break;
    const std::size_t length = big_endian(bytes, at, 2);
    if (length < 2 || bytes.size() - at < length) break;
    if (is_frame(code) && length >= 7) {
      header.height = static_cast<int>(big_endian(bytes, at + 3, 2));
      header.width = static_cast<int>(big_endian(bytes, at + 5, 2));
    }
    header.may_be_turned = header.may_be_turned || code == jpeg_exif;
    if (code == jpeg_scan && ++scans > most_scans) {
      refuse_image(path, "is damaged: its pixels come in more than " + std::to_string(most_scans) +
                             " passes");
    }
    at += length;
  }
  refuse_truncated(path);
}

// ---- Binary PGM: "P5 width height maximum", one white space, pixels (netpbm, pgm(5))
// --------------------------------

/// The next number of the header; comments run from # to the end of the line.
std::optional<std::size_t> header_number(const Bytes& bytes, std::size_t& at) {
  while (at < bytes.size() && (std::isspace(bytes[at]) != 0 || bytes[at] == '#')) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else {
      ++at;
    }
  }
  std::size_t value = 0;
  const std::size_t first = at;
  for (; at < bytes.size() && std::isdigit(bytes[at]) != 0 && at - first < 9; ++at) {
    value = value * 10 + static_cast<std::size_t>(bytes[at] - '0');
  }
  if (at == first) return std::nullopt;
  return value;
}

constexpr std::size_t most_of_8_bits = 255, most_of_16_bits = 65535;

/// What it says; its pixels may be cut.
ImageHeader pgm_header(const Bytes& bytes, const std::string& path) {
  std::size_t at = 2;
  const auto width = header_number(bytes, at);
  const auto height = header_number(bytes, at);
  const auto maximum = header_number(bytes, at);
  if (!width || !height || !maximum || at >= bytes.size()) {
    refuse_image(path, "is truncated or damaged: its PGM header is incomplete");
  }
  ImageHeader header;
  header.format = ImageHeader::Format::pgm;
  header.width = static_cast<int>(*width);
  header.height = static_cast<int>(*height);
  header.pixel_offset = at + 1;
  if (*maximum == 0 || *maximum > most_of_16_bits)
    refuse_image(path, "says that its brightest sample is " + std::to_string(*maximum) +
                           ": it must be 1 to 65535");
  header.maximum = *maximum;
  header.plain_grey = *maximum == most_of_8_bits;
  header.bytes = header.pixel_offset + *width * *height * (*maximum > most_of_8_bits ? 2 : 1);
  return header;
}

/// The codec takes other samples for grey levels as they are: 1023 of 10 bits, the white, for 3.
void check_text_or_colour(const Bytes& bytes, const std::string& path) {
  const bool has_maximum = bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '6';
  if (bytes[0] != 'P' || !has_maximum) return;
  const std::size_t maximum = pgm_header(bytes, path).maximum;
  if (maximum == most_of_8_bits || maximum == most_of_16_bits) return;
  refuse_image(path, "says that its brightest sample is " + std::to_string(maximum) +
                         ": save it with 255 or 65535, or as binary PGM (P5), which may have any");
}

ImageHeader check_pgm(const Bytes& bytes, const std::string& path) {
  const ImageHeader header = pgm_header(bytes, path);
  if (bytes.size() < header.bytes) refuse_truncated(path);
  return header;
}

// ---- Formats whose headers OpenCV reads: BMP, TIFF and BigTIFF, JPEG 2000, WebP
// ------------------------------------------------------------------------------------

bool is_other(const Bytes& bytes) {
  using namespace std::string_view_literals;
  static constexpr std::array signatures{"BM"sv,
                                         "II*\0"sv,
                                         "MM\0*"sv,
                                         "II+\0"sv,
                                         "MM\0+"sv,
                                         "\0\0\0\x0CjP  \r\n\x87\n"sv,
                                         "\xFF\x4F\xFF\x51"sv};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.substr(0, 4) == "RIFF")
    return text.size() >= format_bytes && text.substr(8, 4) == "WEBP";
  return std::any_of(signatures.begin(), signatures.end(), [text](std::string_view signature) {
    return text.substr(0, signature.size()) == signature;
  });
}

}  // namespace

ImageHeader::Format announced_format(const Bytes& bytes) {
  using Format = ImageHeader::Format;
  const std::size_t known = std::min(bytes.size(), png_signature.size());
  if (known >= 4 &&
      std::equal(png_signature.begin(), png_signature.begin() + known, bytes.begin())) {
    return Format::png;
  }
  if (known >= 2 && bytes[0] == 0xFF && bytes[1] == jpeg_start) return Format::jpeg;
  if (known >= 3 && bytes[0] == 'P' && std::isspace(bytes[2]) != 0) {
    if (bytes[1] == '5') return Format::pgm;
    if (bytes[1] >= '1' && bytes[1] <= '6') return Format::other;
  }
  return is_other(bytes) ? Format::other : Format::none;
}

ImageHeader check_image(const Bytes& bytes, const std::string& path) {
  ImageHeader header;
  header.format = announced_format(bytes);
  switch (header.format) {
    case ImageHeader::Format::png:
      header = check_png(bytes, path);
      break;
    case ImageHeader::Format::jpeg:
      header = check_jpeg(bytes, path);
      break;
    case ImageHeader::Format::pgm:
      header = check_pgm(bytes, path);
      break;
    case ImageHeader::Format::none:
      return header;
    case ImageHeader::Format::other:
      if (const std::string kind = unread_kind(bytes); !kind.empty()) refuse_image(path, kind);
      check_text_or_colour(bytes, path);
      return header;
  }
  check_sides(header, path);
  return header;
}

namespace {

/// Decompresses a PNG of 8-bit grey without interlacing: the values as stored, no gamma. Nothing if
/// its data is damaged.
std::optional<GreyImage> read_plain_png(const std::vector<std::uint8_t>& bytes, int width,
                                        int height);

struct Cursor {
  const std::uint8_t* data;
  std::size_t left;
};

void take(png_structp png, png_bytep target, std::size_t size) {
  auto* cursor = static_cast<Cursor*>(png_get_io_ptr(png));
  if (size > cursor->left) png_error(png, "truncated");
  std::memcpy(target, cursor->data, size);
  cursor->data += size;
  cursor->left -= size;
}

[[noreturn]] void fail(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

/// libpng leaves by longjmp when the data is damaged, so nothing here has a destructor.
bool decode(Cursor cursor, std::uint8_t* pixels, std::size_t width, std::size_t height) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &cursor, take);
  png_read_info(png, info);
  for (std::size_t y = 0; y < height; ++y) png_read_row(png, pixels + y * width, nullptr);
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

std::optional<GreyImage> read_plain_png(const std::vector<std::uint8_t>& bytes, int width,
                                        int height) {
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  GreyImage image{width, height, std::vector<std::uint8_t>(columns * rows)};
  if (!decode({bytes.data(), bytes.size()}, image.pixels.data(), columns, rows))
    return std::nullopt;
  return image;
}

}  // namespace

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

/// Samples as shares of the brightest one. A sample above it: damaged.
Decoded<GreyImage> scaled_pgm(const std::vector<std::uint8_t>& bytes, const ImageHeader& header) {
  GreyImage image{header.width, header.height, {}};
  const std::size_t sample_bytes = header.maximum > most_of_8_bits ? 2 : 1;
  for (std::size_t at = header.pixel_offset; at < header.bytes; at += sample_bytes) {
    const std::size_t sample = big_endian(bytes, at, sample_bytes);
    if (sample > header.maximum) return Unreadable::damaged;
    image.pixels.push_back(
        static_cast<std::uint8_t>((sample * most_of_8_bits + header.maximum / 2) / header.maximum));
  }
  return image;
}

Decoded<GreyImage> decode(const std::vector<std::uint8_t>& bytes, const ImageHeader& header) {
  const bool is_pgm = header.format == ImageHeader::Format::pgm;
  if (is_pgm && header.maximum != most_of_8_bits && header.maximum != most_of_16_bits)
    return scaled_pgm(bytes, header);
  if (!header.plain_grey || header.may_be_turned)
    return media().decode_image(bytes,
                                is_floating_tiff(bytes) ? Samples::floating : Samples::whole);
  if (is_pgm) return plain_pgm(bytes, header);
  std::optional<GreyImage> image = read_plain_png(bytes, header.width, header.height);
  if (!image) return Unreadable::damaged;
  return *std::move(image);
}

std::string why(Unreadable fault) {
  switch (fault) {
    case Unreadable::too_large:
      return "has " + std::string(too_many_pixels);
    case Unreadable::no_levels:
      return "has floating-point samples that are no grey levels: they must be 0 to 1, or 0 to 255";
    default:
      return "is damaged or truncated: it cannot be decoded";
  }
}

GreyImage decoded(const std::vector<std::uint8_t>& bytes, const ImageHeader& header,
                  const std::string& path) {
  Decoded<GreyImage> result = decode(bytes, header);
  if (const Unreadable* fault = std::get_if<Unreadable>(&result)) {
    throw vp::InputError("image '" + path + "' " + why(*fault));
  }
  return std::get<GreyImage>(std::move(result));
}

}  // namespace

std::size_t pgm_bytes(const std::vector<std::uint8_t>& beginning, const std::string& path) {
  const ImageHeader header = pgm_header(beginning, path);
  check_sides(header, path);
  return header.bytes;
}

GreyImage decode_image(const std::vector<std::uint8_t>& bytes, const std::string& path) {
  return decoded(bytes, check_image(bytes, path), path);
}

std::optional<GreyImage> read_image(const std::string& path) {
  const std::optional<std::vector<std::uint8_t>> bytes = image_bytes(path);
  if (!bytes) return std::nullopt;
  return decode_image(*bytes, path);
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
