#include <zynq/zynq.h>

namespace platform {

namespace {

// What the PL's memory masters see: the range of the HP0 port.
constexpr std::uint64_t hp0_base = 0, hp0_size = 0x4000'0000;

}  // namespace

Zynq::Zynq(pl::Fidelity otherwise)
    : fidelity("fidelity", otherwise,
               {{"tlm", pl::Fidelity::tlm}, {"clocked", pl::Fidelity::clocked}},
               vp::Source::decision,
               "how the programmable logic is modelled, if pl.fidelity names nothing else for an "
               "IP: whole frames, or clock by clock; the results are the same") {
  ps.m_axi_gp0.link.socket.bind(pl.axi_interconnect.socket);
  pl.axi_mem_interconnect.map("s_axi_hp0", hp0_base, hp0_size, vp::Router::Addresses::absolute)
      .bind(ps.s_axi_hp0.socket);
  ps.gic.irq_f2p(pl.concat.dout);
  pl.proc_sys_reset.ext_reset_in(ps.fclk_reset0_n);
  scheduler.set_batch(true);
  ps.cpu.name_devices([this](std::uint32_t address) { return device_at(address); });
}

std::string Zynq::device_at(std::uint32_t address) const {
  for (const vp::Router* bus :
       {static_cast<const vp::Router*>(&pl.axi_interconnect), &ps.private_bus.devices,
        &ps.peripheral_bus.devices, &ps.interconnect}) {
    if (const vp::Router::Region* region = bus->find(address)) return region->name;
  }
  return {};
}

}  // namespace platform
