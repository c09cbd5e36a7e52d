#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <vp/clock.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Tells when a frame is completely processed (decision: the thesis sends the end packet then, and
/// does not say how).
///
/// `busy` falls when the pixel pipeline has drained and the blob detection is idle: clock
/// max(W·H + 17, W·H + 5 + labels still active). `done` waits, too, for a word that leaves in that
/// very clock, so that the end packet never overtakes a feature.
class FrameStatus : public vp::Clocked {
 public:
  static Models<FrameStatus>& models();

  vp::In<bool> rst{"rst", this};
  vp::In<bool> frame_ena{"frame_ena", this};
  vp::In<bool> idle{"idle", this};
  vp::In<bool> corner_out{"corner_out", this};
  vp::In<bool> blob_out{"blob_out", this};
  vp::Signal<bool> busy{"busy"};
  vp::Signal<bool> done{"done"};

 protected:
  FrameStatus(sc_core::sc_module_name name, const Site& site);
  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);
};

/// The frame status clock by clock.
class FrameStatusClocked : public FrameStatus {
 public:
  /// Clocks after the last pixel that cover the pipeline of every module.
  static constexpr std::uint32_t drain_clocks = 15;

  FrameStatusClocked(sc_core::sc_module_name name, const Site& site) : FrameStatus(name, site) {}

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
