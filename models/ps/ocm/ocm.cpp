#include <ps/ocm/ocm.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <algorithm>
#include <cstring>

namespace ps {

namespace {

constexpr unsigned bytes_per_cycle = 8;  // a 64-bit port

/// Bytes beyond the streaming width go to the first addresses again (AXI: a FIXED burst).
void copy(unsigned char* memory, tlm::tlm_generic_payload& payload) {
  const unsigned width = payload.get_streaming_width();
  const unsigned char* enables = payload.get_byte_enable_ptr();
  unsigned char* data = payload.get_data_ptr();
  for (unsigned i = 0; i < payload.get_data_length(); ++i) {
    if (enables && enables[i % payload.get_byte_enable_length()] != TLM_BYTE_ENABLED) continue;
    if (payload.is_read()) data[i] = memory[i % width];
    if (payload.is_write()) memory[i % width] = data[i];
  }
}

}  // namespace

Ocm::Ocm(sc_core::sc_module_name name, const vp::Clock& cpu_clock)
    : sc_module(name),
      socket("socket"),
      read_cycles("read_cycles", 24, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                  "CPU cycles of a read through the SCU: about those of the L2 cache"),
      write_cycles("write_cycles", 24, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                   "CPU cycles of a write through the SCU"),
      cpu_clock_(cpu_clock),
      memory_(size, 0) {
  socket.register_b_transport(this, &Ocm::b_transport);
  socket.register_transport_dbg(this, &Ocm::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &Ocm::get_direct_mem_ptr);
}

tlm::tlm_response_status Ocm::access(tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  const unsigned length = payload.get_data_length();
  const unsigned width = payload.get_streaming_width();
  if (width == 0) return tlm::TLM_BURST_ERROR_RESPONSE;
  if (address >= size || std::min(length, width) > size - address) {
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  }
  if (payload.get_byte_enable_ptr() && payload.get_byte_enable_length() == 0) {
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  }
  if (payload.get_command() == tlm::TLM_IGNORE_COMMAND) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  copy(memory_.data() + address, payload);
  payload.set_dmi_allowed(true);
  ++(payload.is_read() ? reads : writes);
  return tlm::TLM_OK_RESPONSE;
}

void Ocm::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  const unsigned length = payload.get_data_length();
  const unsigned further = length == 0 ? 0 : (length - 1) / bytes_per_cycle;
  const std::uint32_t latency = payload.is_read() ? read_cycles : write_cycles;
  const tlm::tlm_response_status status = access(payload);
  payload.set_response_status(status);
  delay += vp::from_ps(cpu_clock_.duration_ps(latency + further));
}

unsigned Ocm::transport_dbg(tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  if (address >= size || payload.get_command() == tlm::TLM_IGNORE_COMMAND) return 0;
  const auto length =
      static_cast<unsigned>(std::min<std::uint64_t>(payload.get_data_length(), size - address));
  if (payload.is_read()) {
    std::memcpy(payload.get_data_ptr(), memory_.data() + address, length);
  } else {
    std::memcpy(memory_.data() + address, payload.get_data_ptr(), length);
  }
  return length;
}

bool Ocm::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  dmi.init();
  if (payload.get_address() >= size) {
    dmi.set_start_address(payload.get_address());
    dmi.set_end_address(payload.get_address());
    return false;
  }
  dmi.set_dmi_ptr(memory_.data());
  dmi.set_start_address(0);
  dmi.set_end_address(size - 1);
  dmi.set_read_latency(vp::from_ps(cpu_clock_.duration_ps(read_cycles)));
  dmi.set_write_latency(vp::from_ps(cpu_clock_.duration_ps(write_cycles)));
  dmi.allow_read_write();
  return true;
}

}  // namespace ps
