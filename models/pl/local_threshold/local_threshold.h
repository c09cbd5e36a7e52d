#pragma once

#include <cstdint>

#include <pl/global_threshold/global_threshold.h>
#include <pl/local_threshold/core.h>
#include <vp/parameter.h>

namespace pl {

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
