#include <vp/mm_link.h>

#include <algorithm>
#include <utility>

#include <vp/register_route.h>

namespace vp {

MmLink::MmLink(sc_core::sc_module_name name) : sc_module(name), socket("socket") {
  socket.register_invalidate_direct_mem_ptr(this, &MmLink::invalidate);
}

void MmLink::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  for (MmObserver* observer : observers_) observer->before(*this, payload, delay);
  socket->b_transport(payload, delay);
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
  if (RegisterRoute* route = RegisterRoute::asked_for(payload)) {
    if (!observers_.empty()) return false;
    route->add(*this);
  }
  return direct_allowed() && socket->get_direct_mem_ptr(payload, dmi);
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

// Direct access was given for the observers that were there. Before the sockets are bound nobody
// has any.
void MmLink::take_back() {
  if (sc_core::sc_get_status() >= sc_core::SC_END_OF_ELABORATION) {
    invalidate(0, ~sc_dt::uint64{0});
  }
}

void MmLink::invalidate(sc_dt::uint64 first, sc_dt::uint64 last) {
  if (invalidated_) invalidated_(first, last);
}

}  // namespace vp
