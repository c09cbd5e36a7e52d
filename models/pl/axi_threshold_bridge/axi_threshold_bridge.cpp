#include <pl/axi_threshold_bridge/axi_threshold_bridge.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <pl/axi_threshold_bridge/lazy_bridge.h>
#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/report.h>

namespace pl {

namespace {

class AxiThresholdBridgeClocked : public AxiThresholdBridge {
 public:
  AxiThresholdBridgeClocked(sc_core::sc_module_name name, const Site& site)
      : AxiThresholdBridge(name, site) {}

 private:
  void edge() override { pass_words(); }
};

/// Takes the words from the binary image itself, and tells the slave when they pass. Where the
/// crossing has no frames, or the slave wants single beats, it works word by word.
class AxiThresholdBridgeTlm final : public AxiThresholdBridge,
                                    private vp::BeatSource,
                                    private vp::ClockListener,
                                    private FrameListener {
 public:
  AxiThresholdBridgeTlm(sc_core::sc_module_name name, const Site& site)
      : AxiThresholdBridge(name, site) {}

  void settle() override;
  std::uint32_t packet_peak() const override {
    return bridge_ ? bridge_->packet_peak() : AxiThresholdBridge::packet_peak();
  }

 private:
  void end_of_elaboration() override;
  void edge() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  std::uint64_t earliest_pass(std::uint32_t beats) override;
  Beats take(std::uint64_t cycle) override;
  void before_change(vp::Clock& clock) override;
  void after_change(vp::Clock& clock) override;
  void frame_begins() override;
  void frame_cut() override;
  void count();

  std::optional<LazyBridge> bridge_;  ///< none: word by word
  bool in_reset_ = false;
};

void AxiThresholdBridgeTlm::end_of_elaboration() {
  AxiThresholdBridge::end_of_elaboration();
  BinaryFrames* binary = crossing.open() ? nullptr : crossing->frames();
  if (!binary || !m.slave_takes_source()) return;
  bridge_.emplace(*binary, clock(), fifo_depth, burst_words_);
  binary->take_whole();
  binary->add_listener(*this);
  clock().add_listener(*this);
  binary->clock().add_listener(*this);
  m.set_source(*this);
}

void AxiThresholdBridgeTlm::edge() {
  if (!bridge_) return pass_words();
  if (!ena && !rst) {
    vp::error(*this, "/markervp/axi_threshold_bridge/ena",
              "ena is low while the system runs, which only the clocked model follows: set "
              "pl.fidelity.axi_threshold_bridge=clocked");
  }
  sleep();
  if (rst == in_reset_) return;
  const std::uint64_t cycle = clock().cycle();
  bridge_->advance(cycle - 1);
  count();
  in_reset_ = rst;
  if (rst) bridge_->advance(cycle);
  bridge_->hold_in_reset(rst);
  if (rst) bridge_overflow = 0;
  m.wake_slave();
}

void AxiThresholdBridgeTlm::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (!bridge_ || &signal != m.tready.signal()) return AxiThresholdBridge::on_change(signal, id);
  bridge_->advance(clock().cycle());
  count();
  bridge_->set_ready(m.tready);
}

void AxiThresholdBridgeTlm::settle() {
  if (!bridge_) return;
  bridge_->settle();
  count();
}

void AxiThresholdBridgeTlm::count() {
  bridge_overflow = bridge_->overflow();
  const LazyBridge::Counts counts = bridge_->take_counts();
  crossing->add_lost(counts.lost);
  m.count(counts.beats, counts.packets, counts.stalls);
}

std::uint64_t AxiThresholdBridgeTlm::earliest_pass(std::uint32_t beats) {
  return bridge_->earliest_pass(beats);
}

vp::BeatSource::Beats AxiThresholdBridgeTlm::take(std::uint64_t cycle) {
  bridge_->advance(cycle);
  count();
  return bridge_->take();
}

void AxiThresholdBridgeTlm::before_change(vp::Clock&) {
  bridge_->clock_changes();
}

void AxiThresholdBridgeTlm::after_change(vp::Clock&) {
  bridge_->clock_changed();
  m.wake_slave();
}

void AxiThresholdBridgeTlm::frame_begins() {
  bridge_->frame_begins();
  count();
  m.wake_slave();
}

// The crossing is reset, too, and its count with it.
void AxiThresholdBridgeTlm::frame_cut() {
  bridge_->frame_cut();
  count();
  m.wake_slave();
  crossing->forget_lost();
}

}  // namespace

