#include "frames.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace harness {

namespace {

constexpr std::uint8_t dark = 20, bright = 200;

Image blank(int width, int height) {
  return Image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), bright);
}

}  // namespace

void draw(Image& image, int width, int sx, int sy, int ex, int ey, std::uint8_t level) {
  const int height = static_cast<int>(image.size()) / width;
  if (sx < 0 || sy < 0 || ex >= width || ey >= height) throw std::out_of_range("draw()");
  for (int y = sy; y <= ey; ++y) {
    for (int x = sx; x <= ex; ++x) image[static_cast<std::size_t>(y * width + x)] = level;
  }
}

Image noise(int width, int height, std::uint64_t seed) {
  Random random(seed);
  Image image = blank(width, height);
  for (std::uint8_t& pixel : image) pixel = static_cast<std::uint8_t>(random.below(256));
  return image;
}

Image rectangles(int width, int height, int count, std::uint64_t seed) {
  Random random(seed);
  const auto below = [&random](int limit) {
    return static_cast<int>(random.below(static_cast<std::uint32_t>(limit)));
  };
  Image image = blank(width, height);
  for (int i = 0; i < count; ++i) {
    const int x = below(width), y = below(height);
    const int ex = std::min(width - 1, x + below(width / 4));
    const int ey = std::min(height - 1, y + below(height / 4));
    draw(image, width, x, y, ex, ey, static_cast<std::uint8_t>(below(256)));
  }
  return image;
}

Image stripes(int width, int height) {
  Image image = blank(width, height);
  for (int x = 0; x < width; x += 4) {
    draw(image, width, x, x / 4 % 8, x, height / 2 + x / 4 % 5, dark);
    if (x % 40 == 0 && x + 26 < width) {
      draw(image, width, x, height * 3 / 4, x + 26, height - 1 - x % 3, dark);
    }
  }
  return image;
}

Image blobs_at_the_end(int width, int height, int count, int large) {
  Image image = blank(width, height);
  int x = 0;
  for (int i = 0; i < count; ++i) {
    const bool is_large = i >= count - large;
    const int columns = is_large ? 25 : 2, lines = is_large ? 25 : 28;
    draw(image, width, x, height - lines, x + columns - 1, height - 1, dark);
    x += is_large ? 30 : 5;
  }
  return image;
}

Image one_rectangle(int width, int height, int sx, int sy, int ex, int ey) {
  Image image = blank(width, height);
  draw(image, width, sx, sy, ex, ey, dark);
  return image;
}

Image read_pgm(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  std::size_t width = 0, height = 0, levels = 0;
  in >> magic >> width >> height >> levels;
  in.get();
  Image pixels(width * height);
  if (!in || magic != "P5" || levels != 255 ||
      !in.read(reinterpret_cast<char*>(pixels.data()),
               static_cast<std::streamsize>(pixels.size()))) {
    throw std::runtime_error(path + ": not an 8-bit binary PGM");
  }
  return pixels;
}

void write_pgm(const std::string& path, const Image& image, int width, int height) {
  std::ofstream out(path, std::ios::binary);
  out << "P5\n" << width << ' ' << height << "\n255\n";
  out.write(reinterpret_cast<const char*>(image.data()),
            static_cast<std::streamsize>(image.size()));
  if (!out) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace harness
