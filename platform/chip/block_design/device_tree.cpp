#include <chip/block_design/import_design.h>
#include <chip/handoff/device_tree.h>
#include <chip/handoff/netlist.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::block_design {

namespace {

using device_tree::PlDevice;
using handoff::Handoff;
using handoff::Module;
using handoff::Netlist;

/// Each parameter C_… that is a number of 32 bits: "SG_LENGTH_WIDTH", 20.
void add_options(PlDevice& device, const Module& module) {
  for (const auto& [name, value] : module.parameters) {
    const auto number = name.rfind("C_", 0) == 0 ? vp::Decimal::parse(value) : std::nullopt;
    const auto whole = number ? number->whole() : std::nullopt;
    if (whole && *whole >= 0 && *whole <= UINT32_MAX)
      device.options.emplace_back(name.substr(2), static_cast<std::uint32_t>(*whole));
  }
}

/// The cells of an interrupt, as its controller's binding has them.
std::vector<std::uint32_t> cells_of(const Netlist::Interrupt& interrupt) {
  if (!interrupt.controller) return device_tree::shared_interrupt(interrupt.id);
  const auto kinds =
      vp::Decimal::parse(handoff::parameter(interrupt.controller->parameters, "C_KIND_OF_INTR"));
  const auto edges = kinds ? kinds->whole() : std::nullopt;
  const bool is_edge = edges && (*edges >> interrupt.id & 1) != 0;
  return {interrupt.id, is_edge ? 0u : 2u};  // of xlnx,xps-intc-1.00.a
}

/// Of a module that has lines to several controllers those to the first one.
void add_interrupts(PlDevice& device, const Module& module,
                    const std::vector<Netlist::Interrupt>& all) {
  const Module* controller = nullptr;
  for (const Netlist::Interrupt& interrupt : all) {
    if (interrupt.source.pin.module != &module) continue;
    if (device.interrupts.empty()) controller = interrupt.controller;
    if (interrupt.controller != controller) continue;
    device.interrupts.push_back({interrupt.source.pin.port->name, cells_of(interrupt)});
  }
  device.controller = controller ? controller->instance : "intc";
}

void add_clocks(PlDevice& device, const Module& module, const Netlist& nets) {
  for (const handoff::Port& port : module.ports) {
    const auto source =
        port.kind == "clk" && port.direction == 'I' ? nets.driver(port) : std::nullopt;
    const bool is_fclk = source && source->module && source->port->name.rfind("FCLK_CLK", 0) == 0;
    if (!is_fclk) continue;
    const auto number = static_cast<unsigned>(source->port->name.back() - '0');
    device.clocks.emplace_back(port.name, device_tree::fclk_output(number));
  }
}

}  // namespace

std::string device_tree(const Handoff& handoff) {
  const Netlist nets(handoff);
  std::vector<Netlist::Interrupt> interrupts = nets.interrupts();
  const auto behind = nets.interrupts_of_controllers();
  interrupts.insert(interrupts.end(), behind.begin(), behind.end());
  std::vector<PlDevice> devices;
  for (const handoff::Segment& segment : handoff.ps().segments) {
    const Module* module = handoff.module(segment.instance);
    if (!module) continue;
    PlDevice device{module->instance, module->ip(), vp::split(module->vlnv, ':')[3],
                    module->is_vendors(), segment.base};
    device.size = segment.last - segment.base + 1;
    add_interrupts(device, *module, interrupts);
    add_clocks(device, *module, nets);
    add_options(device, *module);
    devices.push_back(std::move(device));
  }
  return "/* Devices of the programmable logic of " + handoff.name +
         ": include it behind the board's. */\n/ {\n" + text(device_tree::pl_bus(devices), 1) +
         "};\n";
}

}  // namespace platform::block_design
