#include <zynq/xparameters.h>

#include <vp/hierarchy.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xparameters_writer.h>
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace platform {

namespace {

using report::HardwareMap;
using xparameters::Device;

/// What Vivado states for the 666,666,667 Hz of a ZedBoard: it multiplies 33.333333 MHz.
constexpr std::uint64_t usual_cpu_hz = 666'666'667, vivado_cpu_hz = 666'666'687;
/// The boards' console.
constexpr std::uint32_t console_uart = 0xE000'1000;

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The driver of a device, by its model; "" without one of the vendor's.
void add_build(Device& device, const sc_core::sc_object& module) {
  if (const auto* dma = dynamic_cast<const xilinx::AxiDma*>(&module)) {
    device.driver = "AXIDMA";
    device.options = {{"INCLUDE_MM2S", dma->include_mm2s.get()},
                      {"INCLUDE_S2MM", dma->include_s2mm.get()},
                      {"INCLUDE_SG", 0},
                      {"SG_LENGTH_WIDTH", dma->length_width},
                      {"M_AXI_MM2S_DATA_WIDTH", 32},
                      {"M_AXI_S2MM_DATA_WIDTH", 32}};
  } else if (const auto* gpio = dynamic_cast<const xilinx::AxiGpio*>(&module)) {
    device.driver = "GPIO";
    device.options = {{"IS_DUAL", gpio->is_dual.get()},
                      {"INTERRUPT_PRESENT", gpio->interrupt_present.get()}};
  }
}

Device exported(const HardwareMap& map, const vp::RegisterBank& bank,
                const HardwareMap::Device& place) {
  const sc_core::sc_object& module = *bank.get_parent_object();
  Device device{capitals(place.name),
                {},
                static_cast<std::uint32_t>(place.base),
                static_cast<std::uint32_t>(place.base + place.size - 1),
                {},
                {}};
  add_build(device, module);
  for (const auto& interrupt : map.interrupts) {
    const sc_core::sc_object* line = sc_core::sc_find_object(interrupt.source.c_str());
    if (line && line->get_parent_object() == &module)
      device.interrupts.emplace_back(capitals(line->basename()), interrupt.id);
  }
  return device;
}

}  // namespace

std::string xparameters_header(const Zynq& zynq, const HardwareMap& map) {
  xparameters::Platform platform;
  const std::uint64_t cpu_hz = zynq.ps.cpu_clk.clk.frequency_hz();
  platform.cpu_hz = cpu_hz == usual_cpu_hz ? vivado_cpu_hz : cpu_hz;
  platform.ps_clock_hz = static_cast<std::uint64_t>(zynq.ps.slcr.ps_clk.get());
  platform.ddr_base = ps::Ddr::base;
  platform.ddr_last = static_cast<std::uint32_t>(zynq.ps.ddr.end() - 1);
  platform.console_uart = console_uart;
  // Those that software can reach, in the order in which drivers number them.
  for (const auto* bank : vp::all_below<vp::RegisterBank>(zynq.pl())) {
    for (const HardwareMap::Device& place : map.devices) {
      if (place.path == bank->name()) platform.devices.push_back(exported(map, *bank, place));
    }
  }
  std::stable_sort(platform.devices.begin(), platform.devices.end(),
                   [](const Device& a, const Device& b) { return a.driver < b.driver; });
  return xparameters::header(platform);
}

}  // namespace platform
