#include <chip/block_design/import_design.h>
#include <chip/handoff/netlist.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <cctype>
#include <cstdio>
#include <map>

namespace platform::block_design {

namespace {

using handoff::Handoff;
using handoff::Module;
using handoff::Netlist;

constexpr std::uint32_t first_shared_interrupt = 32;  ///< of the controller's numbers
constexpr unsigned level_high = 4;                    ///< an interrupt's flag in a device tree
constexpr unsigned first_fclk = 15;                   ///< FCLK_CLK0 among the clocks of clkc

const std::string indent = "\t\t\t";  ///< of a device's properties

/// The IP as a device tree calls its class, and an older name that Linux knows as well.
struct Names {
  const char* node;
  const char* older;
};

const std::map<std::string, Names>& names() {
  static const std::map<std::string, Names> list{
      {"axi_dma", {"dma", "xlnx,axi-dma-1.00.a"}},
      {"axi_vdma", {"dma", "xlnx,axi-vdma-1.00.a"}},
      {"axi_cdma", {"dma", "xlnx,axi-cdma-1.00.a"}},
      {"axi_gpio", {"gpio", "xlnx,xps-gpio-1.00.a"}},
      {"axi_iic", {"i2c", "xlnx,xps-iic-2.00.a"}},
      {"axi_intc", {"interrupt-controller", "xlnx,xps-intc-1.00.a"}},
      {"axi_timer", {"timer", "xlnx,xps-timer-1.00.a"}},
      {"axi_uartlite", {"serial", "xlnx,xps-uartlite-1.00.a"}}};
  return list;
}

std::string dashes(std::string text) {
  for (char& c : text)
    c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "xlnx,sg-length-width = <0x14>;" for each parameter C_… that is a number of 32 bits.
std::string properties(const Module& module) {
  std::string text;
  for (const auto& [name, value] : module.parameters) {
    const bool is_option = name.rfind("C_", 0) == 0 && name.find("ADDR") == std::string::npos;
    const auto number = is_option ? vp::Decimal::parse(value) : std::nullopt;
    const auto whole = number ? number->whole() : std::nullopt;
    if (!whole || *whole < 0 || *whole > UINT32_MAX) continue;
    char digits[16];
    std::snprintf(digits, sizeof digits, "0x%x", static_cast<unsigned>(*whole));
    text += "\t\t\txlnx," + dashes(name.substr(2)) + " = <" + digits + ">;\n";
  }
  return text;
}

/// The cells of an interrupt, as its controller's binding has them.
std::string cells_of(const Netlist::Interrupt& interrupt) {
  if (!interrupt.controller) {
    return "0 " + std::to_string(interrupt.id - first_shared_interrupt) + " " +
           std::to_string(level_high);
  }
  const auto kinds =
      vp::Decimal::parse(handoff::parameter(interrupt.controller->parameters, "C_KIND_OF_INTR"));
  const auto edges = kinds ? kinds->whole() : std::nullopt;
  const bool is_edge = edges && (*edges >> interrupt.id & 1) != 0;
  return std::to_string(interrupt.id) + (is_edge ? " 0" : " 2");  // of xlnx,xps-intc-1.00.a
}

/// Of a module that has lines to several controllers those to the first one.
std::string interrupts_of(const Module& module, const std::vector<Netlist::Interrupt>& all) {
  std::string cells, pins;
  const Module* controller = nullptr;
  for (const Netlist::Interrupt& interrupt : all) {
    if (interrupt.source.pin.module != &module) continue;
    if (cells.empty()) controller = interrupt.controller;
    if (interrupt.controller != controller) continue;
    cells += (cells.empty() ? "" : " ") + cells_of(interrupt);
    pins += (pins.empty() ? "\"" : ", \"") + interrupt.source.pin.port->name + "\"";
  }
  if (cells.empty()) return {};
  return indent + "interrupt-parent = <&" + (controller ? controller->instance : "intc") + ">;\n" +
         indent + "interrupts = <" + cells + ">;\n" + indent + "interrupt-names = " + pins + ";\n";
}

std::string clocks_of(const Module& module, const Netlist& nets) {
  std::string cells, pins;
  for (const handoff::Port& port : module.ports) {
    const auto source =
        port.kind == "clk" && port.direction == 'I' ? nets.driver(port) : std::nullopt;
    const bool is_fclk = source && source->module && source->port->name.rfind("FCLK_CLK", 0) == 0;
    if (!is_fclk) continue;
    const unsigned number = first_fclk + static_cast<unsigned>(source->port->name.back() - '0');
    cells += (cells.empty() ? "<&clkc " : ", <&clkc ") + std::to_string(number) + ">";
    pins += (pins.empty() ? "\"" : ", \"") + port.name + "\"";
  }
  return cells.empty() ? "" : "\t\t\tclocks = " + cells + ";\n\t\t\tclock-names = " + pins + ";\n";
}

}  // namespace

std::string compatible(const Module& module) {
  return "xlnx," + dashes(module.ip()) + "-" + vp::split(module.vlnv, ':').back();
}

std::string device_tree(const Handoff& handoff) {
  const Netlist nets(handoff);
  std::vector<Netlist::Interrupt> interrupts = nets.interrupts();
  const auto behind = nets.interrupts_of_controllers();
  interrupts.insert(interrupts.end(), behind.begin(), behind.end());
  std::string text =
      "/* Devices of the programmable logic of " + handoff.name +
      ": include it behind the board's. */\n/ {\n\tamba_pl: amba_pl {\n\t\t#address-cells = <1>;\n"
      "\t\t#size-cells = <1>;\n\t\tcompatible = \"simple-bus\";\n\t\tranges;\n";
  for (const handoff::Segment& segment : handoff.ps().segments) {
    const Module* module = handoff.module(segment.instance);
    if (!module) continue;
    const auto known = module->is_vendors() ? names().find(module->ip()) : names().end();
    char place[64];
    std::snprintf(place, sizeof place, "%08llx", static_cast<unsigned long long>(segment.base));
    text += "\t\t" + module->instance + ": " +
            (known != names().end() ? known->second.node : module->ip()) + "@" + place +
            " {\n\t\t\tcompatible = \"" + compatible(*module) + "\"" +
            (known != names().end() ? std::string(", \"") + known->second.older + "\"" : "") +
            ";\n";
    std::snprintf(place, sizeof place, "0x%08llx 0x%llx",
                  static_cast<unsigned long long>(segment.base),
                  static_cast<unsigned long long>(segment.last - segment.base) + 1);
    text += std::string("\t\t\treg = <") + place + ">;\n" + interrupts_of(*module, interrupts) +
            clocks_of(*module, nets) + properties(*module) + "\t\t};\n";
  }
  return text + "\t};\n};\n";
}

}  // namespace platform::block_design
