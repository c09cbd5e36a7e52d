#include <zynq/xparameters.h>

#include <vp/hierarchy.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xparameters_writer.h>
#include <algorithm>
#include <cctype>
#include <optional>
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

/// The device whose registers `bank` are, where software can reach it.
std::optional<Device> device(const HardwareMap& map, const vp::RegisterBank& bank,
                             const std::string& driver) {
  for (const HardwareMap::Device& found : map.devices) {
    if (found.path != bank.name()) continue;
    return Device{capitals(found.name),
                  driver,
                  static_cast<std::uint32_t>(found.base),
                  static_cast<std::uint32_t>(found.base + found.size - 1),
                  {},
                  {}};
  }
  return std::nullopt;
}

void add_interrupt(Device& device, const HardwareMap& map, const vp::Signal<bool>& source) {
  for (const auto& interrupt : map.interrupts) {
    if (interrupt.source == source.name())
      device.interrupts.emplace_back(capitals(source.basename()), interrupt.id);
  }
}

void add_dma(std::vector<Device>& devices, const HardwareMap& map, const xilinx::AxiDma& model) {
  std::optional<Device> found = device(map, model.s_axi_lite, "AXIDMA");
  if (!found) return;
  found->options = {{"INCLUDE_MM2S", model.include_mm2s.get()},
                    {"INCLUDE_S2MM", model.include_s2mm.get()},
                    {"INCLUDE_SG", 0},
                    {"SG_LENGTH_WIDTH", model.length_width},
                    {"M_AXI_MM2S_DATA_WIDTH", 32},
                    {"M_AXI_S2MM_DATA_WIDTH", 32}};
  add_interrupt(*found, map, model.mm2s_introut);
  add_interrupt(*found, map, model.s2mm_introut);
  devices.push_back(*std::move(found));
}

void add_gpio(std::vector<Device>& devices, const HardwareMap& map, const xilinx::AxiGpio& model) {
  std::optional<Device> found = device(map, model.s_axi, "GPIO");
  if (!found) return;
  found->options = {{"IS_DUAL", model.is_dual.get()},
                    {"INTERRUPT_PRESENT", model.interrupt_present.get()}};
  devices.push_back(*std::move(found));
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
  for (const auto* dma : vp::all_below<xilinx::AxiDma>(zynq.pl()))
    add_dma(platform.devices, map, *dma);
  for (const auto* gpio : vp::all_below<xilinx::AxiGpio>(zynq.pl()))
    add_gpio(platform.devices, map, *gpio);
  return xparameters::header(platform);
}

}  // namespace platform
