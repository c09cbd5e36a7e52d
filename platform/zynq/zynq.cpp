#include <zynq/zynq.h>

namespace platform {

Zynq::Zynq(const DesignInfo& design, pl::Fidelity otherwise)
    : fidelity("fidelity", otherwise,
               {{"tlm", pl::Fidelity::tlm}, {"clocked", pl::Fidelity::clocked}},
               vp::Source::decision,
               "how the programmable logic is modelled, if pl.fidelity names nothing else for an "
               "IP: whole frames, or clock by clock; the results are the same"),
      design_(design.make("pl", ports)) {
  scheduler.set_batch(true);
  ps.cpu.name_devices([this](std::uint32_t address) { return device_at(address); });
}

std::string Zynq::device_at(std::uint32_t address) const {
  for (const vp::Router* bus :
       {ports.registers(), static_cast<const vp::Router*>(&ps.private_bus.devices),
        &ps.peripheral_bus.devices, &ps.interconnect}) {
    const vp::Router::Region* region = bus ? bus->find(address) : nullptr;
    if (region) return region->name;
  }
  return {};
}

}  // namespace platform
