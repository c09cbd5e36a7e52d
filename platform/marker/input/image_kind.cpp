#include <optional>
#include <string_view>

#include <marker/input/image_kind.h>

namespace platform::input {

namespace {

using Bytes = std::vector<std::uint8_t>;

/// The directories of a TIFF or BigTIFF (TIFF 6.0, section 2): tags with values, one a page.
class Tiff {
 public:
  explicit Tiff(const Bytes& bytes)
      : bytes_(bytes), is_little_(bytes[0] == 'I'), is_big_(number(2, 2) == 43) {}

  /// Where the first page's directory is; 0: nowhere.
  std::uint64_t first() const { return is_big_ ? number(8, 8) : number(4, 4); }
  /// Where the one behind it is.
  std::uint64_t next(std::uint64_t directory) const {
    return number(entry(directory, entries(directory)), offset_size());
  }
  /// The first value of a tag.
  std::optional<std::uint64_t> value(std::uint64_t directory, std::uint64_t tag) const {
    for (std::uint64_t i = 0; i < entries(directory); ++i) {
      const std::uint64_t at = entry(directory, i);
      if (number(at, 2) != tag) continue;
      const std::uint64_t size = number(at + 2, 2) == short_type ? 2 : 4;
      const std::uint64_t count = number(at + 4, offset_size());
      const std::uint64_t place = at + 4 + offset_size();
      const bool is_here = size * count <= offset_size();
      return number(is_here ? place : number(place, offset_size()), size);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint64_t short_type = 3;

  std::uint64_t offset_size() const { return is_big_ ? 8 : 4; }
  std::uint64_t entries(std::uint64_t directory) const {
    return number(directory, is_big_ ? 8 : 2) % (bytes_.size() + 1);
  }
  std::uint64_t entry(std::uint64_t directory, std::uint64_t index) const {
    return directory + (is_big_ ? 8 + 20 * index : 2 + 12 * index);
  }
  /// 0 beyond the end.
  std::uint64_t number(std::uint64_t at, std::uint64_t size) const {
    if (at >= bytes_.size() || bytes_.size() - at < size) return 0;
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i)
      value = value << 8 | bytes_[at + (is_little_ ? size - 1 - i : i)];
    return value;
  }

  const Bytes& bytes_;
  bool is_little_, is_big_;
};

constexpr std::uint64_t sample_format = 339;
constexpr std::uint64_t floating_samples = 3;

bool is_tiff(const Bytes& bytes) {
  return bytes.size() >= 8 && (bytes[0] == 'I' || bytes[0] == 'M') && bytes[1] == bytes[0];
}

std::string unread_tiff(const Bytes& bytes) {
  constexpr std::uint64_t subfile_type = 254, bits_per_sample = 258;
  constexpr std::uint64_t signed_samples = 2, reduced = 1;
  const Tiff tiff(bytes);
  const std::uint64_t page = tiff.first();
  const std::string advice = ": save it with 8 or 16 bits of grey or colour";
  const std::uint64_t format = tiff.value(page, sample_format).value_or(1);
  if (format == signed_samples) return "is a TIFF with signed samples" + advice;
  const std::uint64_t bits = tiff.value(page, bits_per_sample).value_or(1);
  const bool is_floating = format == floating_samples;
  const bool is_read =
      is_floating ? bits == 32 || bits == 64 : bits == 1 || bits == 8 || bits == 16;
  if (!is_read)
    return "is a TIFF with " + std::string(is_floating ? "floating-point " : "") + "samples of " +
           std::to_string(bits) + " bits" + advice;
  const std::uint64_t second = tiff.next(page);
  const bool is_preview =
      second != 0 && (tiff.value(second, subfile_type).value_or(0) & reduced) != 0;
  if (second != 0 && !is_preview)
    return "is a TIFF with several pages: save each as an image of its own";
  return "";
}

}  // namespace

std::string unread_kind(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (is_tiff(bytes)) return unread_tiff(bytes);
  // RIFF, size, "WEBP"; then the chunk VP8X with its size, and flags (WebP container).
  constexpr std::size_t flags_at = 20;
  constexpr std::uint8_t animation = 0x02;
  const bool is_animated = text.substr(0, 4) == "RIFF" && text.size() > flags_at &&
                           text.substr(8, 8) == "WEBPVP8X" && (bytes[flags_at] & animation) != 0;
  if (is_animated) return "is an animated WebP: save its pictures one by one, or as a video (AVI)";
  return "";
}

bool is_floating_tiff(const std::vector<std::uint8_t>& bytes) {
  if (!is_tiff(bytes)) return false;
  const Tiff tiff(bytes);
  return tiff.value(tiff.first(), sample_format).value_or(1) == floating_samples;
}

}  // namespace platform::input
