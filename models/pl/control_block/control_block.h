#pragma once

#include <cstdint>
#include <systemc>

#include <vp/ip.h>
#include <vp/signal.h>

namespace pl {

/// The bits of the control packet (figure 4.19 is not in the text of the thesis: decision).
namespace control_packet {

constexpr std::uint32_t ena = 1u << 0;
constexpr std::uint32_t rst = 1u << 1;
constexpr std::uint32_t ready_shift = 2;  ///< two bits, toggling
constexpr std::uint32_t wr_en = 1u << 4;
constexpr std::uint32_t wr_thresh = 1u << 5;
constexpr std::uint32_t threshold_shift = 8;  ///< eight bits

}  // namespace control_packet

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
