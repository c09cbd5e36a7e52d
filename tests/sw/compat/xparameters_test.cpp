// xparameters.h is what the generator writes for the platform as it is built.
#include <boost/test/unit_test.hpp>

#include <drivers/global_timer.h>
#include <drivers/platform_addresses.h>
#include <vp/configuration.h>
#include <xparameters_writer.h>
#include <zynq/session.h>

#include <algorithm>
#include <cctype>

#include "simulation.h"
#include "temporary_files.h"

namespace {

using xparameters::Device;

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

Device device(const platform::Zynq& zynq, const std::string& name, const std::string& driver) {
  for (const auto& region : zynq.pl.axi_interconnect.regions()) {
    if (region.name != name) continue;
    return {capitals(name),
            driver,
            static_cast<std::uint32_t>(region.base),
            static_cast<std::uint32_t>(region.last()),
            {},
            {}};
  }
  throw std::runtime_error("no device " + name);
}

Device dma(const platform::Zynq& zynq, const std::string& name, const xilinx::AxiDma& model,
           std::uint32_t interrupt) {
  Device result = device(zynq, name, "AXIDMA");
  const bool sends = model.include_mm2s;
  result.options = {{"INCLUDE_MM2S", sends},
                    {"INCLUDE_S2MM", model.include_s2mm.get()},
                    {"INCLUDE_SG", 0},
                    {"SG_LENGTH_WIDTH", model.length_width},
                    {"M_AXI_MM2S_DATA_WIDTH", 32},
                    {"M_AXI_S2MM_DATA_WIDTH", 32}};
  result.interrupts = {{sends ? "MM2S_INTROUT" : "S2MM_INTROUT", interrupt}};
  return result;
}

Device gpio(const platform::Zynq& zynq, const std::string& name, const xilinx::AxiGpio& model) {
  Device result = device(zynq, name, "GPIO");
  result.options = {{"IS_DUAL", model.is_dual.get()},
                    {"INTERRUPT_PRESENT", model.interrupt_present.get()}};
  return result;
}

xparameters::Platform describe(const platform::Zynq& zynq) {
  xparameters::Platform platform;
  // What Vivado states for its 666.67 MHz; the driver's value is half of it.
  platform.cpu_hz = 2 * drivers::GlobalTimer::counts_per_second + 1;
  platform.ps_clock_hz = 33'333'333;
  platform.ddr_base = ps::Ddr::base;
  platform.ddr_last = static_cast<std::uint32_t>(zynq.ps.ddr.end() - 1);
  platform.console_uart = 0xE000'1000;
  platform.devices = {
      dma(zynq, "axi_dma_0", zynq.pl.axi_dma_0, drivers::addresses::dma_image_interrupt),
      dma(zynq, "axi_dma_1", zynq.pl.axi_dma_1, drivers::addresses::dma_binary_interrupt),
      gpio(zynq, "axi_gpio_0", zynq.pl.axi_gpio_0), gpio(zynq, "axi_gpio_1", zynq.pl.axi_gpio_1)};
  return platform;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(xparameters_header)

BOOST_AUTO_TEST_CASE(is_that_of_the_platform) {
  const kit::Simulation context;
  vp::Configuration configuration;
  const vp::Configuration::Scope scope(configuration);
  platform::Session session({MARKERVP_HYBRID, std::nullopt});
  BOOST_CHECK_EQUAL(kit::read_file(MARKERVP_XPARAMETERS),
                    xparameters::header(describe(session.zynq())));
  BOOST_CHECK_EQUAL(session.zynq().pl.axi_interconnect.regions().size(), 4);
}

// Each driver counts its own devices.
BOOST_AUTO_TEST_CASE(numbers_follow_the_order) {
  xparameters::Platform platform{1, 1, 0, 0, 0, {}};
  platform.devices = {{"LEDS", "GPIO", 0x4000'0000, 0x4000'FFFF, {}, {}},
                      {"COPY", "AXIDMA", 0x4001'0000, 0x4001'FFFF, {}, {{"MM2S_INTROUT", 63}}},
                      {"KEYS", "GPIO", 0x4002'0000, 0x4002'FFFF, {{"IS_DUAL", 1}}, {}}};
  const std::string text = xparameters::header(platform);
  for (const char* line : {"XPAR_LEDS_DEVICE_ID 0", "XPAR_KEYS_DEVICE_ID 1",
                           "XPAR_COPY_DEVICE_ID 0", "XPAR_GPIO_1_BASEADDR 0x40020000U",
                           "XPAR_GPIO_1_IS_DUAL 1", "XPAR_FABRIC_COPY_MM2S_INTROUT_INTR 63",
                           "XPAR_XGPIO_NUM_INSTANCES 2", "XPAR_XAXIDMA_NUM_INSTANCES 1"}) {
    BOOST_CHECK_MESSAGE(text.find(std::string("#define ") + line + "\n") != std::string::npos,
                        line);
  }
}

BOOST_AUTO_TEST_SUITE_END()
