#include <vp/mm_link.h>

#include <vp/register_route.h>

#include <algorithm>
#include <cstring>
#include <utility>

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

MmLink::MmLink(sc_core::sc_module_name name) : sc_module(name), socket("socket") {
  socket.register_invalidate_direct_mem_ptr(this, &MmLink::invalidate);
}

void MmLink::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  for (MmObserver* observer : observers_) observer->before(*this, payload, delay);
  if (watched_) {
    const PayloadChecker::Sent sent = checker_.before(payload);
    socket->b_transport(payload, delay);
    checker_.after(sent, payload);
  } else {
    socket->b_transport(payload, delay);
  }
  for (MmObserver* observer : observers_) observer->after(*this, payload, delay);
  count(payload.get_command(), payload.get_data_length(), payload.is_response_error());
}

unsigned MmLink::transport_debug(tlm::tlm_generic_payload& payload) {
  return socket->transport_dbg(payload);
}

bool MmLink::direct_allowed() const {
  return std::none_of(observers_.begin(), observers_.end(),
                      [](const MmObserver* observer) { return observer->needs_transactions(); });
}

bool MmLink::direct_memory(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  RegisterRoute* const route = RegisterRoute::asked_for(payload);
  if (route) {
    if (!observers_.empty()) return false;
    route->add(*this);
  }
  if (!direct_allowed() || !socket->get_direct_mem_ptr(payload, dmi)) return false;
  if (!route && watched_) checker_.granted(payload, dmi);
  return true;
}

void MmLink::account(tlm::tlm_command command, std::uint64_t address, std::uint64_t bytes) {
  count(command, bytes, false);
  for (MmObserver* observer : observers_) observer->direct(*this, command, address, bytes);
}

void MmLink::on_invalidate(std::function<void(std::uint64_t, std::uint64_t)> callback) {
  invalidated_ = std::move(callback);
}

void MmLink::add_observer(MmObserver& observer) {
  observers_.push_back(&observer);
  take_back();
}

void MmLink::remove_observer(MmObserver& observer) {
  observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end());
  take_back();
}

// Direct access was granted with the previous observers in mind. Before the sockets are bound, none
// has been granted.
void MmLink::take_back() {
  if (sc_core::sc_get_status() >= sc_core::SC_END_OF_ELABORATION) {
    invalidate(0, ~sc_dt::uint64{0});
  }
}

void MmLink::invalidate(sc_dt::uint64 first, sc_dt::uint64 last) {
  if (invalidated_) invalidated_(first, last);
}

}  // namespace vp
