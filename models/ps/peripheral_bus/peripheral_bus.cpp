#include <ps/peripheral_bus/peripheral_bus.h>
#include <vp/clock_scheduler.h>

namespace ps {

namespace {

constexpr const char* why_so_long =
    ": the 80 ns that the GP ports need inside the PS, and 4 cycles of CPU_1x (UG585 table 22-4: "
    "the same interconnect)";

}  // namespace

PeripheralBus::PeripheralBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock)
    : sc_module(name),
      socket("socket"),
      read_cycles("read_cycles", 78, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                  std::string("CPU cycles of a read") + why_so_long),
      write_cycles("write_cycles", 78, vp::Unit::cycles, {0, 10'000}, vp::Source::assumed,
                   std::string("CPU cycles of a write") + why_so_long),
      cpu_clock_(cpu_clock) {
  socket.register_b_transport(this, &PeripheralBus::b_transport);
  socket.register_transport_dbg(this, &PeripheralBus::transport_dbg);
  link_.socket.bind(devices.socket);
}

void PeripheralBus::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  const std::uint32_t cycles = payload.is_read() ? read_cycles : write_cycles;
  const std::uint64_t total = cpu_clock_.duration_ps(cycles);
  const std::uint64_t request = cpu_clock_.duration_ps(cycles / 2.0);
  vp::ClockScheduler& scheduler = cpu_clock_.scheduler();
  scheduler.pass_until(scheduler.now_ps() + vp::to_ps(delay) + request);
  delay = sc_core::SC_ZERO_TIME;
  link_.transport(payload, delay);
  delay += vp::from_ps(total - request);
}

unsigned PeripheralBus::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link_.transport_debug(payload);
}

}  // namespace ps
