#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace harness {

/// Grey levels, row by row from the top left.
using Image = std::vector<std::uint8_t>;

/// The tests' own generator, so that a seed gives the same frame on every host.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// 0 to `limit` - 1.
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return static_cast<std::uint32_t>((state_ >> 33) % limit);
  }

 private:
  std::uint64_t state_;
};

/// Every pixel takes any grey level: as many corners as a frame can have.
Image noise(int width, int height, std::uint64_t seed);

/// Rectangles of any place, size and grey level, one over the other.
Image rectangles(int width, int height, int count, std::uint64_t seed);

/// Dark stripes, one pixel in four, of different lengths: more blobs side by side than there are
/// labels, and labels that come back while others still wait for one. Below them, wide stripes.
Image stripes(int width, int height);

/// `count` dark blobs side by side that reach the last line, so that all are active at the frame's
/// end, with labels from left to right. The `large` rightmost are large enough to be reported, the
/// others too narrow. At least 28 lines; 30 columns for a large, 5 for a narrow one.
Image blobs_at_the_end(int width, int height, int count, int large);

/// A bright picture with a dark rectangle from (sx, sy) to (ex, ey).
Image one_rectangle(int width, int height, int sx, int sy, int ex, int ey);

/// Fills a rectangle, both ends included. Throws std::out_of_range if it does not fit.
void draw(Image& image, int width, int sx, int sy, int ex, int ey, std::uint8_t level);

/// Reads an 8-bit binary PGM without comments. Throws std::runtime_error if it is not one.
Image read_pgm(const std::string& path);
/// Throws std::runtime_error if the file cannot be written.
void write_pgm(const std::string& path, const Image& image, int width, int height);

}  // namespace harness
