#include <marker/scene/camera_effects.h>

#include <marker/scene/portable_math.h>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace platform {

void hide_corner(const Scene& scene, std::vector<double>& light) {
  const auto corners = project_marker(scene.camera, pose_at(scene, scene.time_s));
  const PixelPoint& corner = corners[0];
  double side_px = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const PixelPoint &a = corners[i], &b = corners[(i + 1) % 4];
    side_px += Eigen::Vector2d(b.x - a.x, b.y - a.y).norm() / 4;
  }
  const double radius = scene.hidden * side_px;
  double* pixel = light.data();
  for (int y = 0; y < scene.camera.height; ++y) {
    for (int x = 0; x < scene.camera.width; ++x, ++pixel) {
      const double distance = Eigen::Vector2d(x + 0.5 - corner.x, y + 0.5 - corner.y).norm();
      const double share = std::clamp(radius - distance + 0.5, 0.0, 1.0);
      *pixel += share * (scene.brightness.floor - *pixel);
    }
  }
}

double level_of(double light, const marker::LightTable& curve) {
  const double wanted = light * curve.back();
  if (!(wanted > curve.front())) return 0;
  const auto above = std::upper_bound(curve.begin(), curve.end(), wanted);
  if (above == curve.end()) return 1;
  const double low = *(above - 1);
  const double level = static_cast<double>(above - curve.begin()) - 1;
  return (level + (wanted - low) / (*above - low)) / static_cast<double>(curve.size() - 1);
}

namespace {

constexpr std::size_t side = 8;
using Block = std::array<std::array<double, side>, side>;

/// ITU-T T.81, table K.1.
constexpr std::array<std::array<int, side>, side> luminance_steps = {
    {{16, 11, 10, 16, 24, 40, 51, 61},
     {12, 12, 14, 19, 26, 58, 60, 55},
     {14, 13, 16, 24, 40, 57, 69, 56},
     {14, 17, 22, 29, 51, 87, 80, 62},
     {18, 22, 37, 56, 68, 109, 103, 77},
     {24, 35, 55, 64, 81, 104, 113, 92},
     {49, 64, 78, 87, 103, 121, 120, 101},
     {72, 92, 95, 98, 112, 100, 103, 99}}};

int step_of(std::size_t row, std::size_t column, int quality) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  return std::clamp((luminance_steps[row][column] * scale + 50) / 100, 1, 255);
}

/// The discrete cosine transform: row u has the samples of wave u.
Block make_waves() {
  constexpr double degrees_per_step = 180.0 / (2 * side);
  Block waves;
  for (std::size_t u = 0; u < side; ++u) {
    const double weight = std::sqrt(u == 0 ? 1.0 / side : 2.0 / side);
    for (std::size_t x = 0; x < side; ++x)
      waves[u][x] =
          weight *
          portable_sin_cos_degrees(static_cast<double>((2 * x + 1) * u) * degrees_per_step).cos;
  }
  return waves;
}

/// a · b, or with one of them turned over.
template <bool turn_a, bool turn_b>
Block product(const Block& a, const Block& b) {
  Block result{};
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      for (std::size_t k = 0; k < side; ++k)
        result[i][j] += (turn_a ? a[k][i] : a[i][k]) * (turn_b ? b[j][k] : b[k][j]);
    }
  }
  return result;
}

void round_coefficients(Block& block, int quality) {
  static const Block waves = make_waves();
  block = product<false, true>(product<false, false>(waves, block), waves);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const double step = step_of(row, column, quality);
      block[row][column] = std::floor(block[row][column] / step + 0.5) * step;
    }
  }
  block = product<false, false>(product<true, false>(waves, block), waves);
}

}  // namespace

void lose_as_jpeg(GreyImage& image, int quality) {
  constexpr double middle = 128, white = 255;
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  for (std::size_t top = 0; top < height; top += side) {
    for (std::size_t left = 0; left < width; left += side) {
      // Beyond the border its outermost pixels continue.
      const auto pixel = [&](std::size_t row, std::size_t column) -> std::uint8_t& {
        return image
            .pixels[std::min(top + row, height - 1) * width + std::min(left + column, width - 1)];
      };
      Block block;
      for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t column = 0; column < side; ++column)
          block[row][column] = pixel(row, column) - middle;
      }
      round_coefficients(block, quality);
      for (std::size_t row = 0; row < std::min(side, height - top); ++row) {
        for (std::size_t column = 0; column < std::min(side, width - left); ++column)
          pixel(row, column) = static_cast<std::uint8_t>(
              std::clamp(std::floor(block[row][column] + middle + 0.5), 0.0, white));
      }
    }
  }
}

}  // namespace platform
