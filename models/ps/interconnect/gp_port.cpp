#include <ps/interconnect/gp_port.h>
#include <vp/clock_scheduler.h>

namespace ps {

using namespace vp::literals;

namespace {

constexpr const char* measured =
    "fit over 100 to 250 MHz (UviDTE-FPSoC Zynq-7000 time measurements)";

std::string documented(const char* what) {
  return std::string(what) + ": " + measured;
}

}  // namespace

GpPort::GpPort(sc_core::sc_module_name name, vp::Clock& pl_clock)
    : sc_module(name),
      socket("socket"),
      read_time("read_time", 80_ns, vp::Unit::time, {0, 100_us}, vp::Source::published,
                documented("part of a read that does not depend on the PL clock")),
      read_clocks("read_clocks", 8.0, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::published,
                  documented("clocks of the PL in a read")),
      write_time("write_time", 96_ns, vp::Unit::time, {0, 100_us}, vp::Source::published,
                 documented("part of a write that does not depend on the PL clock")),
      write_clocks("write_clocks", 6.5, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::published,
                   documented("clocks of the PL in a write")),
      request_clocks("request_clocks", 4.0, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::assumed,
                     "clocks of the PL before the slave sees the request"),
      pl_clock_(pl_clock) {
  socket.register_b_transport(this, &GpPort::b_transport);
  socket.register_transport_dbg(this, &GpPort::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &GpPort::get_direct_mem_ptr);
  link.on_invalidate([this](std::uint64_t first, std::uint64_t last) {
    socket->invalidate_direct_mem_ptr(first, last);
  });
}

const GpPort::Durations& GpPort::durations() const {
  if (durations_hertz_ != pl_clock_.frequency_hz()) {
    durations_hertz_ = pl_clock_.frequency_hz();
    const std::uint64_t request = pl_clock_.duration_ps(request_clocks);
    durations_ = {read_time / 2 + request, read_time + pl_clock_.duration_ps(read_clocks),
                  write_time / 2 + request, write_time + pl_clock_.duration_ps(write_clocks)};
  }
  return durations_;
}

void GpPort::enter(bool read, std::uint64_t start_ps, Passage& passage) const {
  const Durations& d = durations();
  passage.earliest_ps = start_ps + (read ? d.read_request : d.write_request);
  passage.leaves_ps = pl_clock_.edge_at_or_after(passage.earliest_ps);
  passage.answer_ps = start_ps + (read ? d.read : d.write);
  passage.rest_ps = 0;
}

// The slave samples at an edge of its clock.
std::uint64_t GpPort::leaves(std::uint64_t earliest_ps) const {
  return pl_clock_.edge_at_or_after(earliest_ps);
}

std::uint64_t GpPort::longest_wait_ps() const {
  return pl_clock_.duration_ps(1) + 1;
}

std::string GpPort::obstacle() const {
  return std::string("through ") + name() + ", but the clock " + pl_clock_.name() +
         " of the PL is stopped";
}

void GpPort::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  vp::ClockScheduler& scheduler = pl_clock_.scheduler();
  Passage passage{};
  enter(payload.is_read(), scheduler.now_ps() + vp::to_ps(delay), passage);
  while (true) {
    const std::uint64_t edge = pl_clock_.edge_at_or_after(passage.earliest_ps);
    if (edge == vp::Clock::never) {
      vp::report_bus_hang(*this, payload.is_read(), payload.get_address());
    }
    if (edge <= scheduler.now_ps()) break;
    scheduler.pass_until(edge);  // look again: the clock may have changed meanwhile
  }
  delay = sc_core::SC_ZERO_TIME;
  link.transport(payload, delay);
  const std::uint64_t answered = scheduler.now_ps() + vp::to_ps(delay);
  if (answered < passage.answer_ps) delay += vp::from_ps(passage.answer_ps - answered);
}

bool GpPort::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  vp::RegisterRoute* route = vp::RegisterRoute::asked_for(payload);
  if (!route) return false;  // an access takes time
  route->add(*this, payload.get_address());
  return link.direct_memory(payload, dmi);
}

unsigned GpPort::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link.transport_debug(payload);
}

}  // namespace ps
