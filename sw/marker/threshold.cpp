#include <marker/threshold.h>
#include <marker/work.h>

namespace marker {
namespace {

constexpr std::uint32_t half = 128;  ///< levels in each half of the histogram

}  // namespace

void AdaptiveThreshold::binarise(const GreyImage& image, std::uint32_t* words) {
  const FunctionScope scope(Function::thresholding);
  histogram_.fill(0);
  std::uint32_t* const histogram = histogram_.data();
  const std::uint8_t* pixel = image.pixels;
  const std::uint32_t threshold = threshold_;
  const std::uint32_t count = image.width * image.height / pixels_per_word;
  for (std::uint32_t w = 0; w < count; ++w) {
    std::uint32_t dark = 0;
    for (std::uint32_t i = 0; i < pixels_per_word; ++i) {
      const std::uint32_t level = *pixel++;
      ++histogram[level];
      dark |= static_cast<std::uint32_t>(level <= threshold) << i;
    }
    words[w] = dark;
  }
  const std::uint32_t dark_peak = peak(image, 0, 0);
  const std::uint32_t bright_peak = peak(image, half, 255);
  threshold_ = static_cast<std::uint8_t>((dark_peak + bright_peak) >> 1);
  work(Work::threshold_frames, 1);
  work(Work::threshold_pixels, std::uint64_t{image.width} * image.height);
}

/// The level of this half that reached the greatest count first. A level reached its count with its
/// last pixel, so among equals it is the one whose last pixel came first.
std::uint8_t AdaptiveThreshold::peak(const GreyImage& image, std::uint32_t first_level,
                                     std::uint8_t otherwise) const {
  std::uint32_t best = first_level, equals = 0;
  for (std::uint32_t level = first_level; level < first_level + half; ++level) {
    if (histogram_[level] > histogram_[best]) {
      best = level;
      equals = 0;
    } else if (level != best && histogram_[level] == histogram_[best]) {
      ++equals;
    }
  }
  if (histogram_[best] == 0) return otherwise;
  const std::uint32_t most = histogram_[best];
  std::array<bool, 256> seen{};
  const std::uint8_t* pixel = image.pixels + std::size_t{image.width} * image.height;
  for (; equals > 0;) {
    const std::uint8_t level = *--pixel;
    if (level < first_level || level >= first_level + half || histogram_[level] != most) continue;
    if (seen[level]) continue;
    seen[level] = true;
    --equals;
  }
  for (std::uint32_t level = first_level; level < first_level + half; ++level) {
    if (histogram_[level] == most && !seen[level]) return static_cast<std::uint8_t>(level);
  }
  return static_cast<std::uint8_t>(best);
}

}  // namespace marker
