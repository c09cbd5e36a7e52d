#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// A corner that survived non-maximum suppression.
struct Corner {
  std::uint32_t x = 0, y = 0;
  std::uint32_t strength = 0;   ///< 12 bits
  std::uint32_t direction = 0;  ///< N 0, S 1, E 2, W 3: where the tip points
};

/// What one FAST module makes of a point of interest and its circle (thesis 4.3.4.3).
namespace fast {

/// The circle's 16 pixels, index 0 on top, clockwise.
using Circle = std::array<std::uint8_t, 16>;

/// What the threshold component gives (equations 4.1 and 4.2).
struct Thresholded {
  std::array<std::uint8_t, 16> difference{};
  std::uint16_t bright = 0;  ///< bit n: circle[n] > point + threshold
};
Thresholded threshold(const Circle& circle, std::uint8_t point, std::uint32_t threshold);

/// True if nine neighbouring bits of the ring of 16 are set.
bool contiguous(std::uint16_t bright);
/// Sum of the differences (equation 4.3), at most 16 · 255 = 4080.
std::uint32_t strength(const std::array<std::uint8_t, 16>& difference);
/// The region of five circle pixels with the most bright ones; the first of N 0, S 1, E 2, W 3 at a
/// tie.
std::uint32_t direction(std::uint16_t bright);

}  // namespace fast

/// Finds dark corners in a stream of pixels: FAST-9 on the bright side, then a 3×3 non-maximum
/// suppression.
///
/// The thesis has nine FAST modules side by side; eight of the nine points of interest were seen
/// before, so only the new one is computed here and its result kept for two lines. The outputs are
/// the same, clock for clock.
class CornerCore {
 public:
  /// Clocks from the one in which the window takes a pixel to the one in which the corner leaves:
  /// threshold, {strength, contiguity, direction}, two of non-maximum suppression.
  static constexpr unsigned latency = 4;
  /// The newest pixel lies this far right of and below the centre of the window.
  static constexpr std::uint32_t reach = 4;

  /// `threshold` 0 to 255 grey levels.
  CornerCore(const Geometry& geometry, std::uint32_t threshold);

  /// Takes the pixel at (x, y), in raster order. True if the window's centre (x − 4, y − 4) is a
  /// corner.
  bool push(std::uint8_t pixel, std::uint32_t x, std::uint32_t y, Corner& corner);

  void reset();

  /// What one FAST module found.
  struct Score {
    std::uint16_t strength = 0;  ///< 0: not a corner
    std::uint8_t direction = 0;
  };
  // For traces.
  /// The point of interest that was new in that clock.
  Score newest() const { return x_ < 6 || y_ < 6 ? Score{} : scores(y_ - 3)[x_ - 3]; }
  /// The one in the middle of the 3 x 3 grid.
  Score centre() const {
    return x_ < 2 * reach || y_ < 2 * reach ? Score{} : scores(y_ - reach)[x_ - reach];
  }

 private:
  Score score(std::uint32_t x, std::uint32_t y) const;
  bool is_maximum(std::uint32_t x, std::uint32_t y) const;
  const std::uint8_t* row(std::uint32_t y) const { return &pixels_[(y % 8) * width_]; }
  const Score* scores(std::uint32_t y) const { return &scores_[(y % 4) * width_]; }

  std::uint32_t width_;
  std::uint32_t threshold_;
  std::uint32_t x_ = 0, y_ = 0;       ///< of the newest pixel
  std::vector<std::uint8_t> pixels_;  ///< the last eight lines
  std::vector<Score> scores_;         ///< the last four lines of results
};

}  // namespace pl
