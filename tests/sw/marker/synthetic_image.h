#pragma once

#include <marker/dictionary.h>
#include <marker/geometry.h>
#include <marker/images.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace synthetic {

/// A binary image that tests draw into. 1 = dark, starts white.
class Image {
 public:
  Image(std::uint32_t width, std::uint32_t height);

  void set(std::uint32_t x, std::uint32_t y, bool dark);
  marker::BinaryImage view(bool in_dma_memory = false) const;
  std::vector<std::uint32_t>& words() { return words_; }

  /// Draws a marker whose own corners, clockwise from its top left, have the pixel indices
  /// `corners`: the outermost dark pixels. `invert_cell` (0 … 35) is drawn in the wrong colour.
  void draw_marker(marker::Code code, const marker::Quad& corners, int invert_cell = -1);

 private:
  std::uint32_t width_, height_;
  std::vector<std::uint32_t> words_;
};

/// The homography that takes four points to four others, by linear least squares.
Eigen::Matrix3d solve_homography(const marker::Quad& from, const marker::Quad& to);

}  // namespace synthetic
