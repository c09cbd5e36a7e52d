#pragma once

#include <cstdint>

#include <pl/clock_crossing/clock_crossing.h>
#include <pl/common/fidelity.h>
#include <pl/feature_packaging/core.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// AXI Threshold Bridge (thesis 4.4.2, ports of table B.5): sends the binary image to the
/// PS, a burst a packet: TLAST comes with its last word. System clock. A full FIFO (the DMA was not
/// armed again in time) drops the newest word and counts it.
class AxiThresholdBridge : public vp::Clocked, public vp::Ip {
 public:
  static Models<AxiThresholdBridge>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  vp::In<bool> thresh_in{"thresh_in", this};  ///< the crossing's toggle
  vp::In<std::uint32_t> thresh_data{"thresh_data", this};
  /// In place of these two, where the crossing has frames.
  FrameIn<FrameCrossing> crossing{"crossing"};
  vp::AxiStreamMaster m{"m", *this};

  // No ports of the IP: for the crossing, traces and reports.
  vp::Signal<bool> thresh_seen{"thresh_seen"};
  vp::Signal<std::uint16_t> fifo_count{"fifo_count"};
  vp::Signal<std::uint32_t> bridge_overflow{"bridge_overflow"};

  vp::Parameter<std::uint32_t> fifo_depth{
      "fifo_depth",         64,
      vp::Unit::none,       {1, 65536},
      vp::Source::decision, "words that wait for the DMA, besides the output register"};
  vp::Signal<std::uint32_t> depth{"depth", 17, fifo_depth};  ///< for traces: what is full

  /// Brings the counters up to now.
  virtual void settle() {}
  /// The most words that waited in the FIFO after any clock in which the packet that passed last
  /// was under way: from the clock in which the one before was through. 0 after a reset. settle()
  /// first.
  virtual std::uint32_t packet_peak() const { return packet_peak_; }

 protected:
  AxiThresholdBridge(sc_core::sc_module_name name, const Site& site);
  /// One clock edge, word by word.
  void pass_words();
  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

  const std::uint32_t burst_words_;  ///< of a packet

 private:
  vp::IpEstimate own_estimate() const override;
  void reset();

  FeatureBuffer fifo_;
  std::uint32_t in_packet_ = 0;
  std::uint32_t peak_ = 0, packet_peak_ = 0;
  vp::Probe<std::uint32_t> in_packet_probe_{"in_packet", in_packet_, 9};
};

}  // namespace pl
