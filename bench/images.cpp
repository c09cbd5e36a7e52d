#include "images.h"

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace bench {

namespace {

constexpr int width = 640, height = 480;

/// Smooth noise: random levels on a grid of `cell` px, bilinear between.
std::vector<double> octave(int cell, std::uint64_t seed) {
  const int columns = width / cell + 2, rows = height / cell + 2;
  harness::Random random(seed);
  std::vector<double> grid(static_cast<std::size_t>(columns * rows));
  for (double& level : grid) level = random.below(256) / 255.0 - 0.5;
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto corner = static_cast<std::size_t>(y / cell * columns + x / cell);
      const double fx = double(x % cell) / cell, fy = double(y % cell) / cell;
      const double upper = grid[corner] * (1 - fx) + grid[corner + 1] * fx;
      const std::size_t below = corner + static_cast<std::size_t>(columns);
      const double lower = grid[below] * (1 - fx) + grid[below + 1] * fx;
      result.push_back(upper * (1 - fy) + lower * fy);
    }
  }
  return result;
}

harness::Image demo() {
  return platform::render(platform::make_scene("demo")).pixels;
}

/// The demo scene under texture whose contrast falls with its fineness, as in photographs.
harness::Image photograph() {
  constexpr int coarsest_px = 64;
  constexpr double coarsest_contrast = 90;  // grey levels, peak to peak
  constexpr double finer = 0.85;            // contrast of an octave by that of the coarser one
  harness::Image image = demo();
  std::vector<double> texture(image.size());
  double contrast = coarsest_contrast;
  for (int cell = coarsest_px; cell >= 1; cell /= 2, contrast *= finer) {
    const std::vector<double> part = octave(cell, static_cast<std::uint64_t>(cell));
    for (std::size_t i = 0; i < texture.size(); ++i) texture[i] += contrast * part[i];
  }
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = static_cast<std::uint8_t>(std::clamp(image[i] + texture[i], 0.0, 255.0) + 0.5);
  }
  return image;
}

}  // namespace

const std::vector<std::string>& image_names() {
  static const std::vector<std::string> names{"demo", "photograph", "noise"};
  return names;
}

harness::Image make_image(const std::string& name) {
  if (name == "demo") return demo();
  if (name == "photograph") return photograph();
  if (name == "noise") return harness::noise(width, height, 2);
  throw std::invalid_argument("no image '" + name + "'");
}

}  // namespace bench
