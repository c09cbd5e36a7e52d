#include <pl/control_block/control_block.h>

#include <pl/common/estimate.h>

namespace pl {

ControlBlock::ControlBlock(sc_core::sc_module_name name) : sc_module(name), Ip(nullptr) {}

// Wires and a gate. Their way is part of the paths of those that they lead to.
vp::IpEstimate ControlBlock::own_estimate() const {
  vp::IpEstimate e = synthesised_ip("control_block");
  e.fmax_hz = 464 * mhz;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation = "has no register; what a clock buffer of -1 lets through (2.155 ns)";
  return e;
}

void ControlBlock::end_of_elaboration() {
  gpio_in.signal()->attach(*this);
  if (por.bound()) por.signal()->attach(*this);
  split();
}

void ControlBlock::on_change(vp::SignalBase&, std::uint32_t) {
  split();
}

void ControlBlock::split() {
  const std::uint32_t packet = gpio_in;
  ena = (packet & control_packet::ena) != 0;
  rst_out = (packet & control_packet::rst) != 0 || (por.bound() && por);
  ready = static_cast<std::uint8_t>(packet >> control_packet::ready_shift & 3);
  wr_en = (packet & control_packet::wr_en) != 0;
  wr_thresh = (packet & control_packet::wr_thresh) != 0;
  threshold = static_cast<std::uint8_t>(packet >> control_packet::threshold_shift);
}

}  // namespace pl
