#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <vp/clock.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/register_route.h>
#include <cstdint>
#include <systemc>
#include <tlm>

namespace ps {

/// M_AXI_GP0: the CPU's way to the registers of the programmable logic.
///
/// An access takes a time in the PS that does not depend on the PL's clock, plus clocks of the PL:
/// read_time + read_clocks, write_time + write_clocks, as measured for single strongly ordered
/// accesses. Of a request that leaves the CPU at t0, half the PS time and request_clocks pass on
/// the way there; the slave sees it at the first edge of the PL clock from then on, and answers
/// within the rest. A slave that takes longer delays the answer.
class GpPort : public sc_core::sc_module, private vp::RouteStage {
 public:
  GpPort(sc_core::sc_module_name name, vp::Clock& pl_clock);
  const char* kind() const override { return "ps::GpPort"; }

  tlm_utils::simple_target_socket<GpPort> socket;
  vp::MmLink link{"link"};  ///< bind link.socket to the PL interconnect

  vp::Parameter<std::uint64_t> read_time;
  vp::Parameter<double> read_clocks;
  vp::Parameter<std::uint64_t> write_time;
  vp::Parameter<double> write_clocks;
  vp::Parameter<double> request_clocks;

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);

  void enter(bool read, std::uint64_t start_ps, Passage& passage) const override;
  std::uint64_t leaves(std::uint64_t earliest_ps) const override;
  std::uint64_t longest_wait_ps() const override;
  std::string obstacle() const override;

  /// What an access takes at a frequency of the PL clock, in ps: up to the slave's clock, and
  /// whole.
  struct Durations {
    std::uint64_t read_request, read, write_request, write;
  };
  const Durations& durations() const;

  vp::Clock& pl_clock_;
  mutable Durations durations_{};
  mutable std::uint64_t durations_hertz_ = 0;
};

}  // namespace ps
