#pragma once

#include <cstdint>

#include <pl/global_threshold/global_threshold.h>
#include <vp/probe.h>

namespace pl {

/// Global Threshold, clocked.
class GlobalThresholdClocked : public GlobalThreshold {
 public:
  GlobalThresholdClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry);

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

}  // namespace pl
