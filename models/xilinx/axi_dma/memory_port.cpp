#include <xilinx/axi_dma/memory_port.h>

#include <algorithm>
#include <cstring>

namespace xilinx {

namespace {

bool allows(const tlm::tlm_dmi& dmi, tlm::tlm_command command) {
  return command == tlm::TLM_READ_COMMAND ? dmi.is_read_allowed() : dmi.is_write_allowed();
}

void move_enabled(bool read, unsigned char* memory, unsigned char* data,
                  const unsigned char* enables, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) {
    if (enables[i] != TLM_BYTE_ENABLED) continue;
    (read ? data[i] : memory[i]) = read ? memory[i] : data[i];
  }
}

}  // namespace

MemoryPort::MemoryPort(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name), scheduler_(scheduler) {
  SC_HAS_PROCESS(MemoryPort);
  SC_THREAD(run);
  link.on_invalidate([this](std::uint64_t first, std::uint64_t last) {
    windows_.erase(std::remove_if(windows_.begin(), windows_.end(),
                                  [=](const tlm::tlm_dmi& w) {
                                    return w.get_start_address() <= last &&
                                           first <= w.get_end_address();
                                  }),
                   windows_.end());
  });
}

void MemoryPort::read(std::uint64_t address, unsigned char* data, unsigned bytes, bool fixed,
                      unsigned beat_bytes) {
  transfer(tlm::TLM_READ_COMMAND, address, data, bytes, fixed ? std::min(bytes, beat_bytes) : bytes,
           nullptr);
}

bool MemoryPort::read_directly(std::uint64_t address, void* data, unsigned bytes) {
  const unsigned char* memory = direct_pointer(tlm::TLM_READ_COMMAND, address, bytes);
  if (!memory) return false;
  std::memcpy(data, memory, bytes);
  link.account(tlm::TLM_READ_COMMAND, address, bytes);
  return true;
}

void MemoryPort::write(std::uint64_t address, unsigned char* data, unsigned bytes, bool fixed,
                       unsigned beat_bytes) {
  transfer(tlm::TLM_WRITE_COMMAND, address, data, bytes,
           fixed ? std::min(bytes, beat_bytes) : bytes, nullptr);
}

bool MemoryPort::peek(std::uint64_t address, void* data, unsigned bytes) {
  tlm::tlm_generic_payload payload;
  payload.set_read();
  payload.set_address(address);
  payload.set_data_ptr(static_cast<unsigned char*>(data));
  payload.set_data_length(bytes);
  payload.set_streaming_width(bytes);
  return link.transport_debug(payload) == bytes;
}

void MemoryPort::transfer(tlm::tlm_command command, std::uint64_t address, unsigned char* data,
                          unsigned bytes, unsigned width, unsigned char* enables) {
  payload_.set_command(command);
  payload_.set_address(address);
  payload_.set_data_ptr(data);
  payload_.set_data_length(bytes);
  payload_.set_streaming_width(width);
  payload_.set_byte_enable_ptr(enables);
  payload_.set_byte_enable_length(enables ? bytes : 0);
  payload_.set_dmi_allowed(false);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  if (command == tlm::TLM_WRITE_COMMAND) orders.wrote(address, bytes);
  if (access_directly()) return;
  done_ = false;
  scheduler_.notify(start_);
}

bool MemoryPort::access_directly() {
  const std::uint64_t address = payload_.get_address();
  const unsigned bytes = payload_.get_data_length();
  const unsigned step = payload_.get_streaming_width();
  unsigned char* memory = direct_pointer(payload_.get_command(), address, step);
  if (!memory) return false;
  for (unsigned at = 0; at < bytes; at += step) {
    unsigned char* data = payload_.get_data_ptr() + at;
    const unsigned count = std::min(step, bytes - at);
    if (const unsigned char* enables = payload_.get_byte_enable_ptr()) {
      move_enabled(payload_.is_read(), memory, data, enables + at, count);
    } else if (payload_.is_read()) {
      std::memcpy(data, memory, count);
    } else {
      std::memcpy(memory, data, count);
    }
  }
  link.account(payload_.get_command(), address, bytes);
  payload_.set_response_status(tlm::TLM_OK_RESPONSE);
  return true;
}

const tlm::tlm_dmi* MemoryPort::window(tlm::tlm_command command, std::uint64_t address,
                                       unsigned bytes) const {
  for (const tlm::tlm_dmi& w : windows_) {
    if (address >= w.get_start_address() && address <= w.get_end_address() &&
        bytes - 1 <= w.get_end_address() - address && allows(w, command)) {
      return &w;
    }
  }
  return nullptr;
}

unsigned char* MemoryPort::direct_pointer(tlm::tlm_command command, std::uint64_t address,
                                          unsigned bytes) {
  const tlm::tlm_dmi* found = window(command, address, bytes);
  if (!found) {
    tlm::tlm_generic_payload request;
    request.set_command(command);
    request.set_address(address);
    request.set_data_length(bytes);
    tlm::tlm_dmi dmi;
    if (!link.direct_memory(request, dmi)) return nullptr;
    windows_.push_back(dmi);
    found = window(command, address, bytes);
  }
  return found ? found->get_dmi_ptr() + (address - found->get_start_address()) : nullptr;
}

void MemoryPort::run() {
  while (true) {
    sc_core::wait(start_);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    link.transport(payload_, delay);
    sc_core::wait(delay);
    scheduler_.synchronise();
    done_ = true;
  }
}

}  // namespace xilinx
