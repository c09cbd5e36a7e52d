#include <ps/ddr/ddr.h>
#include <vp/error.h>
#include <vp/text.h>
#include <algorithm>
#include <cstring>

namespace ps {

using namespace vp::literals;

namespace {

constexpr std::uint64_t page = 4096;

/// The size as a whole number of pages, so that the range can be mapped.
std::uint64_t checked_size(const std::string& name, std::uint64_t size) {
  if (size % page == 0) return size;
  throw vp::InputError(name + ".size is " + std::to_string(size) +
                       " B: it must be a multiple of 4096");
}

std::uint64_t checked_dma_base(const std::string& name, std::uint64_t dma_base, std::uint64_t end) {
  if (dma_base < end) return dma_base;
  throw vp::InputError(name + ".dma_base is " + vp::hex(dma_base) + ", but the memory ends at " +
                       vp::hex(end) + ": choose a lower address or a larger " + name + ".size");
}

/// Bytes beyond the streaming width go to the first addresses again (AXI: a FIXED burst).
void copy(unsigned char* memory, tlm::tlm_generic_payload& payload) {
  const unsigned length = payload.get_data_length();
  const unsigned width = payload.get_streaming_width();
  const unsigned char* enables = payload.get_byte_enable_ptr();
  unsigned char* data = payload.get_data_ptr();
  if (!enables && width >= length) {
    if (payload.is_read()) std::memcpy(data, memory, length);
    if (payload.is_write()) std::memcpy(memory, data, length);
    return;
  }
  for (unsigned i = 0; i < length; ++i) {
    if (enables && enables[i % payload.get_byte_enable_length()] != TLM_BYTE_ENABLED) continue;
    if (payload.is_read()) data[i] = memory[i % width];
    if (payload.is_write()) memory[i % width] = data[i];
  }
}

}  // namespace

Ddr::Ddr(sc_core::sc_module_name name)
    : sc_module(name),
      size(
          "size", 511_MiB, vp::Unit::bytes, {1_MiB, 1023_MiB}, vp::Source::published,
          "DDR from address 0x100000 on: 512 MiB less the first (ZedBoard), at most 1 GiB (UG585)"),
      dma_base("dma_base", 0x1000'0000, vp::Unit::address, {base, 0x3FFF'F000},
               vp::Source::decision, "first address of the DMA buffers"),
      socket("socket"),
      memory_(std::string(this->name()) + " (DDR)", base, checked_size(this->name(), size)),
      dma_memory_(checked_dma_base(this->name(), dma_base, base + size), base + size) {
  socket.register_b_transport(this, &Ddr::b_transport);
  socket.register_transport_dbg(this, &Ddr::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &Ddr::get_direct_mem_ptr);
}

bool Ddr::contains(std::uint64_t address, std::uint64_t bytes) const {
  return address >= base && address <= end() && bytes <= end() - address;
}

unsigned char* Ddr::at(std::uint32_t address, std::uint64_t bytes) const {
  if (contains(address, bytes)) return memory_.data() + (address - base);
  throw vp::ProtocolError(std::to_string(bytes) + " bytes at " + vp::hex(address) +
                          " are not in the DDR (" + vp::hex(base) + " to " + vp::hex(end() - 1) +
                          ")");
}

void Ddr::account(tlm::tlm_command command, std::uint64_t bytes) {
  if (command == tlm::TLM_READ_COMMAND) {
    ++reads;
    bytes_read.add(bytes);
  } else if (command == tlm::TLM_WRITE_COMMAND) {
    ++writes;
    bytes_written.add(bytes);
  }
}

void Ddr::clear() {
  memory_.clear();
  dma_memory_.reset();
}

tlm::tlm_response_status Ddr::access(tlm::tlm_generic_payload& payload) {
  const unsigned length = payload.get_data_length();
  if (!contains(payload.get_address(), length)) return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (payload.get_streaming_width() == 0) return tlm::TLM_BURST_ERROR_RESPONSE;
  if (payload.get_byte_enable_ptr() && payload.get_byte_enable_length() == 0) {
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  }
  copy(memory_.data() + (payload.get_address() - base), payload);
  payload.set_dmi_allowed(true);
  return tlm::TLM_OK_RESPONSE;
}

void Ddr::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  const tlm::tlm_response_status status = access(payload);
  payload.set_response_status(status);
  if (status == tlm::TLM_OK_RESPONSE) account(payload.get_command(), payload.get_data_length());
}

unsigned Ddr::transport_dbg(tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  if (!contains(address, 0)) return 0;
  const unsigned length =
      static_cast<unsigned>(std::min<std::uint64_t>(payload.get_data_length(), end() - address));
  unsigned char* memory = memory_.data() + (address - base);
  if (payload.is_read()) {
    std::memcpy(payload.get_data_ptr(), memory, length);
  } else if (payload.is_write()) {
    std::memcpy(memory, payload.get_data_ptr(), length);
  } else {
    return 0;
  }
  return length;
}

bool Ddr::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  dmi.init();
  if (!contains(payload.get_address(), 1)) {
    dmi.set_start_address(payload.get_address());
    dmi.set_end_address(payload.get_address());
    return false;
  }
  dmi.set_dmi_ptr(memory_.data());
  dmi.set_start_address(base);
  dmi.set_end_address(end() - 1);
  dmi.allow_read_write();
  return true;
}

}  // namespace ps
