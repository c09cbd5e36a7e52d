#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/register_route.h>
#include <vp/router.h>
#include <cstdint>
#include <systemc>
#include <tlm>

namespace ps {

/// The CPU's private bus from 0xF8F0_0000 on: interrupt controller and timers. An access takes CPU
/// cycles; the device sees it when half of them have passed.
class PrivateBus : public sc_core::sc_module, private vp::RouteStage {
 public:
  static constexpr std::uint64_t base = 0xF8F0'0000;
  static constexpr std::uint64_t size = 0x2000;

  PrivateBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::PrivateBus"; }

  tlm_utils::simple_target_socket<PrivateBus> socket;  ///< addresses as on the bus (absolute)
  vp::Router devices{"devices"};                       ///< map the devices here

  vp::Parameter<std::uint32_t> read_cycles;
  vp::Parameter<std::uint32_t> write_cycles;

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);

  void enter(bool read, std::uint64_t start_ps, Passage& passage) const override;

  /// What an access takes at a frequency of the CPU, in ps: whole, and up to the device.
  struct Durations {
    std::uint64_t read, read_request, write, write_request;
  };
  const Durations& durations() const;

  const vp::Clock& cpu_clock_;
  mutable Durations durations_{};
  mutable std::uint64_t durations_hertz_ = 0;
  vp::MmLink link_{"link"};
};

}  // namespace ps
