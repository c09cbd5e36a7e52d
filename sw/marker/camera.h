#pragma once

#include <marker/geometry.h>
#include <marker/images.h>

#include <cstdint>

namespace marker {

/// A pinhole camera: x right, y down, z forward.
struct Camera {
  double fx, fy;  ///< focal lengths, px
  double cx, cy;  ///< principal point, px; the centre of pixel (0, 0) is (0.5, 0.5)
};

/// A camera whose lens bends straight lines, by OpenCV's model of five coefficients. What the
/// pinhole camera inside would see is in *ideal* px here, what the picture shows in image px.
struct Lens {
  Camera camera;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;  ///< radial, tangential, radial

  bool is_pinhole() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
};

/// Where the picture shows an ideal point. Image px.
Point distort(const Lens& lens, Point ideal);

/// Where a pinhole camera would see a point of the picture. False if the model has no such point
/// (beyond the radius where it folds back).
bool undistort(const Lens& lens, Point image, Point& ideal);
/// The same; adds how often the lens was asked.
bool undistort(const Lens& lens, Point image, Point& ideal, std::uint32_t& steps);

/// Pixels of a picture: columns from `left` up to, but not including `right`, and rows likewise.
struct Box {
  std::uint32_t left, top, right, bottom;
};

struct Optics;

/// The camera's picture, and how it was taken.
struct CameraFrame {
  static constexpr bool may_squeeze = false;

  GreyImage image;
  Lens lens;
  bool in_dma_memory =
      false;  ///< a DMA engine wrote it: what is read is taken out of the caches first
  /// No pixel outside of it is read.
  Box part = {0, 0, image.width, image.height};
  /// What `lens` does not say (optics.h); nullptr: it says all, and grey levels are light.
  const Optics* optics = nullptr;
};

}  // namespace marker
