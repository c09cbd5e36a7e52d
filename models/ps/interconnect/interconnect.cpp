#include <ps/interconnect/interconnect.h>
#include <vp/clock.h>
#include <string>

namespace ps {

using namespace vp::literals;

namespace {

std::string measured(const char* what) {
  return std::string(what) + ": fit over 100 to 250 MHz (UviDTE-FPSoC Zynq-7000 time measurements)";
}

}  // namespace

GpPort::GpPort(sc_core::sc_module_name name, const vp::Clock& pl_clock)
    : Bridge(name, pl_clock, Leaves::on_an_edge),
      read_time("read_time", 80_ns, vp::Unit::time, {0, 100_us}, vp::Source::published,
                measured("part of a read that does not depend on the PL clock")),
      read_clocks("read_clocks", 8.0, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::published,
                  measured("clocks of the PL in a read")),
      write_time("write_time", 96_ns, vp::Unit::time, {0, 100_us}, vp::Source::published,
                 measured("part of a write that does not depend on the PL clock")),
      write_clocks("write_clocks", 6.5, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::published,
                   measured("clocks of the PL in a write")),
      request_clocks("request_clocks", 4.0, vp::Unit::cycles, {0.0, 1000.0}, vp::Source::assumed,
                     "clocks of the PL before the slave sees the request") {}

GpPort::Times GpPort::times(bool read) const {
  const std::uint64_t in_ps = read ? read_time : write_time;
  const double in_pl = read ? read_clocks : write_clocks;
  return {in_ps / 2 + clock().duration_ps(request_clocks), in_ps + clock().duration_ps(in_pl), 0};
}

RegisterBus::RegisterBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock,
                         const RegisterBusTimes& defaults)
    : Bridge(name, cpu_clock, Leaves::at_once),
      read_cycles("read_cycles", defaults.read_cycles, vp::Unit::cycles, {0, 10'000},
                  vp::Source::assumed, std::string("CPU cycles of a read: ") + defaults.reason),
      write_cycles("write_cycles", defaults.write_cycles, vp::Unit::cycles, {0, 10'000},
                   vp::Source::assumed, std::string("CPU cycles of a write: ") + defaults.reason) {
  link.socket.bind(devices.socket);
}

RegisterBus::Times RegisterBus::times(bool read) const {
  const std::uint32_t cycles = read ? read_cycles : write_cycles;
  const std::uint64_t request = clock().duration_ps(cycles / 2.0);
  return {request, 0, clock().duration_ps(cycles) - request};
}

}  // namespace ps
