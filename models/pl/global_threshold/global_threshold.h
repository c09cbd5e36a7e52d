#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/lanes.h>
#include <pl/global_threshold/core.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Global Threshold (thesis 4.3.5, ports of table B.2; `threshold` is an input, as table B.4 drives
/// it).
///
/// The threshold of a frame is loaded on the edge behind it. With several pixels a clock it is
/// loaded peak_search_clocks later, or on the edge behind the next frame if that began sooner; one
/// that ends sooner starts a new search, and the old one has no result.
class GlobalThreshold : public vp::Clocked, public vp::Ip {
 public:
  static Models<GlobalThreshold>& models();

  vp::In<bool> por{"por", this};  ///< system reset: the threshold returns to 127 (decision)
  vp::In<bool> rst{"rst", this};  ///< the adaptive threshold survives it (decision)
  vp::In<bool> frame_ena{"frame_ena", this};
  vp::In<bool> wr_thresh{"wr_thresh", this};  ///< a level: loads `threshold` on every clock
  vp::In<std::uint8_t> threshold{"threshold", this};
  vp::Signal<bool> binary_ena{"binary_ena"};
  vp::Signal<bool> thresh_out{"thresh_out"};
  vp::Signal<std::uint32_t> thresh_data{"thresh_data"};  ///< bit i is pixel 32w + i (decision)
  /// The threshold in use, 0 to 255; no port of the IP, for traces and reports.
  vp::Signal<std::uint8_t> active_threshold{"active_threshold", 8,
                                            ThresholdCore::default_threshold};

  // The images pixel by pixel.
  vp::In<std::uint8_t> pixel{"pixel", this};
  Lanes<vp::In<std::uint8_t>> more_pixels;
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> binary_out{"binary_out"};  ///< 1 is dark
  Lanes<vp::Signal<bool>> more_binary;
  vp::Signal<std::uint16_t> binary_x;
  vp::Signal<std::uint16_t> binary_y;
  // The images as a whole.
  FrameIn<GreyFrames> frames{"frames"};
  BinaryFrames binary_frames{"binary_frames", clock()};

 protected:
  GlobalThreshold(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk),
        Ip(&site.clk),
        more_pixels("pixel", site.geometry.pixels_per_clock, this),
        more_binary("binary_out", site.geometry.pixels_per_clock),
        binary_x("binary_x", site.geometry.words().x_bits()),
        binary_y("binary_y", site.geometry.words().y_bits()),
        geometry_(site.geometry) {
    wake_on(por);
    wake_on(rst);
    wake_on(frame_ena);
    wake_on(wr_thresh);
  }

  const Geometry geometry_;

  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Global Threshold clock by clock.
class GlobalThresholdClocked : public GlobalThreshold {
 public:
  GlobalThresholdClocked(sc_core::sc_module_name name, const Site& site)
      : GlobalThreshold(name, site) {}

  const ThresholdCore& core() const { return core_; }

 protected:
  /// On the edge behind the frame's last pixel.
  virtual void end_frame(std::uint64_t cycle);

  ThresholdCore core_;
  ThresholdSearch search_;

 private:
  void take_found(std::uint64_t cycle);
  void edge() override;
  void reset();
  void take_pixels();
  bool take_pixel(std::uint8_t grey);

  bool frame_before_ = false;
  std::uint32_t word_ = 0;
  vp::Probe<std::uint32_t> word_probe_{"word", word_};
  vp::Probe<std::uint8_t> dark_peak_{"dark_peak", [this] { return core_.dark_peak(); }};
  vp::Probe<std::uint8_t> bright_peak_{"bright_peak", [this] { return core_.bright_peak(); }};
};

/// Global Threshold at transaction level: a frame's binary image when it begins, the next threshold
/// when it ends.
///
/// Words also leave one by one on `thresh_out`, unless the receiver takes `binary_frames`.
class GlobalThresholdTlm : public GlobalThreshold, private FrameListener {
 public:
  GlobalThresholdTlm(sc_core::sc_module_name name, const Site& site);

 protected:
  /// As that of GlobalThresholdClocked.
  virtual void end_frame(std::uint64_t cycle);

  ThresholdFrame frame_;
  ThresholdSearch search_;
  bool running_ = false;  ///< pixels are taken

 private:
  void end_of_elaboration() override;
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void reset();
  void take_found(std::uint64_t cycle);
  void begin(std::uint64_t cycle);
  void end(std::uint64_t cycle);
  void load(std::uint64_t cycle);
  std::uint64_t next_word_leaves() const;
  bool emit(std::uint64_t cycle);

  std::uint64_t first_cycle_ = 0;  ///< edge that takes the frame's first pixel
  std::uint32_t next_word_ = 0;    ///< that leaves on thresh_out
};

}  // namespace pl
