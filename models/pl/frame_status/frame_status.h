#pragma once

#include <cstdint>

#include <vp/clock.h>
#include <vp/probe.h>

namespace pl {

/// Tells when a frame is completely processed (decision: the thesis sends the end packet then, and
/// does not say how).
///
/// `busy` falls when the pixel pipeline has drained and the blob detection is idle: clock
/// max(W·H + 17, W·H + 5 + labels still active). `done` waits, too, for a word that leaves in that
/// very clock, so that the end packet never overtakes a feature.
class FrameStatus : public vp::Clocked {
 public:
  /// Clocks after the last pixel that cover the pipeline of every module.
  static constexpr std::uint32_t drain_clocks = 15;

  FrameStatus(sc_core::sc_module_name name, vp::Clock& clk);

  vp::In<bool> rst{"rst", this};
  vp::In<bool> frame_ena{"frame_ena", this};
  vp::In<bool> idle{"idle", this};
  vp::In<bool> corner_out{"corner_out", this};
  vp::In<bool> blob_out{"blob_out", this};
  vp::Signal<bool> busy{"busy"};
  vp::Signal<bool> done{"done"};

 private:
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void combine();

  std::uint32_t drain_ = drain_clocks;
  bool started_ = false;
  vp::Probe<std::uint32_t> drain_probe_{"drain", drain_, 4};
  vp::Probe<bool> started_probe_{"started", started_};
};

}  // namespace pl
