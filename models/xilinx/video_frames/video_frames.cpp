#include <xilinx/video_frames/video_frames.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace xilinx {

namespace {

constexpr unsigned byte_bits = 8;
constexpr unsigned most_pixels_across = 8192;

std::string formats() {
  return ": it must be a binary PPM or PGM file (P6, P5) of 8 bits a component";
}

/// The words of the header of a PPM file, with comments left out.
class Header {
 public:
  Header(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {}
  unsigned number() {
    skip();
    std::size_t digits = 0;
    unsigned value = 0;
    while (at_ < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[at_])) != 0 &&
           digits < 6) {
      value = 10 * value + static_cast<unsigned>(bytes_[at_++] - '0');
      ++digits;
    }
    if (digits == 0) throw vp::InputError(path_ + ": its header is damaged" + formats());
    return value;
  }
  std::size_t end() const { return at_ + 1; }  // one space

 private:
  void skip() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(bytes_[at_])) == 0) {
        return;
      } else {
        ++at_;
      }
    }
  }
  const std::string& bytes_;
  const std::string& path_;
  std::size_t at_ = 2;
};

unsigned channel_of(char component) {
  return component == 'r' ? 0 : component == 'g' ? 1 : 2;
}

}  // namespace

VideoPicture read_picture(const std::string& path) {
  constexpr std::uint64_t most_bytes = 256u << 20;
  return parse_picture(vp::read_text(path, "picture", most_bytes), path);
}

VideoPicture parse_picture(const std::string& bytes, const std::string& path) {
  const std::string kind = bytes.substr(0, 2);
  if (kind != "P6" && kind != "P5") throw vp::InputError(path + ": no picture here" + formats());
  VideoPicture picture;
  picture.channels = kind == "P6" ? 3 : 1;
  Header header(bytes, path);
  picture.width = header.number();
  picture.height = header.number();
  const unsigned most = header.number();
  if (most != 255) throw vp::InputError(path + ": its greatest value is not 255" + formats());
  const bool fits = picture.width >= 1 && picture.height >= 1 &&
                    picture.width <= most_pixels_across && picture.height <= most_pixels_across;
  if (!fits) throw vp::InputError(path + ": its sides must have 1 to 8192 pixels");
  const std::size_t size = std::size_t{picture.width} * picture.height * picture.channels;
  if (bytes.size() < header.end() + size)
    throw vp::InputError(path + ": it ends before its last pixel" + formats());
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(header.end());
  picture.bytes.assign(begin, begin + static_cast<std::ptrdiff_t>(size));
  return picture;
}

std::string format_picture(const VideoPicture& picture) {
  std::string text = (picture.channels == 3 ? "P6\n" : "P5\n") + std::to_string(picture.width) +
                     " " + std::to_string(picture.height) + "\n255\n";
  text.append(picture.bytes.begin(), picture.bytes.end());
  return text;
}

std::uint64_t pixel_word(const VideoPicture& picture, std::size_t pixel,
                         const PixelLayout& layout) {
  const unsigned shift = layout.component_bits - byte_bits;
  const unsigned char* at = &picture.bytes[pixel * picture.channels];
  const auto channel = [&](unsigned n) {
    return static_cast<std::uint64_t>(at[picture.channels == 3 ? n : 0]) << shift;
  };
  if (layout.components == 1) return channel(1);
  std::uint64_t word = 0;
  for (unsigned n = 0; n < layout.components; ++n)
    word |= channel(channel_of(layout.order[n])) << n * layout.component_bits;
  return word;
}

void append_pixel(VideoPicture& picture, std::uint64_t word, const PixelLayout& layout) {
  const unsigned shift = layout.component_bits - byte_bits;
  const auto component = [&](unsigned n) {
    return static_cast<unsigned char>(word >> (n * layout.component_bits + shift));
  };
  if (layout.components == 1) {
    picture.bytes.push_back(component(0));
    return;
  }
  unsigned char rgb[3] = {};
  for (unsigned n = 0; n < layout.components; ++n) rgb[channel_of(layout.order[n])] = component(n);
  picture.bytes.insert(picture.bytes.end(), rgb, rgb + 3);
}

void check_layout(const PixelLayout& layout, const std::string& of) {
  const bool colours = layout.format == VideoFormat::rgb && layout.components == 3;
  const bool grey = layout.format == VideoFormat::mono && layout.components == 1;
  if (!colours && !grey)
    throw vp::InputError(of +
                         ": frames as files are of RGB or grey video, and this is another "
                         "format: put a converter before, or leave the files out");
  if (layout.component_bits < byte_bits)
    throw vp::InputError(of + ": frames as files have 8 bits a component or more, and this video " +
                         std::to_string(layout.component_bits));
  std::string sorted = layout.order;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != "bgr")
    throw vp::InputError(of +
                         ": the order of components is that of the letters r, g and b, as "
                         "'gbr', and not '" +
                         vp::excerpt(layout.order) + "'");
}

FrameWriter::FrameWriter(std::string folder, PixelLayout layout)
    : folder_(std::move(folder)), layout_(std::move(layout)) {
  if (!is_on()) return;
  check_layout(layout_, folder_);
}

void FrameWriter::begin() {
  picture_ = {};
  picture_.channels = layout_.components == 3 ? 3 : 1;
  line_from_ = 0;
  even_ = true;
}

void FrameWriter::end_line() {
  const auto pixels =
      static_cast<unsigned>((picture_.bytes.size() - line_from_) / picture_.channels);
  if (picture_.height == 0) picture_.width = pixels;
  even_ = even_ && pixels == picture_.width;
  line_from_ = picture_.bytes.size();
  ++picture_.height;
}

void FrameWriter::end() {
  if (picture_.height == 0 || !even_) return;
  std::error_code failed;
  if (count_ == 0) std::filesystem::create_directories(folder_, failed);
  if (failed) throw vp::OutputError(folder_, failed.value());
  char name[32];
  std::snprintf(name, sizeof name, "/frame_%04u.%s", count_,
                picture_.channels == 3 ? "ppm" : "pgm");
  vp::write_file(folder_ + name, format_picture(picture_));
  ++count_;
}

}  // namespace xilinx
