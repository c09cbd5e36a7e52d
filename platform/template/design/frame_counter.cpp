#include "frame_counter.h"

FrameCounter::FrameCounter(sc_core::sc_module_name name, const vp::Clock& clk)
    : sc_module(name), Ip(&clk), s_axi("s_axi", frame_counter::registers, {}, &clk.scheduler()) {
  s_axi[frame_counter::STATUS].after_write(
      [this](std::uint32_t) { irq = s_axi[frame_counter::STATUS].any(frame_counter::counted); });
}

void FrameCounter::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() == 0 || !s_axi[frame_counter::CONTROL].any(frame_counter::enable)) return;
  s_axi[frame_counter::COUNT] = s_axi[frame_counter::COUNT] + 1;
  s_axi[frame_counter::STATUS].set_bits(frame_counter::counted);
  irq = true;
}

vp::IpEstimate FrameCounter::own_estimate() const {
  vp::IpEstimate e;
  e.lut = 60;
  e.ff = 90;
  e.uncertainty_percent = 50;
  e.source = "assumed: a counter and an AXI4-Lite slave";
  e.fmax_hz = 150'000'000;
  e.fmax_documentation = "assumed: a 32-bit counter";
  return e;
}
