#include <pl/axi_threshold_bridge/tlm.h>

namespace pl {

AxiThresholdBridgeTlm::AxiThresholdBridgeTlm(sc_core::sc_module_name name, vp::Clock& clk,
                                             vp::Clock& pixel_clk, BinaryView& binary,
                                             ClockCrossing& crossing)
    : AxiThresholdBridgeClocked(name, clk),
      bridge_(pixel_clk, clk, binary, fifo_depth, burst_words),
      crossing_(crossing) {
  binary.add_listener(*this);
  clk.add_listener(*this);
  pixel_clk.add_listener(*this);
}

void AxiThresholdBridgeTlm::before_end_of_elaboration() {
  AxiThresholdBridgeClocked::before_end_of_elaboration();
  if (direct()) m.set_source(*this);
}

void AxiThresholdBridgeTlm::edge() {
  if (!direct()) return AxiThresholdBridgeClocked::edge();
  sleep();
  if (rst == in_reset_) return;
  const std::uint64_t cycle = clock().cycle();
  bridge_.advance(cycle - 1);
  count();
  in_reset_ = rst;
  if (rst) bridge_.advance(cycle);
  bridge_.hold_in_reset(rst);
  if (rst) bridge_overflow = 0;
  m.wake_slave();
}

void AxiThresholdBridgeTlm::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (!direct() || &signal != m.tready.signal()) {
    return AxiThresholdBridgeClocked::on_change(signal, id);
  }
  bridge_.advance(clock().cycle());
  count();
  bridge_.set_ready(m.tready);
}

void AxiThresholdBridgeTlm::settle() {
  if (!direct()) return;
  bridge_.settle();
  count();
}

void AxiThresholdBridgeTlm::count() {
  bridge_overflow = bridge_.overflow();
  const LazyBridge::Counts counts = bridge_.take_counts();
  crossing_.add_lost(counts.lost);
  m.count(counts.beats, counts.packets, counts.stalls);
}

std::uint64_t AxiThresholdBridgeTlm::earliest_pass(std::uint32_t beats) {
  return bridge_.earliest_pass(beats);
}

vp::BeatSource::Beats AxiThresholdBridgeTlm::take(std::uint64_t cycle) {
  bridge_.advance(cycle);
  count();
  return bridge_.take();
}

void AxiThresholdBridgeTlm::before_change(vp::Clock&) {
  bridge_.clock_changes();
}

void AxiThresholdBridgeTlm::after_change(vp::Clock&) {
  bridge_.clock_changed();
  if (direct()) m.wake_slave();
}

void AxiThresholdBridgeTlm::binary_begins() {
  if (!direct()) return;
  bridge_.frame_begins();
  count();
  m.wake_slave();
}

// The crossing is reset, too, and its count with it.
void AxiThresholdBridgeTlm::binary_cut() {
  if (!direct()) return;
  bridge_.frame_cut();
  count();
  m.wake_slave();
  crossing_.forget_lost();
}

}  // namespace pl
