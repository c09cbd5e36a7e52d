#pragma once

#include <marker/geometry.h>
#include <marker/grey_image.h>

#include <cstdint>
#include <vector>

#include "random.h"

namespace calibration {

/// A random picture of what the software sees: a bright wall, a dark floor, markers and squares at
/// any angle, noise.
class Scene {
 public:
  /// `width` a multiple of 32.
  Scene(Random& random, std::uint32_t width, std::uint32_t height);

  marker::GreyImage image() const { return {pixels_.data(), width_, height_}; }
  /// The corners of what was drawn, as pixel indices: top left, top right, bottom left, bottom
  /// right.
  const std::vector<marker::Quad>& squares() const { return squares_; }

 private:
  void draw_square(Random& random);
  void add_noise(Random& random, std::int32_t amplitude);

  std::uint32_t width_, height_;
  std::vector<std::uint8_t> pixels_;
  std::vector<marker::Quad> squares_;
};

}  // namespace calibration
