#include <ps/interconnect/gp_port.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/hex.h>

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
}

void GpPort::wait_for_slave(const tlm::tlm_generic_payload& payload, std::uint64_t earliest_ps) {
  while (true) {
    const std::uint64_t edge = pl_clock_.edge_at_or_after(earliest_ps);
    if (edge == vp::Clock::never) {
      throw vp::ProtocolError(std::string("bus hang: ") +
                              (payload.is_read() ? "read of " : "write to ") +
                              vp::hex(payload.get_address()) + " through " + name() +
                              ", but the clock " + pl_clock_.name() + " of the PL is stopped");
    }
    if (edge <= pl_clock_.scheduler().now_ps()) return;
    pl_clock_.scheduler().pass_until(edge);  // look again: the clock may have changed meanwhile
  }
}

void GpPort::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  const vp::ClockScheduler& scheduler = pl_clock_.scheduler();
  const std::uint64_t start = scheduler.now_ps() + vp::to_ps(delay);
  const bool read = payload.is_read();
  const std::uint64_t ps_time = read ? read_time : write_time;
  const std::uint64_t earliest = start + ps_time / 2 + pl_clock_.duration_ps(request_clocks);
  const std::uint64_t end =
      start + ps_time + pl_clock_.duration_ps(read ? read_clocks : write_clocks);

  wait_for_slave(payload, earliest);
  delay = sc_core::SC_ZERO_TIME;
  link.transport(payload, delay);
  const std::uint64_t answered = scheduler.now_ps() + vp::to_ps(delay);
  if (answered < end) delay += vp::from_ps(end - answered);
}

unsigned GpPort::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link.transport_debug(payload);
}

}  // namespace ps
