#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <cstdint>
#include <systemc>
#include <tlm>

namespace vp {

/// Bytes at the end of a bus: transactions of whole bytes of any length, with byte enables and
/// streaming width, debug access and direct access (DMI). A derived class says which bytes, and
/// how long an access takes.
///
/// Answers: TLM_COMMAND_ERROR_RESPONSE for what is neither read nor write, TLM_BURST_ERROR_RESPONSE
/// for a streaming width of 0, TLM_ADDRESS_ERROR_RESPONSE beyond the memory,
/// TLM_BYTE_ENABLE_ERROR_RESPONSE for byte enables of length 0.
class MemoryTarget : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<MemoryTarget> socket;

 protected:
  explicit MemoryTarget(sc_core::sc_module_name name, const char* socket_name = "socket");

  /// `size` bytes, which stay there, at addresses from `first` on.
  void show(unsigned char* bytes, std::uint64_t first, std::uint64_t size);
  std::uint64_t first() const { return first_; }
  std::uint64_t end() const { return first_ + size_; }
  bool contains(std::uint64_t address, std::uint64_t bytes) const {
    return address >= first_ && address <= end() && bytes <= end() - address;
  }

  /// Rules of its own for a transaction that lies inside the memory.
  virtual tlm::tlm_response_status check(const tlm::tlm_generic_payload&) const {
    return tlm::TLM_OK_RESPONSE;
  }
  /// A transaction was answered, its status stands: counts it, and adds its time to `delay`.
  virtual void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) = 0;
  /// For who uses direct access; 0 if the memory does not count its time.
  virtual sc_core::sc_time latency(bool /*read*/) const { return sc_core::SC_ZERO_TIME; }

  virtual void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  virtual bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);

 private:
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  tlm::tlm_response_status access(tlm::tlm_generic_payload& payload);
  void move(tlm::tlm_generic_payload& payload);

  unsigned char* bytes_ = nullptr;
  std::uint64_t first_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace vp
