#include <ps/interconnect/private_bus.h>
#include <vp/clock_scheduler.h>

namespace ps {

namespace {

constexpr const char* assumed =
    ": a few cycles of the peripheral clock (half the CPU's) each way through the SCU";

}  // namespace

PrivateBus::PrivateBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock)
    : sc_module(name),
      socket("socket"),
      read_cycles("read_cycles", 32, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                  std::string("CPU cycles of a read") + assumed),
      write_cycles("write_cycles", 24, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                   std::string("CPU cycles of a write") + assumed),
      cpu_clock_(cpu_clock) {
  socket.register_b_transport(this, &PrivateBus::b_transport);
  socket.register_transport_dbg(this, &PrivateBus::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &PrivateBus::get_direct_mem_ptr);
  link_.on_invalidate([this](std::uint64_t first, std::uint64_t last) {
    socket->invalidate_direct_mem_ptr(first, last);
  });
  link_.socket.bind(devices.socket);
}

const PrivateBus::Durations& PrivateBus::durations() const {
  if (durations_hertz_ != cpu_clock_.frequency_hz()) {
    durations_hertz_ = cpu_clock_.frequency_hz();
    durations_ = {cpu_clock_.duration_ps(read_cycles), cpu_clock_.duration_ps(read_cycles / 2.0),
                  cpu_clock_.duration_ps(write_cycles), cpu_clock_.duration_ps(write_cycles / 2.0)};
  }
  return durations_;
}

void PrivateBus::enter(bool read, std::uint64_t start_ps, Passage& passage) const {
  const Durations& d = durations();
  const std::uint64_t request = read ? d.read_request : d.write_request;
  passage.earliest_ps = passage.leaves_ps = start_ps + request;
  passage.answer_ps = 0;
  passage.rest_ps = (read ? d.read : d.write) - request;
}

void PrivateBus::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  vp::ClockScheduler& scheduler = cpu_clock_.scheduler();
  Passage passage{};
  enter(payload.is_read(), scheduler.now_ps() + vp::to_ps(delay), passage);
  scheduler.pass_until(passage.earliest_ps);
  delay = sc_core::SC_ZERO_TIME;
  link_.transport(payload, delay);
  delay += vp::from_ps(passage.rest_ps);
}

bool PrivateBus::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  vp::RegisterRoute* route = vp::RegisterRoute::asked_for(payload);
  if (!route) return false;  // an access takes time
  route->add(*this, payload.get_address());
  return link_.direct_memory(payload, dmi);
}

unsigned PrivateBus::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link_.transport_debug(payload);
}

}  // namespace ps
