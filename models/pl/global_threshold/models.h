#pragma once

#include <cstdint>

#include <pl/global_threshold/core.h>
#include <pl/global_threshold/frame.h>
#include <pl/global_threshold/global_threshold.h>
#include <vp/probe.h>

namespace pl {

/// Global Threshold clock by clock.
class GlobalThresholdClocked : public GlobalThreshold {
 public:
  GlobalThresholdClocked(sc_core::sc_module_name name, const Site& site)
      : GlobalThreshold(name, site) {}

  const ThresholdCore& core() const { return core_; }

 private:
  void edge() override;
  void reset();
  void take_pixel();

  ThresholdCore core_;
  bool frame_before_ = false;
  std::uint32_t word_ = 0;
  vp::Probe<std::uint32_t> word_probe_{"word", word_};
  vp::Probe<std::uint8_t> dark_peak_{"dark_peak", [this] { return core_.dark_peak(); }};
  vp::Probe<std::uint8_t> bright_peak_{"bright_peak", [this] { return core_.bright_peak(); }};
};

/// Global Threshold at transaction level: a frame's binary image when it begins, the next threshold
/// when it ends.
///
/// Words leave one by one on `thresh_out`, too, unless whoever takes them has `binary_frames`.
class GlobalThresholdTlm final : public GlobalThreshold, private FrameListener {
 public:
  GlobalThresholdTlm(sc_core::sc_module_name name, const Site& site);

 private:
  void end_of_elaboration() override;
  void edge() override;
  void pixels_changed(std::uint32_t first, std::uint32_t count) override;
  void reset();
  void begin(std::uint64_t cycle);
  void end();
  void load(std::uint64_t cycle);
  std::uint64_t next_word_leaves() const;
  bool emit(std::uint64_t cycle);

  ThresholdFrame frame_;
  bool running_ = false;           ///< pixels are taken
  std::uint64_t first_cycle_ = 0;  ///< edge that takes the frame's first pixel
  std::uint32_t next_word_ = 0;    ///< that leaves on thresh_out
};

}  // namespace pl
