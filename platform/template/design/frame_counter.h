#pragma once

#include <vp/ip.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

#include "frame_counter_registers.h"

/// Counts the rises of `frame_ena`, and holds `irq` high until software has seen the last one. A
/// device of events: it looks at no clock edge, so it is the same at both fidelities.
class FrameCounter : public sc_core::sc_module, public vp::Ip, private vp::SignalListener {
 public:
  FrameCounter(sc_core::sc_module_name name, const vp::Clock& clk);
  const char* kind() const override { return "Frame counter"; }  // what `markervp map` calls it

  vp::RegisterBank s_axi;
  vp::In<bool> frame_ena{"frame_ena"};
  vp::Signal<bool> irq{"irq"};

 private:
  void end_of_elaboration() override { frame_ena.signal()->attach(*this); }
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;
};
