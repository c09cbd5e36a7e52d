#include "synthetic_image.h"

namespace synthetic {

Image::Image(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), words_(width * height / 32, 0) {}

void Image::set(std::uint32_t x, std::uint32_t y, bool dark) {
  const std::uint32_t index = y * width_ + x;
  const std::uint32_t bit = 1u << index % 32;
  words_[index / 32] = dark ? words_[index / 32] | bit : words_[index / 32] & ~bit;
}

marker::BinaryImage Image::view(bool in_dma_memory) const {
  return {words_.data(), width_, height_, in_dma_memory};
}

void Image::draw_marker(marker::Code code, const marker::Quad& corners, int invert_cell) {
  const Eigen::Matrix3d to_marker = solve_homography(corners, {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}});
  for (std::uint32_t y = 0; y < height_; ++y) {
    for (std::uint32_t x = 0; x < width_; ++x) {
      const Eigen::Vector3d p = to_marker * Eigen::Vector3d(x, y, 1);
      const double u = p.x() / p.z();
      const double v = p.y() / p.z();
      if (!(u >= 0 && u <= 6 && v >= 0 && v <= 6)) continue;
      const int column = u < 6 ? static_cast<int>(u) : 5;
      const int row = v < 6 ? static_cast<int>(v) : 5;
      const bool inside = column >= 1 && column <= 4 && row >= 1 && row <= 4;
      const bool dark = !inside || (code >> (15 - ((row - 1) * 4 + column - 1)) & 1);
      set(x, y, dark != (row * 6 + column == invert_cell));
    }
  }
}

Eigen::Matrix3d solve_homography(const marker::Quad& from, const marker::Quad& to) {
  Eigen::Matrix<double, 8, 8> a;
  Eigen::Matrix<double, 8, 1> b;
  for (unsigned i = 0; i < 4; ++i) {
    const auto [x, y] = from[i];
    const auto [u, v] = to[i];
    a.row(2 * i) << x, y, 1, 0, 0, 0, -u * x, -u * y;
    a.row(2 * i + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
    b[2 * i] = u;
    b[2 * i + 1] = v;
  }
  const Eigen::Matrix<double, 8, 1> h = a.fullPivLu().solve(b);
  Eigen::Matrix3d matrix;
  matrix << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return matrix;
}

}  // namespace synthetic
