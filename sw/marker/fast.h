#pragma once

#include <marker/feature_set.h>
#include <marker/images.h>

#include <array>
#include <cstdint>

namespace marker {

/// FAST corners on the PS (thesis 3.4.2, A.3.2.1): the same corners as those of the PL, in the same
/// order, with the same strength and direction.
///
/// The pre-test asks for two adjacent bright ones of the four compass pixels. The thesis' three of
/// four loses 12 of the 16 arcs of nine.
class CornerDetector {
 public:
  /// Appends the corners of `image` (at least 9 × 9 px, at most max_image_width wide) to
  /// `features`. `threshold`: grey levels by which a pixel of the circle must be brighter than the
  /// point.
  void detect(const GreyImage& image, std::uint32_t threshold, FeatureSet& features);

 private:
  /// One row of points before suppression, by column.
  struct Row {
    std::array<std::uint16_t, max_image_width> strength;  ///< 0: not a corner
    std::array<std::uint16_t, max_image_width> bright;    ///< a bit for each pixel of the circle
  };

  void lay_circle(std::int32_t width);
  void score(const GreyImage& image, std::uint32_t y);
  std::uint32_t examine(const std::uint8_t* point, std::uint16_t* bright);
  void suppress(const GreyImage& image, std::uint32_t y, FeatureSet& features);
  void count_work(const GreyImage& image, std::uint32_t corners) const;

  std::uint32_t threshold_ = 0;
  std::array<std::int32_t, 16> circle_{};  ///< offsets of the circle's pixels from their point
  std::array<Row, 3> rows_{};
  // What was done, for annotations.
  std::uint32_t survivors_ = 0, bright_ = 0, points_ = 0;
};

}  // namespace marker
