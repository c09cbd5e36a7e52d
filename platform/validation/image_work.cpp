#include <validation/image_work.h>

#include <algorithm>

#include <scene/catalogue.h>
#include <scene/renderer.h>

namespace platform::validation {

std::uint64_t count_dark(const GreyImage& image, std::uint32_t threshold) {
  const auto dark = std::count_if(image.pixels.begin(), image.pixels.end(),
                                  [&](std::uint8_t pixel) { return pixel <= threshold; });
  return static_cast<std::uint64_t>(dark);
}

std::uint64_t count_evaluated(const GreyImage& image, int threshold) {
  constexpr int radius = 3;
  std::uint64_t count = 0;
  for (int y = radius; y < image.height - radius; ++y) {
    for (int x = radius; x < image.width - radius; ++x) {
      const int limit = image.at(x, y) + threshold;
      const bool vertical = image.at(x, y - radius) > limit || image.at(x, y + radius) > limit;
      if (vertical && (image.at(x - radius, y) > limit || image.at(x + radius, y) > limit)) ++count;
    }
  }
  return count;
}

std::vector<ImageWork> image_work(const std::vector<const Frame*>& frames, int corner_threshold) {
  std::vector<ImageWork> work;
  for (const Frame* frame : frames) {
    const GreyImage image = render(make_scene(frame->input));
    work.push_back({count_dark(image, frame->threshold), count_evaluated(image, corner_threshold)});
  }
  return work;
}

}  // namespace platform::validation
