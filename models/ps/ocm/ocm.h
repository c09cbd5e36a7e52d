#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <cstdint>
#include <systemc>
#include <tlm>
#include <vector>

namespace vp {
class Clock;
}

namespace ps {

/// The on-chip memory, 256 KiB at the top of the address space, as boot code leaves it (UG585
/// chapter 29). Map it with relative addresses.
///
/// Whole bytes of any length, byte enables, debug access and direct access (DMI) are supported. An
/// access takes its latency for the first 8 bytes and a CPU cycle for each further 8.
class Ocm : public sc_core::sc_module {
 public:
  static constexpr std::uint64_t base = 0xFFFC'0000;
  static constexpr std::uint64_t size = 0x4'0000;

  Ocm(sc_core::sc_module_name name, const vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::Ocm"; }

  tlm_utils::simple_target_socket<Ocm> socket;

  vp::Parameter<std::uint32_t> read_cycles;
  vp::Parameter<std::uint32_t> write_cycles;

  vp::Counter reads{"reads", "read transactions"};
  vp::Counter writes{"writes", "write transactions"};

  /// The bytes, for loading and for tests.
  std::vector<unsigned char>& contents() { return memory_; }

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  tlm::tlm_response_status access(tlm::tlm_generic_payload& payload);

  const vp::Clock& cpu_clock_;
  std::vector<unsigned char> memory_;
};

}  // namespace ps
