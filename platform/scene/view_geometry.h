#pragma once

#include <array>
#include <cstddef>

#include <scene/convex_region.h>
#include <scene/scene.h>

namespace platform {

/// An upright rectangle on the marker's plane, marker frame, m.
struct PlaneRectangle {
  double u0;
  double v0;
  double u1;
  double v1;
};

/// The part of the image that the rectangle covers. The camera must see its front.
ConvexRegion rectangle_region(const Camera& camera, const Pose& pose,
                              const PlaneRectangle& rectangle);

/// One face of the room and its brightness.
struct RoomFace {
  ConvexRegion region;
  double level;
};

constexpr std::size_t room_faces = 5;

/// Wall, ceiling, right wall, floor, left wall. They divide the image without gap or overlap.
std::array<RoomFace, room_faces> room_regions(const Scene& scene);

}  // namespace platform
