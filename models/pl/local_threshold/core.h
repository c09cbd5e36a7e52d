#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// What makes a pixel dark where light is uneven: it is darker than the mean of the window around
/// it by `offset` grey levels (OpenCV's adaptiveThreshold() with a block of 2 radius + 1 and
/// C = offset; windows end at the frame's border), and by 1 / 2^`relative` of the mean if that is
/// not 0: what a surface reflects is relative to the light. Or it is not above `level`.
struct LocalRule {
  std::uint32_t radius = 0;    ///< px
  std::uint32_t offset = 0;    ///< grey levels
  std::uint32_t relative = 0;  ///< 0: not
  std::uint8_t level = 0;

  /// Without division: `sum` of the `count` pixels in the window.
  bool dark(std::uint8_t pixel, std::uint32_t sum, std::uint32_t count) const {
    const std::uint32_t share = relative == 0 ? 0 : sum >> relative;
    return pixel <= level || count * pixel + std::max(count * offset, share) <= sum;
  }
};

/// Pixels of a window of `radius` around `middle` that lie within `size`, along one axis.
inline std::uint32_t window_reach(std::uint32_t middle, std::uint32_t radius, std::uint32_t size) {
  return std::min(middle + radius, size - 1) - (std::max(middle, radius) - radius) + 1;
}

/// The rule as the hardware applies it, pixel by pixel: one goes into the line buffers, and the one
/// in the middle of the window leaves.
class LocalThresholdCore {
 public:
  explicit LocalThresholdCore(const Geometry& geometry, std::uint32_t radius);

  /// A new frame.
  void begin(const LocalRule& rule);
  /// Pixels that go in before the first one comes out: those of whole clocks.
  std::uint32_t lag() const { return lag(geometry_, radius_); }
  static std::uint32_t lag(const Geometry& geometry, std::uint32_t radius) {
    const std::uint32_t a_clock = geometry.pixels_per_clock;
    return (radius * geometry.width + radius + a_clock - 1) / a_clock * a_clock;
  }
  /// Takes the next pixel of the frame.
  void push(std::uint8_t pixel);
  /// After the last one: what is in the line buffers moves on by a pixel.
  void push_nothing();
  /// Whether the pixel that leaves is dark; from push number lag() + 1 on.
  bool dark() const { return dark_; }

 private:
  std::uint8_t& stored(std::uint32_t column, std::uint32_t row) {
    return rows_[row % window_ * geometry_.width + column];
  }
  void leave();
  void slide(std::uint32_t column);

  const Geometry geometry_;
  const std::uint32_t radius_, window_;
  LocalRule rule_;
  std::vector<std::uint8_t> rows_;         ///< the last `window_` ones
  std::vector<std::uint32_t> column_sum_;  ///< of each column, over the window's rows
  std::uint32_t sum_ = 0;                  ///< of the window
  std::uint32_t position_ = 0;             ///< pixels that went in, or would have
  bool dark_ = false;
};

/// The same over a whole frame: 32 pixels a word, the first in bit 0.
void find_dark(const std::uint8_t* image, const Geometry& geometry, const LocalRule& rule,
               std::vector<std::uint32_t>& words);

}  // namespace pl
