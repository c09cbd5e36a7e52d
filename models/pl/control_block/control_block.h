#pragma once

#include <cstdint>
#include <systemc>

#include <marker_logic.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace pl {

namespace control_packet = marker_logic::control;

/// Control Block (thesis 4.4.1, ports of table B.4): splits the control packet. Combinational, at
/// every fidelity.
class ControlBlock : public sc_core::sc_module, public vp::Ip, public vp::SignalListener {
 public:
  explicit ControlBlock(sc_core::sc_module_name name);

  vp::In<std::uint32_t> gpio_in{"gpio_in"};
  vp::In<bool> por{"por"};  ///< system reset, passed on as rst_out (addition, decision)
  vp::Signal<bool> ena{"ena"};
  vp::Signal<bool> rst_out{"rst_out"};
  vp::Signal<std::uint8_t> ready{"ready", 2};
  vp::Signal<bool> wr_en{"wr_en"};
  vp::Signal<bool> wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> threshold{"threshold"};

 private:
  void end_of_elaboration() override;
  vp::IpEstimate own_estimate() const override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void split();
};

}  // namespace pl