Models<AxiThresholdBridge>& AxiThresholdBridge::models() {
  static Models<AxiThresholdBridge> models{
      "axi_threshold_bridge",
      {model<AxiThresholdBridge, AxiThresholdBridgeClocked>("clocked", by_pixel, no_image),
       model<AxiThresholdBridge, AxiThresholdBridgeTlm>("tlm", both_ways, no_image)},
      rtl_model<AxiThresholdBridge, AxiThresholdBridgeClocked>()};
  return models;
}

void AxiThresholdBridge::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(thresh_in);
  ports.input(thresh_data);
  add_stream(ports, m);
  ports.output(thresh_seen);
  ports.report(fifo_count);
  ports.report(bridge_overflow);
  ports.parameter("FIFO_DEPTH", fifo_depth.name(), fifo_depth);
  ports.parameter("BURST_WORDS", "pl.burst_words", burst_words_);
  // The most that waited while a packet was under way.
  ports.before_edge = [this] {
    if (rst) peak_ = packet_peak_ = 0;
    if (m.accepted() && m.tlast.get()) packet_peak_ = std::exchange(peak_, 0);
  };
  ports.behind_edge = [this] { peak_ = std::max<std::uint32_t>(peak_, fifo_count.written()); };
}

AxiThresholdBridge::AxiThresholdBridge(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk),
      Ip(&site.clk),
      burst_words_(site.geometry.burst_words),
      fifo_(fifo_depth) {
  wake_on(ena);
  wake_on(rst);
  m.reset_by(rst);
  wake_on(thresh_in);
  wake_on(m.tready);
}

void AxiThresholdBridge::pass_words() {
  if (rst) {
    reset();
    return;
  }
  // Without `ena` no word is taken or offered; one that is offered already passes as any other.
  const std::uint32_t waiting = fifo_.count();
  const bool arrived = ena && thresh_in != thresh_seen;
  if (m.free()) {
    const bool passes = m.tvalid.written();
    if (passes && in_packet_ == 0) packet_peak_ = std::exchange(peak_, 0);
    if (ena && waiting != 0) {
      const bool last = ++in_packet_ == burst_words_;
      if (last) in_packet_ = 0;
      m.offer(fifo_.pop(), last);
    } else {
      m.withdraw();
    }
  }
  if (arrived) {
    thresh_seen = thresh_in;
    // Room is judged by the state before this clock, as the RTL's full flag does.
    if (waiting < fifo_depth) {
      fifo_.push(thresh_data);
    } else {
      bridge_overflow = bridge_overflow + 1;
    }
  }
  peak_ = std::max(peak_, fifo_.count());
  fifo_count = static_cast<std::uint16_t>(fifo_.count());
  const bool stuck = m.tvalid.written() && !m.tready.read();
  const bool idle = !m.tvalid.written() && (!ena || fifo_.count() == 0);
  if (!arrived && (stuck || idle)) sleep();
}

void AxiThresholdBridge::reset() {
  fifo_.clear();
  in_packet_ = 0;
  peak_ = packet_peak_ = 0;
  m.withdraw();
  thresh_seen = false;
  fifo_count = 0;
  bridge_overflow = 0;
  sleep();
}

vp::IpEstimate AxiThresholdBridge::own_estimate() const {
  vp::IpEstimate e = rtl_ip("axi_threshold_bridge", {{"FIFO_DEPTH", fifo_depth}});
  e.bram36 = fifo_memory(fifo_depth, 32);
  return e;
}

}  // namespace pl
