#pragma once

#include <ps/ddr/dma_allocator.h>
#include <ps/ddr/fixed_mapping.h>
#include <tlm_utils/simple_target_socket.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <cstdint>
#include <systemc>
#include <tlm>

namespace ps {

/// The DDR memory: host memory at the same numeric addresses as on the chip, so that a pointer of
/// the program and a bus address are one number. Map it with vp::Router::Addresses::absolute.
///
/// Accesses take no time here: the latency from a port to the memory belongs to the port (it is
/// published for the whole path). Whole bytes of any length, byte enables, debug access and direct
/// access (DMI) are supported.
class Ddr : public sc_core::sc_module {
 public:
  explicit Ddr(sc_core::sc_module_name name);
  const char* kind() const override { return "ps::Ddr"; }

  /// First byte: the lowest megabyte belongs to the on-chip memory (UG585 4.1).
  static constexpr std::uint64_t base = 0x0010'0000;

  vp::Parameter<std::uint64_t> size;
  vp::Parameter<std::uint64_t> dma_base;

  tlm_utils::simple_target_socket<Ddr> socket;

  vp::Counter reads{"reads", "read transactions, direct access included"};
  vp::Counter writes{"writes", "write transactions, direct access included"};
  vp::Counter bytes_read{"bytes_read", "bytes read by devices"};
  vp::Counter bytes_written{"bytes_written", "bytes written by devices"};

  /// One past the last address.
  std::uint64_t end() const { return base + size; }
  bool contains(std::uint64_t address, std::uint64_t bytes) const;
  /// Host pointer of a bus address; the same number. Throws vp::ProtocolError if it is outside.
  unsigned char* at(std::uint32_t address, std::uint64_t bytes = 1) const;
  /// Counts one transaction that went through direct access.
  void account(tlm::tlm_command command, std::uint64_t bytes);

  /// Memory for DMA buffers: from `dma_base` to the end.
  DmaAllocator& dma_memory() { return dma_memory_; }
  /// All of it is 0 and free again.
  void clear();

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  tlm::tlm_response_status access(tlm::tlm_generic_payload& payload);

  FixedMapping memory_;
  DmaAllocator dma_memory_;
};

}  // namespace ps
