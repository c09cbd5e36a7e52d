#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <scene/grey_image.h>
#include <validation/measured.h>

namespace platform::validation {

/// What an image asks of software, counted in the image itself (figures 5.39 and 5.43).
struct ImageWork {
  std::uint64_t dark = 0;       ///< pixels at or below the frame's threshold
  std::uint64_t evaluated = 0;  ///< pixels that pass the pre-test of FAST
};

std::uint64_t count_dark(const GreyImage& image, std::uint32_t threshold);

/// Pixels with two adjacent of their four compass pixels at distance 3 brighter by more than
/// `threshold`.
std::uint64_t count_evaluated(const GreyImage& image, int threshold);

/// Of these frames, rendered anew.
std::vector<ImageWork> image_work(const std::vector<const Frame*>& frames, int corner_threshold);

}  // namespace platform::validation
