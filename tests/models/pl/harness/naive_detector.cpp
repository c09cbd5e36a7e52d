#include "naive_detector.h"

#include <algorithm>

namespace harness {

namespace {

struct Offset {
  int x, y;
};
/// The circle of radius 3, from the top on, clockwise.
constexpr Offset circle[16] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                               {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                               {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};
/// North, south, east, west: five circle pixels each.
constexpr int regions[4][5] = {
    {14, 15, 0, 1, 2}, {6, 7, 8, 9, 10}, {2, 3, 4, 5, 6}, {10, 11, 12, 13, 14}};

class Detector {
 public:
  Detector(const Image& image, int width, int height, unsigned threshold)
      : image_(image), width_(width), height_(height), threshold_(static_cast<int>(threshold)) {}

  int at(int x, int y) const { return image_[static_cast<std::size_t>(y * width_ + x)]; }

  /// 0 if it is no corner.
  int strength(int x, int y) const {
    if (x < 3 || y < 3 || x >= width_ - 3 || y >= height_ - 3) return 0;
    int sum = 0, run = 0, longest = 0;
    for (int n = 0; n < 32; ++n) {
      const int excess = excess_of(x, y, n % 16);
      run = excess > 0 ? run + 1 : 0;
      longest = std::max(longest, run);
      if (n < 16) sum += std::max(excess, 0);
    }
    return longest >= 9 ? sum : 0;
  }

  bool is_maximum(int x, int y) const {
    const int here = strength(x, y);
    if (here == 0) return false;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const bool earlier = dy < 0 || (dy == 0 && dx < 0);
        const int other = strength(x + dx, y + dy);
        if (earlier ? other >= here : other > here) return false;
      }
    }
    return true;
  }

  std::uint32_t direction(int x, int y) const {
    std::uint32_t best = 0;
    int most = -1;
    for (std::uint32_t d = 0; d < 4; ++d) {
      int bright = 0;
      for (const int n : regions[d]) bright += excess_of(x, y, n) > 0;
      if (bright > most) {
        most = bright;
        best = d;
      }
    }
    return best;
  }

 private:
  int excess_of(int x, int y, int n) const {
    return at(x + circle[n].x, y + circle[n].y) - (at(x, y) + threshold_);
  }

  const Image& image_;
  int width_, height_, threshold_;
};

}  // namespace

std::vector<Word> naive_words(const Image& image, int width, int height, unsigned corner_threshold,
                              unsigned grey_threshold) {
  const Detector detector(image, width, height, corner_threshold);
  // Coordinates beyond 1024 x 512 take their bits from the strength.
  const int more_x = width > 1024 ? 1 : 0, more_y = height > 1024 ? 2 : height > 512 ? 1 : 0;
  const int y_at = 10 + more_x, direction_at = y_at + 9 + more_y, strength_at = direction_at + 2;
  std::vector<Word> words;
  for (int y = 4; y <= height - 5; ++y) {
    for (int x = 4; x <= width - 5; ++x) {
      if (!detector.is_maximum(x, y)) continue;
      const auto strength = static_cast<std::uint32_t>(detector.strength(x, y));
      const std::uint32_t packet = 1u << 31 | strength >> (2 + more_x + more_y) << strength_at |
                                   detector.direction(x, y) << direction_at |
                                   static_cast<std::uint32_t>(y) << y_at |
                                   static_cast<std::uint32_t>(x);
      words.push_back({'C', 7 + static_cast<std::uint64_t>((y + 4) * width + x + 4), packet, 0});
    }
  }
  for (std::size_t first = 0; first < image.size(); first += 32) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 32; ++i) {
      word |= std::uint32_t{image[first + i] <= grey_threshold} << i;
    }
    words.push_back({'T', 3 + first + 31, word, 0});
  }
  std::sort(words.begin(), words.end());
  return words;
}

}  // namespace harness
