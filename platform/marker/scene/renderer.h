#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <marker/scene/grey_image.h>
#include <marker/scene/scene.h>

namespace platform {

/// The pixels where a * x + b * y + c >= 0.
struct HalfPlane {
  double a = 0;
  double b = 0;
  double c = 0;

  double at(double x, double y) const { return a * x + b * y + c; }
};

/// A convex part of the image: what lies inside all its half planes. A plane surface that the
/// camera sees is one, for its edges and the camera's centre span planes; nothing has to be clipped
/// at Z = 0.
using ConvexRegion = std::vector<HalfPlane>;

/// A piece of one pixel. Its area is exact, so edges have no sampling bias.
class PixelPiece {
 public:
  /// The whole pixel (x, y): the square from (x, y) to (x + 1, y + 1).
  PixelPiece(int x, int y);

  void clip(const HalfPlane& edge);
  void clip(const ConvexRegion& region);

  /// px^2, 0 to 1.
  double area() const;

 private:
  /// A convex polygon has at most one vertex more after each cut: enough for a square and twelve
  /// cuts.
  static constexpr std::size_t most_vertices = 16;

  std::array<double, most_vertices> x_;
  std::array<double, most_vertices> y_;
  std::size_t size_ = 4;
};

/// Pixels first to last - 1 of one row.
struct PixelSpan {
  int first = 0;
  int last = 0;
};

/// The pixels of row `y`, columns 0 to width - 1, that may touch the region.
PixelSpan touched_pixels(const ConvexRegion& region, int y, int width);

/// The pixels of row `y`, columns 0 to width - 1, that lie wholly inside the region.
PixelSpan inner_pixels(const ConvexRegion& region, int y, int width);

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

/// The picture before noise and rounding: one brightness a pixel, fraction of full scale, row by
/// row. The mean over the pixel's square is exact (analytic coverage); that over the exposure of a
/// scene that moves is taken at four moments a pixel of motion, 64 at most; then comes the lens
/// with its blur and vignetting. Throws vp::InputError like validate().
std::vector<double> render_light(const Scene& scene);

/// The picture that the camera delivers: light plus noise, times 255, rounded and saturated. Equal
/// scenes give equal bytes on any host. Throws vp::InputError like validate().
GreyImage render(const Scene& scene);

}  // namespace platform
