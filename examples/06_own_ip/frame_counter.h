#pragma once

#include <vp/ip.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include "frame_counter_registers.h"

/// Counts the rises of `frame_ena`, and holds `irq` high until software has seen the last one. A
/// device of events: it looks at no clock edge, so it is the same at both fidelities.
class FrameCounter : public sc_core::sc_module, public vp::Ip, private vp::SignalListener {
 public:
  FrameCounter(sc_core::sc_module_name name, const vp::Clock& clk)
      : sc_module(name), Ip(&clk), s_axi("s_axi", frame_counter::registers, {}, &clk.scheduler()) {
    s_axi[frame_counter::STATUS].after_write(
        [this](std::uint32_t) { irq = s_axi[frame_counter::STATUS].any(frame_counter::counted); });
  }
  const char* kind() const override { return "Frame counter"; }  // what `markervp map` calls it

  vp::RegisterBank s_axi;
  vp::In<bool> frame_ena{"frame_ena"};
  vp::Signal<bool> irq{"irq"};

 private:
  void end_of_elaboration() override { frame_ena.signal()->attach(*this); }
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    if (signal.bits() == 0 || !s_axi[frame_counter::CONTROL].any(frame_counter::enable)) return;
    s_axi[frame_counter::COUNT] = s_axi[frame_counter::COUNT] + 1;
    s_axi[frame_counter::STATUS].set_bits(frame_counter::counted);
    irq = true;
  }
  vp::IpEstimate own_estimate() const override {
    vp::IpEstimate e;
    e.lut = 60;
    e.ff = 90;
    e.uncertainty_percent = 50;
    e.source = "assumed: a counter and an AXI4-Lite slave";
    e.fmax_hz = 150'000'000;
    e.fmax_documentation = "assumed: a 32-bit counter";
    return e;
  }
};
