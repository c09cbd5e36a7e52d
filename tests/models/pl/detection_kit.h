#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "pipeline.h"

/// What detection tests share: small pictures in, corners and boxes out.
namespace detection_kit {

using harness::Image;
using harness::Word;

constexpr int width = 64, height = 64;

struct Found {
  unsigned x, y, strength, direction;
};
inline bool operator==(const Found& a, const Found& b) {
  return a.x == b.x && a.y == b.y && a.strength == b.strength && a.direction == b.direction;
}
inline std::ostream& operator<<(std::ostream& out, const Found& f) {
  return out << f.x << ',' << f.y << " strength " << f.strength << " direction " << f.direction;
}

struct Box {
  unsigned sx, sy, ex, ey;
};
inline bool operator==(const Box& a, const Box& b) {
  return a.sx == b.sx && a.sy == b.sy && a.ex == b.ex && a.ey == b.ey;
}
inline std::ostream& operator<<(std::ostream& out, const Box& b) {
  return out << b.sx << ',' << b.sy << " to " << b.ex << ',' << b.ey;
}

inline std::vector<Word> run(const Image& image, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = harness::frame_size(width, height);
  settings.insert(settings.end(), more.begin(), more.end());
  harness::Pipeline pipeline({}, settings);
  pipeline.load(image);
  return pipeline.run_frame();
}

inline std::vector<Found> corners(const Image& image) {
  std::vector<Found> found;
  for (const Word& w : run(image)) {
    if (w.kind != 'C') continue;
    found.push_back(
        {w.first & 0x3FF, w.first >> 10 & 0x1FF, w.first >> 21 & 0x3FF, w.first >> 19 & 3});
  }
  return found;
}

inline std::vector<Box> blobs(const Image& image, const std::vector<std::string>& settings = {}) {
  std::vector<Box> found;
  for (const Word& w : run(image, settings)) {
    if (w.kind != 'B') continue;
    found.push_back(
        {w.first & 0x3FF, w.first >> 10 & 0x1FF, w.second & 0x3FF, w.second >> 10 & 0x1FF});
  }
  return found;
}

inline Image plain(std::uint8_t level) {
  return Image(width * height, level);
}

inline void dot(Image& image, int x, int y, std::uint8_t level) {
  harness::draw(image, width, x, y, x, y, level);
}

/// Dark pixels are darker than the threshold of the first frame, 127.
inline void bar(Image& image, int sx, int sy, int ex, int ey) {
  harness::draw(image, width, sx, sy, ex, ey, 10);
}

inline const std::vector<std::string> every_blob{"pl.blob_detection.minimum_side=1 px"};

}  // namespace detection_kit
