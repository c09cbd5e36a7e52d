#include <pl/common/geometry.h>

#include <vp/error.h>
#include <string>

namespace pl {

void check(const Geometry& g) {
  const std::string size = "frames of " + std::to_string(g.width) + "x" + std::to_string(g.height) +
                           " px cannot be built: ";
  if (g.width < 32 || g.width > 1024) {
    throw vp::InputError(
        size + "pl.width must lie between 32 and 1024 px (10-bit x of the feature packets)");
  }
  if (g.height < 16 || g.height > 512) {
    throw vp::InputError(
        size + "pl.height must lie between 16 and 512 px (9-bit y of the feature packets)");
  }
  if (g.width % 32 != 0) {
    throw vp::InputError(size + "pl.width must be a multiple of 32 px (whole binary words)");
  }
  if (g.pixels() % 1024 != 0) {
    throw vp::InputError(
        size + "pl.width x pl.height must be a multiple of 1024 (whole bursts of 32 words)");
  }
}

}  // namespace pl
