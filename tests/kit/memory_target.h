#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <cstring>
#include <systemc>
#include <tlm>
#include <vector>

namespace kit {

/// A memory for tests: with or without direct access, with a latency, or answering an error.
class MemoryTarget : public sc_core::sc_module {
 public:
  MemoryTarget(sc_core::sc_module_name name, std::size_t bytes)
      : sc_module(name), socket("socket"), bytes_(bytes) {
    socket.register_b_transport(this, &MemoryTarget::b_transport);
    socket.register_transport_dbg(this, &MemoryTarget::transport_dbg);
    socket.register_get_direct_mem_ptr(this, &MemoryTarget::get_direct_mem_ptr);
  }

  tlm_utils::simple_target_socket<MemoryTarget> socket;
  bool allow_dmi = true;
  tlm::tlm_response_status answer = tlm::TLM_OK_RESPONSE;
  sc_core::sc_time latency;
  unsigned transactions = 0;

  unsigned char* data() { return bytes_.data(); }
  std::uint32_t word(std::size_t offset) const {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    ++transactions;
    delay += latency;
    if (answer == tlm::TLM_OK_RESPONSE) copy(payload);
    payload.set_response_status(answer);
  }
  unsigned transport_dbg(tlm::tlm_generic_payload& payload) {
    copy(payload);
    return payload.get_data_length();
  }
  void copy(tlm::tlm_generic_payload& payload) {
    const unsigned step = payload.get_streaming_width();
    for (unsigned i = 0; i < payload.get_data_length(); ++i) {
      unsigned char& byte = bytes_.at(payload.get_address() + i % step);
      if (payload.is_read()) {
        payload.get_data_ptr()[i] = byte;
      } else {
        byte = payload.get_data_ptr()[i];
      }
    }
  }
  bool get_direct_mem_ptr(tlm::tlm_generic_payload&, tlm::tlm_dmi& dmi) {
    if (!allow_dmi) return false;
    dmi.set_dmi_ptr(bytes_.data());
    dmi.set_start_address(0);
    dmi.set_end_address(bytes_.size() - 1);
    dmi.allow_read_write();
    return true;
  }

  std::vector<unsigned char> bytes_;
};

}  // namespace kit
