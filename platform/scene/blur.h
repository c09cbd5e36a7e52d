#pragma once

#include <vector>

namespace platform {

/// Gaussian blur, in place, of a picture of width x height values; beyond the border its outermost
/// value goes on. The kernel ends at four deviations. `sigma` in px; 0 changes nothing.
void gaussian_blur(std::vector<double>& picture, int width, int height, double sigma);

}  // namespace platform
