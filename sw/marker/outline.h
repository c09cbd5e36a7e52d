#pragma once

#include <marker/camera.h>
#include <marker/geometry.h>
#include <marker/quad_fit.h>

#include <array>
#include <cstdint>

namespace marker {

/// Quadrilaterals that may be in a blob's outline, the best first: clockwise, image px.
struct OutlineQuads {
  static constexpr std::uint32_t most = 6;

  std::uint32_t count;
  std::array<Quad, most> quads;
};

/// For blobs that are no quadrilateral themselves: a marker that something dark touches, or of
/// which a corner is hidden. Follows the outline of what is dark around `start`, a pixel of the
/// blob, and looks for four straight pieces of it that make a quadrilateral. A pixel is dark if it
/// is nearer to the dark of `frame.part` than to its bright.
OutlineQuads quads_of_outline(const CameraFrame& frame, Pixel start);

}  // namespace marker
