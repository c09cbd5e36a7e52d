#include <pl/common/geometry.h>

#include <vp/error.h>
#include <string>

namespace pl {

namespace {

using namespace marker_logic;

/// The power of two next to it.
std::uint32_t nearest_burst(std::uint32_t words) {
  std::uint32_t burst = min_burst_words;
  // As long as the next one is not further away.
  while (burst < max_burst_words && 2 * words > 3 * burst) burst *= 2;
  return burst;
}

/// " (whole bursts of 64 words; pl.burst_words=32 fits)".
std::string whole_bursts(const Geometry& g) {
  std::string text = " (whole bursts of " + std::to_string(g.burst_words) + " words";
  std::uint32_t burst = g.burst_words / 2;
  while (burst >= min_burst_words && !is_legal_size(g.width, g.height, burst)) burst /= 2;
  if (burst >= min_burst_words) text += "; pl.burst_words=" + std::to_string(burst) + " fits";
  return text + ")";
}

}  // namespace

void check(const Geometry& g) {
  if (!is_legal_burst(g.burst_words)) {
    throw vp::InputError("pl.burst_words is " + std::to_string(g.burst_words) +
                         ": the AXI DMA makes bursts of 2, 4, 8, 16, 32, 64, 128 or 256 words; " +
                         "the nearest is " + std::to_string(nearest_burst(g.burst_words)));
  }
  if (g.pixels_per_clock != 1 && g.pixels_per_clock != 2 && g.pixels_per_clock != 4) {
    throw vp::InputError("pl.pixels_per_clock is " + std::to_string(g.pixels_per_clock) +
                         ": the logic takes 1, 2 or 4 pixels a clock, whole parts of a word");
  }
  if (is_legal_size(g.width, g.height, g.burst_words)) return;
  const auto refuse = [&g](const std::string& why) {
    throw vp::InputError("frames of " + std::to_string(g.width) + "x" + std::to_string(g.height) +
                         " px cannot be built: " + why);
  };
  const auto between = [](std::uint32_t least, std::uint32_t most) {
    return " must lie between " + std::to_string(least) + " and " + std::to_string(most) + " px";
  };
  constexpr const char* why = " (the feature words have no bits for more)";
  if (g.width < min_width || g.width > max_width)
    refuse("pl.width" + between(min_width, max_width) + why);
  if (g.height < min_height || g.height > max_height)
    refuse("pl.height" + between(min_height, max_height) + why);
  if (g.width % pixels_per_word != 0)
    refuse("pl.width must be a multiple of 32 px (whole binary words)");
  refuse("pl.width x pl.height must be a multiple of " +
         std::to_string(pixels_per_word * g.burst_words) + whole_bursts(g));
}

}  // namespace pl
