#pragma once

#include <cstdint>

#include <pl/axi_threshold_bridge/clocked.h>
#include <pl/axi_threshold_bridge/lazy_bridge.h>
#include <pl/clock_crossing/clock_crossing.h>

namespace pl {

/// AXI Threshold Bridge at transaction level: takes the words from the binary image itself, and
/// tells the slave when they pass. For a slave that wants single beats it works as the clocked one.
class AxiThresholdBridgeTlm : public AxiThresholdBridgeClocked,
                              private vp::BeatSource,
                              private vp::ClockListener,
                              private BinaryListener {
 public:
  /// `crossing` gets the count of words that were lost on the way.
  AxiThresholdBridgeTlm(sc_core::sc_module_name name, vp::Clock& clk, vp::Clock& pixel_clk,
                        BinaryView& binary, ClockCrossing& crossing);

  bool direct() const override { return m.slave_takes_source(); }
  void settle() override;
  std::uint32_t packet_peak() const override {
    return direct() ? bridge_.packet_peak() : AxiThresholdBridgeClocked::packet_peak();
  }

 private:
  void edge() override;
  void before_end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  std::uint64_t earliest_pass(std::uint32_t beats) override;
  Beats take(std::uint64_t cycle) override;
  void before_change(vp::Clock& clock) override;
  void after_change(vp::Clock& clock) override;
  void binary_begins() override;
  void binary_cut() override;
  void count();

  LazyBridge bridge_;
  ClockCrossing& crossing_;
  bool in_reset_ = false;
};

}  // namespace pl
