#include <zynq/zynq.h>

#include <vp/error.h>
#include <vp/ip.h>

namespace platform {

namespace {

/// Whoever is outside of `pl` is found by nobody.
void check_that_parts_are_inside() {
  for (const sc_core::sc_object* object : sc_core::sc_get_top_level_objects()) {
    if (!dynamic_cast<const vp::Ip*>(object)) continue;
    throw vp::InputError(std::string("the part '") + object->name() +
                         "' stands outside of 'pl': let the constructor of the design take its "
                         "name as sc_core::sc_module_name");
  }
}

}  // namespace

Zynq::Zynq(const DesignInfo& design, pl::Fidelity otherwise)
    : fidelity("fidelity", otherwise,
               {{"tlm", pl::Fidelity::tlm}, {"clocked", pl::Fidelity::clocked}},
               vp::Source::decision,
               "how the programmable logic is modelled, if pl.fidelity names nothing else for an "
               "IP: whole frames, or clock by clock; the results are the same"),
      design_(design.make("pl", ports)) {
  check_that_parts_are_inside();
  ps.start_clocks();
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
