#include <zynq/xparameters.h>

#include <xparameters_writer.h>
#include <algorithm>
#include <cctype>

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

Device device(const HardwareMap& map, const std::string& name, const std::string& driver) {
  const auto found = std::find_if(map.devices.begin(), map.devices.end(),
                                  [&](const auto& candidate) { return candidate.name == name; });
  return {capitals(name),
          driver,
          static_cast<std::uint32_t>(found->base),
          static_cast<std::uint32_t>(found->base + found->size - 1),
          {},
          {}};
}

std::uint32_t interrupt(const HardwareMap& map, const std::string& source) {
  const auto found =
      std::find_if(map.interrupts.begin(), map.interrupts.end(),
                   [&](const auto& candidate) { return candidate.source == source; });
  return found->id;
}

Device dma(const HardwareMap& map, const std::string& name, const xilinx::AxiDma& model) {
  Device result = device(map, name, "AXIDMA");
  const bool sends = model.include_mm2s;
  result.options = {{"INCLUDE_MM2S", sends},
                    {"INCLUDE_S2MM", model.include_s2mm.get()},
                    {"INCLUDE_SG", 0},
                    {"SG_LENGTH_WIDTH", model.length_width},
                    {"M_AXI_MM2S_DATA_WIDTH", 32},
                    {"M_AXI_S2MM_DATA_WIDTH", 32}};
  const std::string line = sends ? "mm2s_introut" : "s2mm_introut";
  result.interrupts = {{capitals(line), interrupt(map, std::string(model.name()) + "." + line)}};
  return result;
}

Device gpio(const HardwareMap& map, const std::string& name, const xilinx::AxiGpio& model) {
  Device result = device(map, name, "GPIO");
  result.options = {{"IS_DUAL", model.is_dual.get()},
                    {"INTERRUPT_PRESENT", model.interrupt_present.get()}};
  return result;
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
  platform.devices = {
      dma(map, "axi_dma_0", zynq.pl.axi_dma_0), dma(map, "axi_dma_1", zynq.pl.axi_dma_1),
      gpio(map, "axi_gpio_0", zynq.pl.axi_gpio_0), gpio(map, "axi_gpio_1", zynq.pl.axi_gpio_1)};
  return xparameters::header(platform);
}

}  // namespace platform
