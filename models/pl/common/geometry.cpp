#include <pl/common/geometry.h>

#include <vp/error.h>
#include <string>

namespace pl {

void check(const Geometry& g) {
  using namespace marker_logic;
  if (is_legal_size(g.width, g.height)) return;
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
  refuse("pl.width x pl.height must be a multiple of 1024 (whole bursts of 32 words)");
}

}  // namespace pl
