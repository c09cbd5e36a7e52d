#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace xilinx {

/// What the components of a pixel are, by the numbers of C_S_AXIS_VIDEO_FORMAT (UG934).
enum class VideoFormat : std::uint8_t { yuv_422 = 0, yuv_444 = 1, rgb = 2, yuv_420 = 3, mono = 12 };

/// How pixels lie in a word of native video: the components one after the other.
struct PixelLayout {
  VideoFormat format = VideoFormat::rgb;
  unsigned components = 3;      ///< of a pixel
  unsigned component_bits = 8;  ///< of each
  /// What the components are, the lowest one first: "gbr" (UG934), or as a design's own IP wires
  /// them.
  std::string order = "gbr";

  unsigned bits() const { return components * component_bits; }
};

/// A picture as files have it: three bytes a pixel, or one of a grey picture, row by row.
struct VideoPicture {
  unsigned width = 0, height = 0;
  unsigned channels = 3;  ///< 3 or 1
  std::vector<unsigned char> bytes;
};

/// Reads a PPM or PGM file (binary, 8 bits). Throws vp::InputError, which names the file.
VideoPicture read_picture(const std::string& path);
/// The same for its bytes.
VideoPicture parse_picture(const std::string& bytes, const std::string& path);
/// A PPM or PGM file's bytes.
std::string format_picture(const VideoPicture& picture);

/// The word of a pixel. A grey picture gives grey pixels; one of colours into a format without
/// colours its green. Components of more than 8 bits have the picture's in their upper ones.
std::uint64_t pixel_word(const VideoPicture& picture, std::size_t pixel, const PixelLayout& layout);
/// Appends the pixel of a word.
void append_pixel(VideoPicture& picture, std::uint64_t word, const PixelLayout& layout);

/// Refuses a layout that files cannot have: throws vp::InputError. `of` is what asks for files.
void check_layout(const PixelLayout& layout, const std::string& of);

/// Writes frames into a folder as frame_0000.ppm and so on; a grey one as .pgm.
class FrameWriter {
 public:
  /// "": nothing is written. Throws vp::InputError for a layout that files cannot have.
  FrameWriter(std::string folder, PixelLayout layout);
  bool is_on() const { return !folder_.empty(); }
  const std::string& folder() const { return folder_; }

  void begin();
  void add(std::uint64_t word) { append_pixel(picture_, word, layout_); }
  /// Behind the last pixel of a line.
  void end_line();
  /// Writes what came since begin(); the first time it makes the folder. Throws vp::OutputError.
  void end();
  unsigned written() const { return count_; }

 private:
  const std::string folder_;
  const PixelLayout layout_;
  VideoPicture picture_;
  std::size_t line_from_ = 0;
  bool even_ = true;  ///< all lines were as long as the first
  unsigned count_ = 0;
};

}  // namespace xilinx
