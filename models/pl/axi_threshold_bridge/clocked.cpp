#include <pl/axi_threshold_bridge/clocked.h>

#include <pl/common/estimate.h>
#include <algorithm>
#include <utility>

namespace pl {

AxiThresholdBridgeClocked::AxiThresholdBridgeClocked(sc_core::sc_module_name name, vp::Clock& clk)
    : Clocked(name, clk), Ip(&clk), fifo_(fifo_depth) {
  wake_on(ena);
  wake_on(rst);
  wake_on(thresh_in);
  wake_on(m.tready);
}

void AxiThresholdBridgeClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  if (!ena) {
    sleep();
    return;
  }
  const std::uint32_t waiting = fifo_.count();
  const bool arrived = thresh_in != thresh_seen;
  if (m.free()) {
    const bool passes = m.tvalid.written();
    if (passes && in_packet_ == 0) packet_peak_ = std::exchange(peak_, 0);
    if (waiting != 0) {
      const bool last = ++in_packet_ == burst_words;
      if (last) in_packet_ = 0;
      m.offer(fifo_.pop(), last);
    } else {
      m.withdraw();
    }
  }
  if (arrived) {
    thresh_seen = thresh_in;
    // Room is judged by what stood before this clock, as the RTL's full flag does.
    if (waiting < fifo_depth) {
      fifo_.push(thresh_data);
    } else {
      bridge_overflow = bridge_overflow + 1;
    }
  }
  peak_ = std::max(peak_, fifo_.count());
  fifo_count = static_cast<std::uint16_t>(fifo_.count());
  const bool stuck = m.tvalid.written() && !m.tready.read();
  const bool empty = !m.tvalid.written() && fifo_.count() == 0;
  if (!arrived && (stuck || empty)) sleep();
}

void AxiThresholdBridgeClocked::reset() {
  fifo_.clear();
  in_packet_ = 0;
  peak_ = packet_peak_ = 0;
  m.withdraw();
  thresh_seen = false;
  fifo_count = 0;
  bridge_overflow = 0;
  sleep();
}

vp::IpEstimate AxiThresholdBridgeClocked::own_estimate() const {
  vp::IpEstimate e = small_ip("axi_threshold_bridge", 60, 80, 100 * mhz);
  add_fifo(e, fifo_depth, 32);
  return e;
}

}  // namespace pl
