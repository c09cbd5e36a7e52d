#include <chip/system/hardware_map.h>

#include <algorithm>
#include <cctype>

#include <axi/rtl_part.h>
#include <chip/block_design/block_design.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/text.h>
#include <xilinx/register_stub/register_stub.h>

namespace platform {

namespace {

using device_tree::Node;
using device_tree::PlDevice;
using facts::HardwareMap;
using vp::split;

/// A device of the PS as arch/arm/boot/dts/xilinx/zynq-7000.dtsi of Linux names it.
struct PsNode {
  std::uint32_t base, size;
  const char *label, *name;
  std::vector<std::string> compatible;
  std::vector<std::uint32_t> shared_interrupts;  ///< as software numbers them
  std::vector<std::uint32_t> clocks;             ///< outputs of clkc
};

const std::vector<PsNode>& ps_nodes() {
  static const std::vector<PsNode> nodes{
      {0xF800'7100, 0x20, "adc", "adc", {"xlnx,zynq-xadc-1.00.a"}, {39}, {12}},
      {0xE000'A000, 0x1000, "gpio0", "gpio", {"xlnx,zynq-gpio-1.0"}, {52}, {42}},
      {0xE000'4000, 0x1000, "i2c0", "i2c", {"cdns,i2c-r1p10"}, {57}, {38}},
      {0xE000'5000, 0x1000, "i2c1", "i2c", {"cdns,i2c-r1p10"}, {80}, {39}},
      {0xE000'0000, 0x1000, "uart0", "serial", {"xlnx,xuartps", "cdns,uart-r1p8"}, {59}, {23, 40}},
      {0xE000'1000, 0x1000, "uart1", "serial", {"xlnx,xuartps", "cdns,uart-r1p8"}, {82}, {24, 41}},
      {0xE000'6000, 0x1000, "spi0", "spi", {"xlnx,zynq-spi-r1p6"}, {58}, {25, 34}},
      {0xE000'7000, 0x1000, "spi1", "spi", {"xlnx,zynq-spi-r1p6"}, {81}, {26, 35}},
      {0xE000'D000, 0x1000, "qspi", "spi", {"xlnx,zynq-qspi-1.0"}, {51}, {10, 43}},
      {0xE000'B000, 0x1000, "gem0", "ethernet", {"xlnx,zynq-gem", "cdns,gem"}, {54}, {30, 30, 13}},
      {0xE000'C000, 0x1000, "gem1", "ethernet", {"xlnx,zynq-gem", "cdns,gem"}, {77}, {31, 31, 14}},
      {0xE010'0000, 0x1000, "sdhci0", "mmc", {"arasan,sdhci-8.9a"}, {56}, {21, 32}},
      {0xE010'1000, 0x1000, "sdhci1", "mmc", {"arasan,sdhci-8.9a"}, {79}, {22, 33}},
      {0xF800'7000,
       0x100,
       "devcfg",
       "devcfg",
       {"xlnx,zynq-devcfg-1.0"},
       {40},
       {12, 15, 16, 17, 18}},
      {0xF800'1000, 0x1000, "ttc0", "timer", {"cdns,ttc"}, {42, 43, 44}, {6}},
      {0xF800'2000, 0x1000, "ttc1", "timer", {"cdns,ttc"}, {69, 70, 71}, {6}},
      {0xE000'2000, 0x1000, "usb0", "usb", {"xlnx,zynq-usb-2.20a", "chipidea,usb2"}, {53}, {28}},
      {0xE000'3000, 0x1000, "usb1", "usb", {"xlnx,zynq-usb-2.20a", "chipidea,usb2"}, {76}, {29}},
      {0xF800'5000, 0x1000, "watchdog0", "watchdog", {"cdns,wdt-r1p2"}, {41}, {45}}};
  return nodes;
}

Node ps_node(const PsNode& device) {
  Node node{vp::lower(device.name + ("@" + vp::hex(device.base).substr(2))), device.label};
  std::vector<std::pair<std::string, std::uint32_t>> clocks;
  for (const std::uint32_t clock : device.clocks) clocks.emplace_back("clkc", clock);
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t id : device.shared_interrupts) {
    const std::vector<std::uint32_t> one = device_tree::shared_interrupt(id);
    cells.insert(cells.end(), one.begin(), one.end());
  }
  node.properties = {device_tree::texts("compatible", device.compatible),
                     device_tree::hex_numbers("reg", {device.base, device.size}),
                     device_tree::reference("interrupt-parent", "intc"),
                     device_tree::numbers("interrupts", cells),
                     device_tree::references("clocks", clocks),
                     device_tree::texts("status", {"okay"})};
  return node;
}

Node interrupt_controller() {
  Node node{"interrupt-controller@f8f01000", "intc"};
  node.properties = {device_tree::texts("compatible", {"arm,cortex-a9-gic"}),
                     device_tree::numbers("#interrupt-cells", {3}),
                     device_tree::flag("interrupt-controller"),
                     device_tree::hex_numbers("reg", {0xF8F0'1000, 0x1000, 0xF8F0'0100, 0x100})};
  return node;
}

/// A timer of the core, whose interrupt is one of its own: number in the binding of the GIC.
Node core_timer(const char* label, std::uint32_t base, const char* compatible,
                std::uint32_t interrupt) {
  constexpr std::uint32_t own = 1, rising_on_both = 0x301;
  Node node{"timer@" + std::string(base == 0xF8F0'0200 ? "f8f00200" : "f8f00600"), label};
  node.properties = {device_tree::texts("compatible", {compatible}),
                     device_tree::hex_numbers("reg", {base, 0x20}),
                     device_tree::reference("interrupt-parent", "intc"),
                     device_tree::numbers("interrupts", {own, interrupt, rising_on_both}),
                     device_tree::references("clocks", {{"clkc", 4}})};
  return node;
}

Node slcr(ProcessingSystem& ps) {
  std::uint32_t fclks = 0;
  for (const auto& [number, source] : ps.fclks()) fclks |= 1u << number;
  Node clocks{"clkc@100", "clkc"};
  clocks.properties = {
      device_tree::numbers("#clock-cells", {1}),
      device_tree::texts("compatible", {"xlnx,ps7-clkc"}),
      device_tree::hex_numbers("reg", {0x100, 0x100}),
      device_tree::hex_numbers("fclk-enable", {fclks}),
      device_tree::numbers("ps-clk-frequency", {static_cast<std::uint32_t>(ps.slcr.ps_clk.get())})};
  Node node{"slcr@f8000000", "slcr"};
  node.properties = {
      device_tree::numbers("#address-cells", {1}), device_tree::numbers("#size-cells", {1}),
      device_tree::texts("compatible", {"xlnx,zynq-slcr", "syscon", "simple-mfd"}),
      device_tree::hex_numbers("reg", {0xF800'0000, 0x1000}), device_tree::flag("ranges")};
  node.children.push_back(std::move(clocks));
  return node;
}

/// Those devices of the PS that the platform has.
Node ps_bus(Zynq& zynq, const HardwareMap& map) {
  Node bus{"axi", "amba"};
  bus.properties = {
      device_tree::texts("compatible", {"simple-bus"}), device_tree::numbers("#address-cells", {1}),
      device_tree::numbers("#size-cells", {1}), device_tree::reference("interrupt-parent", "intc"),
      device_tree::flag("ranges")};
  for (const PsNode& device : ps_nodes()) {
    const bool is_there = std::any_of(map.devices.begin(), map.devices.end(),
                                      [&](const auto& one) { return one.base == device.base; });
    if (is_there) bus.children.push_back(ps_node(device));
  }
  bus.children.push_back(interrupt_controller());
  bus.children.push_back(slcr(zynq.ps));
  bus.children.push_back(core_timer("global_timer", 0xF8F0'0200, "arm,cortex-a9-global-timer", 11));
  bus.children.push_back(core_timer("scutimer", 0xF8F0'0600, "arm,cortex-a9-twd-timer", 13));
  return bus;
}

/// The module that a place of the map belongs to; null for none.
const sc_core::sc_object* module_at(const HardwareMap::Device& place) {
  const sc_core::sc_object* object = sc_core::sc_find_object(place.path.c_str());
  const bool is_part = dynamic_cast<const vp::RegisterBank*>(object) ||
                       dynamic_cast<const axi::TlmToPins*>(object) ||
                       dynamic_cast<const xilinx::RegisterStub::Slave*>(object);
  return is_part ? object->get_parent_object() : object;
}

/// Its IP and version, by the design's file, by its driver, or by its name.
void name_ip(PlDevice& device, Zynq& zynq, const sc_core::sc_object* module,
             const xparameters::Device& build) {
  const auto* design = dynamic_cast<const block_design::BlockDesign*>(&zynq.pl());
  const block_design::PlacedPart* part =
      design && module ? design->file().part(module->basename()) : nullptr;
  const std::vector<std::string> vlnv = split(part ? part->vlnv : "", ':');
  const std::size_t dash = build.compatible.rfind('-');
  device.is_vendors = !build.compatible.empty();
  if (vlnv.size() == 4) {
    device.ip = vlnv[2];
    device.version = vlnv[3];
    device.is_vendors = vlnv[0] == "xilinx.com" && vlnv[1] == "ip";
  } else if (dash != std::string::npos && std::isdigit(build.compatible.back()) != 0) {
    device.ip = build.compatible.substr(build.compatible.find(',') + 1, dash - 5);
    std::replace(device.ip.begin(), device.ip.end(), '-', '_');
    device.version = build.compatible.substr(dash + 1);
  } else {
    device.ip = device.label.substr(0, device.label.find_last_not_of("0123456789") + 1);
    while (!device.ip.empty() && device.ip.back() == '_') device.ip.pop_back();
    device.version = "1.0";
  }
}

/// In the order of its pins' names, as the vendor's generator has them.
void add_interrupts(PlDevice& device, Zynq& zynq, const HardwareMap& map,
                    const sc_core::sc_object& module) {
  device.controller = "intc";
  for (const HardwareMap::Interrupt& interrupt : map.interrupts) {
    const sc_core::sc_object* line = sc_core::sc_find_object(interrupt.source.c_str());
    if (line && line->get_parent_object() == &module)
      device.interrupts.push_back({line->basename(), device_tree::shared_interrupt(interrupt.id)});
  }
  if (device.interrupts.empty()) {
    for (const xparameters::FabricInterrupt& line : fabric_interrupts(zynq, module)) {
      constexpr std::uint32_t level_high = 2;  // of xlnx,xps-intc-1.00.a
      if (!device.interrupts.empty() && vp::lower(line.controller) != device.controller) continue;
      device.controller = vp::lower(line.controller);
      device.interrupts.push_back({vp::lower(line.line), {line.number, level_high}});
    }
  }
  std::sort(device.interrupts.begin(), device.interrupts.end(),
            [](const auto& a, const auto& b) { return a.pin < b.pin; });
}

void add_clock(PlDevice& device, Zynq& zynq, const sc_core::sc_object& module) {
  const auto* clocked = dynamic_cast<const vp::Clocked*>(&module);
  if (!clocked) return;
  for (const auto& [number, source] : zynq.ps.fclks()) {
    if (&source->clk == &clocked->clock())
      device.clocks.emplace_back("s_axi_aclk", device_tree::fclk_output(number));
  }
}

std::vector<PlDevice> pl_devices(Zynq& zynq, const HardwareMap& map) {
  std::vector<PlDevice> devices;
  for (const HardwareMap::Device& place : map.devices) {
    if (place.way.rfind("m_axi_gp", 0) != 0) continue;
    PlDevice device{place.name};
    device.base = place.base;
    device.size = place.size;
    const sc_core::sc_object* module = module_at(place);
    xparameters::Device build{};
    if (module) {
      xparameters::add_build(build, *module);
      add_interrupts(device, zynq, map, *module);
      add_clock(device, zynq, *module);
    }
    name_ip(device, zynq, module, build);
    // Canonical names that keep small letters say the same again.
    for (const auto& [option, value] : build.options)
      if (std::islower(option.front()) == 0) device.options.emplace_back(option, value);
    devices.push_back(std::move(device));
  }
  return devices;
}

Node cpus() {
  Node node{"cpus"};
  node.properties = {device_tree::numbers("#address-cells", {1}),
                     device_tree::numbers("#size-cells", {0})};
  for (const std::uint32_t number : {0u, 1u}) {
    Node cpu{"cpu@" + std::to_string(number), "cpu" + std::to_string(number)};
    cpu.properties = {device_tree::texts("compatible", {"arm,cortex-a9"}),
                      device_tree::texts("device_type", {"cpu"}),
                      device_tree::numbers("reg", {number}),
                      device_tree::references("clocks", {{"clkc", 3}})};
    node.children.push_back(std::move(cpu));
  }
  return node;
}

/// The console is the UART with the highest number that there is, as in xparameters.h.
Node aliases(const ProcessingSystem& ps) {
  Node node{"aliases"};
  if (ps.uart1.enabled)
    node.properties.push_back(device_tree::texts("serial0", {"/axi/serial@e0001000"}));
  if (ps.uart0.enabled)
    node.properties.push_back(
        device_tree::texts(ps.uart1.enabled ? "serial1" : "serial0", {"/axi/serial@e0000000"}));
  return node;
}

}  // namespace

Node hardware_tree(Zynq& zynq) {
  const HardwareMap map = hardware_map(zynq);
  Node root{"/"};
  root.properties = {device_tree::numbers("#address-cells", {1}),
                     device_tree::numbers("#size-cells", {1}),
                     device_tree::texts("compatible", {"xlnx,zynq-7000"}),
                     device_tree::texts("model", {"Zynq-7000 of markervp"})};
  Node chosen{"chosen"};
  chosen.properties = {device_tree::texts("bootargs", {"console=ttyPS0,115200"}),
                       device_tree::texts("stdout-path", {"serial0:115200n8"})};
  Node memory{"memory@0"};
  memory.properties = {
      device_tree::texts("device_type", {"memory"}),
      device_tree::hex_numbers("reg", {0, static_cast<std::uint32_t>(zynq.ps.ddr.end())})};
  root.children = {
      std::move(chosen), aliases(zynq.ps),  cpus(),
      std::move(memory), ps_bus(zynq, map), device_tree::pl_bus(pl_devices(zynq, map))};
  return root;
}

}  // namespace platform
