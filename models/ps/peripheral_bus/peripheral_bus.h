#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <vp/clock.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/router.h>
#include <cstdint>
#include <systemc>
#include <tlm>

namespace ps {

/// The CPU's way through the central interconnect to the registers of I/O peripherals and SLCR. An
/// access takes CPU cycles; the device sees it when half of them have passed.
class PeripheralBus : public sc_core::sc_module {
 public:
  PeripheralBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::PeripheralBus"; }

  tlm_utils::simple_target_socket<PeripheralBus> socket;  ///< addresses as on the bus (absolute)
  vp::Router devices{"devices"};                          ///< map the devices here

  vp::Parameter<std::uint32_t> read_cycles;
  vp::Parameter<std::uint32_t> write_cycles;

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);

  const vp::Clock& cpu_clock_;
  vp::MmLink link_{"link"};
};

}  // namespace ps
