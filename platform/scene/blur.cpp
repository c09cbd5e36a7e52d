#include <scene/blur.h>
#include <scene/portable_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace platform {

namespace {

/// Weights of offsets -radius to +radius; their sum is 1.
std::vector<double> gaussian_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> kernel;
  double sum = 0;
  for (int offset = -radius; offset <= radius; ++offset) {
    const double scaled = offset / sigma;
    kernel.push_back(portable_exp_negative(-scaled * scaled / 2));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

/// Blurs `count` values that stand `stride` apart. `line` is scratch.
void blur_line(double* values, int count, std::size_t stride, const std::vector<double>& kernel,
               std::vector<double>& line) {
  const int radius = static_cast<int>(kernel.size() / 2);
  line.clear();
  for (int i = -radius; i < count + radius; ++i) {
    line.push_back(values[static_cast<std::size_t>(std::clamp(i, 0, count - 1)) * stride]);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * line[i + k];
    values[i * stride] = sum;
  }
}

}  // namespace

void gaussian_blur(std::vector<double>& picture, int width, int height, double sigma) {
  if (sigma <= 0) return;
  const std::vector<double> kernel = gaussian_kernel(sigma);
  const auto row_length = static_cast<std::size_t>(width);
  std::vector<double> line;
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    blur_line(picture.data() + y * row_length, width, 1, kernel, line);
  }
  for (std::size_t x = 0; x < row_length; ++x) {
    blur_line(picture.data() + x, height, row_length, kernel, line);
  }
}

}  // namespace platform
