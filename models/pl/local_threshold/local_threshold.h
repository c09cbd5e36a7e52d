#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pl/global_threshold/global_threshold.h>
#include <vp/parameter.h>

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

/// Local Threshold: in the place of Global Threshold, with its ports, for light that is uneven. The
/// binary image leaves `lag()` clocks later than Global Threshold's. It packs no words:
/// `thresh_out` stays low.
///
/// `wr_thresh` loads the level up to which a pixel is dark whatever lies around it, from the next
/// frame on; 0 after a system reset. A frame that begins while the one before leaves, or ends
/// without all its pixels and without `rst`, ends the run with an error.
class LocalThreshold : public GlobalThreshold {
 public:
  static Models<GlobalThreshold>& models();

  vp::Parameter<std::uint32_t> radius{
      "radius",
      5,
      vp::Unit::pixels,
      {1, 31},
      vp::Source::decision,
      "pixels of the window on each side of its middle; its rows are line buffers"};
  vp::Parameter<std::uint32_t> offset{
      "offset",
      2,
      vp::Unit::none,
      {1, 255},
      vp::Source::decision,
      "grey levels by which a dark pixel is darker than its window's mean"};
  vp::Parameter<std::uint32_t> relative{"relative",
                                        3,
                                        vp::Unit::none,
                                        {0, 7},
                                        vp::Source::decision,
                                        "a dark pixel is also darker than its window's mean by 1 / "
                                        "2^relative of it, as in dim light; "
                                        "0: by offset alone"};

  /// Registers from the window's sum to the output: product, comparison, output; the share of the
  /// mean takes another.
  std::uint64_t pipeline_clocks() const { return relative == 0 ? 3 : 4; }

 protected:
  LocalThreshold(sc_core::sc_module_name name, const Site& site);

  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

  /// From the edge that takes a pixel to the one that lets it leave.
  std::uint64_t lag() const {
    return LocalThresholdCore::lag(geometry_, radius) / geometry_.pixels_per_clock +
           pipeline_clocks();
  }
  /// Resets and loads on this edge. True: nothing else happens.
  bool resets();
  LocalRule rule() const { return {radius, offset, relative, level_}; }
  [[noreturn]] void refuse(const std::string& why) const;

  static constexpr const char* too_early = "a frame begins before the one before has left";
  static constexpr const char* cut = "a frame ends before its last pixel: rst cuts frames";

 private:
  vp::IpEstimate own_estimate() const override;

  std::uint8_t level_ = 0;
};

}  // namespace pl
