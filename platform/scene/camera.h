#pragma once

namespace platform {

/// A point in the image, px. The centre of the first pixel is (0.5, 0.5).
struct PixelPoint {
  double x = 0;
  double y = 0;
};

/// No image and no camera is larger.
constexpr int largest_side_px = 16384;

/// Ideal pinhole camera, looking along +Z with x right and y down. The defaults are the thesis'
/// camera (table 5.1).
struct Camera {
  int width = 640;     ///< px
  int height = 480;    ///< px
  double fx = 381.36;  ///< focal length, px
  double fy = 381.36;  ///< focal length, px
  double cx = 320.0;   ///< principal point, px
  double cy = 240.0;   ///< principal point, px

  /// The thesis' camera with `width` x `height` pixels over the same horizontal field of view: the
  /// focal length grows with the width, pixels stay square, the principal point is the centre.
  /// Throws vp::InputError if a size is out of range.
  static Camera for_resolution(int width, int height);
};

/// Throws vp::InputError unless sizes are 1 to 16384 px, focal lengths positive and everything
/// finite.
void validate(const Camera& camera);

}  // namespace platform
