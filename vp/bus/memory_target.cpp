#include <vp/memory_target.h>

#include <algorithm>
#include <cstring>

namespace vp {

MemoryTarget::MemoryTarget(sc_core::sc_module_name name, const char* socket_name)
    : sc_module(name), socket(socket_name) {
  socket.register_b_transport(this, &MemoryTarget::b_transport);
  socket.register_transport_dbg(this, &MemoryTarget::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &MemoryTarget::get_direct_mem_ptr);
}

void MemoryTarget::show(unsigned char* bytes, std::uint64_t first, std::uint64_t size) {
  bytes_ = bytes;
  first_ = first;
  size_ = size;
}

void MemoryTarget::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  const tlm::tlm_response_status status = access(payload);
  payload.set_response_status(status);
  answered(payload, delay);
}

tlm::tlm_response_status MemoryTarget::access(tlm::tlm_generic_payload& payload) {
  const unsigned width = payload.get_streaming_width();
  if (payload.get_command() == tlm::TLM_IGNORE_COMMAND) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (width == 0) return tlm::TLM_BURST_ERROR_RESPONSE;
  if (!contains(payload.get_address(), std::min(payload.get_data_length(), width))) {
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  }
  if (payload.get_byte_enable_ptr() && payload.get_byte_enable_length() == 0) {
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  }
  const tlm::tlm_response_status status = check(payload);
  if (status != tlm::TLM_OK_RESPONSE) return status;
  move(payload);
  payload.set_dmi_allowed(true);
  return tlm::TLM_OK_RESPONSE;
}

// Bytes beyond the streaming width go to the first addresses again (AXI: a FIXED burst).
void MemoryTarget::move(tlm::tlm_generic_payload& payload) {
  const unsigned length = payload.get_data_length();
  const unsigned width = payload.get_streaming_width();
  const unsigned char* enables = payload.get_byte_enable_ptr();
  unsigned char* memory = bytes_ + (payload.get_address() - first_);
  unsigned char* data = payload.get_data_ptr();
  const bool read = payload.is_read();
  if (!enables && width >= length) {
    std::memcpy(read ? data : memory, read ? memory : data, length);
    return;
  }
  for (unsigned i = 0; i < length; ++i) {
    if (enables && enables[i % payload.get_byte_enable_length()] != TLM_BYTE_ENABLED) continue;
    unsigned char& byte = memory[i % width];
    (read ? data[i] : byte) = read ? byte : data[i];
  }
}

unsigned MemoryTarget::transport_dbg(tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  if (!contains(address, 0) || payload.get_command() == tlm::TLM_IGNORE_COMMAND) return 0;
  const auto length =
      static_cast<unsigned>(std::min<std::uint64_t>(payload.get_data_length(), end() - address));
  unsigned char* memory = bytes_ + (address - first_);
  const bool read = payload.is_read();
  std::memcpy(read ? payload.get_data_ptr() : memory, read ? memory : payload.get_data_ptr(),
              length);
  return length;
}

bool MemoryTarget::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  dmi.init();
  if (!contains(payload.get_address(), 1)) {
    dmi.set_start_address(payload.get_address());
    dmi.set_end_address(payload.get_address());
    return false;
  }
  dmi.set_dmi_ptr(bytes_);
  dmi.set_start_address(first_);
  dmi.set_end_address(end() - 1);
  dmi.set_read_latency(latency(true));
  dmi.set_write_latency(latency(false));
  dmi.allow_read_write();
  return true;
}

}  // namespace vp
