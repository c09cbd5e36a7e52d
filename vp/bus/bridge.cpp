#include <vp/bridge.h>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>

#include <algorithm>

namespace vp {

Bridge::Bridge(sc_core::sc_module_name name, const Clock& clock, Leaves leaves)
    : sc_module(name), socket("socket"), clock_(clock), leaves_(leaves) {
  socket.register_b_transport(this, &Bridge::b_transport);
  socket.register_transport_dbg(this, &Bridge::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &Bridge::get_direct_mem_ptr);
  link.on_invalidate([this](std::uint64_t first, std::uint64_t last) {
    socket->invalidate_direct_mem_ptr(first, last);
  });
}

void Bridge::enter(bool read, std::uint64_t start_ps, Passage& passage) const {
  if (hertz_ != clock_.frequency_hz()) {
    hertz_ = clock_.frequency_hz();
    read_ = times(true);
    write_ = times(false);
  }
  const Times& t = read ? read_ : write_;
  passage.earliest_ps = start_ps + t.request;
  passage.leaves_ps = leaves(passage.earliest_ps);
  passage.answer_ps = start_ps + t.whole;
  passage.rest_ps = t.rest;
}

inline std::uint64_t Bridge::leaves(std::uint64_t earliest_ps) const {
  return leaves_ == Leaves::at_once ? earliest_ps : clock_.edge_at_or_after(earliest_ps);
}

std::uint64_t Bridge::longest_wait_ps() const {
  return leaves_ == Leaves::at_once ? 0 : clock_.duration_ps(1) + 1;
}

std::string Bridge::obstacle() const {
  return std::string("through ") + name() + ", but the clock " + clock_.name() + " is stopped";
}

void Bridge::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  ClockScheduler& scheduler = clock_.scheduler();
  Passage passage;
  enter(payload.is_read(), scheduler.now_ps() + to_ps(delay), passage);
  // Looks again after each wait: the clock may have changed meanwhile.
  for (std::uint64_t ps = passage.leaves_ps;; ps = leaves(passage.earliest_ps)) {
    if (ps == Clock::never) report_bus_hang(*this, payload.is_read(), payload.get_address());
    if (ps <= scheduler.now_ps()) break;
    scheduler.pass_until(ps);
  }
  delay = sc_core::SC_ZERO_TIME;
  link.transport(payload, delay);
  const std::uint64_t now = scheduler.now_ps();
  delay = from_ps(std::max(now + to_ps(delay) + passage.rest_ps, passage.answer_ps) - now);
}

bool Bridge::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  RegisterRoute* route = RegisterRoute::asked_for(payload);
  if (!route) return false;
  route->add(*this, payload.get_address());
  return link.direct_memory(payload, dmi);
}

unsigned Bridge::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link.transport_debug(payload);
}

}  // namespace vp
