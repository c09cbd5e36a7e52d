#include "driver.h"

#include <marker/dictionary.h>
#include <marker/rectification.h>

#include <cmath>

namespace calibration {
namespace {

constexpr std::uint8_t wall = 200, floor_level = 79, paper = 229, ink = 20;
constexpr std::int32_t cells = static_cast<std::int32_t>(marker::cells_per_side);

/// True if the cell of a marker with this code is black; row and column from the border on.
bool is_black(marker::Code code, std::int32_t row, std::int32_t column) {
  if (row <= 0 || column <= 0 || row >= cells - 1 || column >= cells - 1) return true;
  return code >> (15 - ((row - 1) * 4 + column - 1)) & 1;
}

}  // namespace

Scene::Scene(Random& random, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), pixels_(std::size_t{width} * height, wall) {
  const std::uint32_t horizon = height - random.below(height / 2);
  for (std::size_t i = std::size_t{horizon} * width; i < pixels_.size(); ++i) {
    pixels_[i] = floor_level;
  }
  const std::uint32_t count = 1 + random.below(6);
  for (std::uint32_t i = 0; i < count; ++i) draw_square(random);
  add_noise(random, random.between(1, 6));
}

void Scene::draw_square(Random& random) {
  const std::int32_t w = static_cast<std::int32_t>(width_), h = static_cast<std::int32_t>(height_);
  const double side = random.between(28, h / 2);
  // A direction without trigonometry; a third is upright.
  double dx = 1, dy = 0;
  if (random.below(3) != 0) {
    dx = random.between(-100, 100);
    dy = random.between(1, 100);
    const double length = std::sqrt(dx * dx + dy * dy);
    dx /= length;
    dy /= length;
  }
  const double cx = random.between(h / 4, w - h / 4), cy = random.between(h / 4, h - h / 4);
  const bool is_marker = random.below(2) != 0;
  const marker::Code code =
      is_marker ? marker::dictionary[random.below(marker::dictionary_size)] : marker::Code{0xFFFF};
  for (std::int32_t y = 0; y < h; ++y) {
    for (std::int32_t x = 0; x < w; ++x) {
      const double u = ((x - cx) * dx + (y - cy) * dy) / side + 0.5;
      const double v = ((y - cy) * dx - (x - cx) * dy) / side + 0.5;
      if (u < -0.4 || u >= 1.4 || v < -0.4 || v >= 1.4) continue;
      std::uint8_t& pixel = pixels_[static_cast<std::size_t>(y * w + x)];
      if (u < 0 || u >= 1 || v < 0 || v >= 1) {
        pixel = paper;
      } else {
        const auto row = static_cast<std::int32_t>(v * cells);
        const auto column = static_cast<std::int32_t>(u * cells);
        pixel = is_black(code, row, column) ? ink : paper;
      }
    }
  }
  const auto corner = [&](double u, double v) {
    return marker::Point{cx + ((u - 0.5) * dx - (v - 0.5) * dy) * side,
                         cy + ((u - 0.5) * dy + (v - 0.5) * dx) * side};
  };
  squares_.push_back({corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)});
}

void Scene::add_noise(Random& random, std::int32_t amplitude) {
  for (std::uint8_t& pixel : pixels_) {
    // The sum of three is bell shaped enough.
    std::int32_t noise = 0;
    for (int i = 0; i < 3; ++i) noise += random.between(-amplitude, amplitude);
    pixel = static_cast<std::uint8_t>(pixel + noise / 2);
  }
}

}  // namespace calibration
