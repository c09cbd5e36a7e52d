// xparameters.h is what the platform writes for the platform as it is built.
#include <boost/test/unit_test.hpp>

#include <chip/run/simulation.h>
#include <chip/system/designs.h>
#include <chip/system/hardware_map.h>
#include <drivers/timers.h>
#include <uart_registers.h>
#include <vp/configuration.h>

#include <set>
#include <sstream>
#include <string>

#include "simulation.h"
#include "temporary_files.h"

BOOST_AUTO_TEST_SUITE(xparameters_header)

BOOST_AUTO_TEST_CASE(is_that_of_the_platform) {
  const kit::Simulation context;
  vp::Configuration configuration;
  const vp::Configuration::Scope scope(configuration);
  platform::Simulation simulation({MARKERVP_HYBRID});
  const std::string text = platform::hardware_map(simulation.zynq()).xparameters;
  BOOST_CHECK_EQUAL(kit::read_file(MARKERVP_XPARAMETERS), text);
  // The driver's constant is half of it.
  const auto counts = std::to_string(2 * drivers::GlobalTimer::counts_per_second + 1);
  BOOST_CHECK(text.find("CPU_CLK_FREQ_HZ " + counts + "\n") != std::string::npos);
  BOOST_CHECK_EQUAL(simulation.zynq().ports.registers()->regions().size(), 4);
}

// `markervp map --xparameters`: the configuration in use, not the default one.
BOOST_AUTO_TEST_CASE(follows_the_configuration) {
  const kit::Simulation context;
  vp::Configuration configuration;
  configuration.set("ps.cpu_clk.frequency=866 MHz");
  configuration.set("clocks=exact");
  configuration.set("ps.ddr.size=383 MiB");
  configuration.set("pl.axi_dma_0.length_width=20");
  configuration.set("pl.axi_gpio_1.base_address=0x7FFF0000");
  configuration.set("pl.axi_dma_1.s2mm_introut_id=91");
  const vp::Configuration::Scope scope(configuration);
  platform::Zynq zynq{*platform::builtin_designs().front()};
  const std::string text = platform::hardware_map(zynq).xparameters;
  for (const char* line :
       {"XPAR_CPU_CORTEXA9_0_CPU_CLK_FREQ_HZ 866000000",
        "XPAR_PS7_DDR_0_S_AXI_HIGHADDR 0x17FFFFFFU", "XPAR_AXI_DMA_0_SG_LENGTH_WIDTH 20",
        "XPAR_AXI_DMA_1_SG_LENGTH_WIDTH 14", "XPAR_GPIO_1_BASEADDR 0x7FFF0000U",
        "XPAR_AXI_GPIO_1_HIGHADDR 0x7FFFFFFFU", "XPAR_FABRIC_AXI_DMA_0_MM2S_INTROUT_INTR 61",
        "XPAR_FABRIC_AXI_DMA_1_S2MM_INTROUT_INTR 91"}) {
    BOOST_CHECK_MESSAGE(text.find(std::string("#define ") + line + "\n") != std::string::npos,
                        line << " in " << text);
  }
}

// On most boards UART 1 is the only one: it is the vendor's number 0, with the interrupt of UART 1.
BOOST_AUTO_TEST_CASE(uarts_that_a_board_has) {
  const kit::Simulation context;
  vp::Configuration configuration;
  configuration.set("ps.uart0.enabled=false");
  const vp::Configuration::Scope scope(configuration);
  platform::Zynq zynq{*platform::builtin_designs().front()};
  const std::string text = platform::hardware_map(zynq).xparameters;
  for (const char* line : {"XPAR_XUARTPS_0_BASEADDR 0xE0001000U", "XPAR_XUARTPS_NUM_INSTANCES 1",
                           "XPAR_XUARTPS_0_INTERRUPTS 0x4032", "XPAR_PS7_UART_1_DEVICE_ID 0",
                           "STDOUT_BASEADDRESS 0xE0001000U"}) {
    BOOST_CHECK_MESSAGE(text.find(std::string("#define ") + line + "\n") != std::string::npos,
                        line);
  }
  BOOST_CHECK(text.find("XPAR_XUARTPS_1") == std::string::npos);
  xparameters::Platform none{1, 1, 0, 0, {}, {}};
  BOOST_CHECK(xparameters::header(none).find("STDOUT") == std::string::npos);
}

// Each driver counts its own devices.
BOOST_AUTO_TEST_CASE(numbers_follow_the_order) {
  xparameters::Platform platform{1, 1, 0, 0, {}, {}};
  platform.devices = {{"LEDS", "GPIO", 0x4000'0000, 0x4000'FFFF, {}, {}},
                      {"COPY", "AXIDMA", 0x4001'0000, 0x4001'FFFF, {}, {{"MM2S_INTROUT", 63}}},
                      {"KEYS", "GPIO", 0x4002'0000, 0x4002'FFFF, {{"IS_DUAL", 1}}, {}},
                      {"OWN", "", 0x4003'0000, 0x4003'FFFF, {}, {{"IRQ", 64}}}};
  const std::string text = xparameters::header(platform);
  BOOST_CHECK(text.find("XPAR_OWN_DEVICE_ID") == std::string::npos);
  BOOST_CHECK(text.find("XPAR_X_NUM") == std::string::npos);
  for (const char* line :
       {"XPAR_OWN_BASEADDR 0x40030000U", "XPAR_FABRIC_OWN_IRQ_INTR 64", "XPAR_LEDS_DEVICE_ID 0",
        "XPAR_KEYS_DEVICE_ID 1", "XPAR_COPY_DEVICE_ID 0", "XPAR_GPIO_1_BASEADDR 0x40020000U",
        "XPAR_GPIO_1_IS_DUAL 1", "XPAR_FABRIC_COPY_MM2S_INTROUT_INTR 63",
        "XPAR_XGPIO_NUM_INSTANCES 2", "XPAR_XGPIO_1_BASEADDR 0x40020000U",
        "XPAR_XAXIDMA_0_INTERRUPTS 0x401f", "XPAR_XAXIDMA_0_INTERRUPT_PARENT 0xF8F01000U",
        "XPAR_FABRIC_COPY_INTR 31", "XPAR_XAXIDMA_NUM_INSTANCES 1"}) {
    BOOST_CHECK_MESSAGE(text.find(std::string("#define ") + line + "\n") != std::string::npos,
                        line);
  }
}

// Programs ask by name: what is kept from platform to platform is what the header says of each.
BOOST_AUTO_TEST_CASE(names_have_the_values_of_the_header) {
  xparameters::Platform platform{666'666'687, 33'333'333, 0x0010'0000, 0x1FFF'FFFF, {}, {}};
  platform.devices = {{"LEDS", "GPIO", 0x4000'0000, 0x4000'FFFF, {{"IS_DUAL", 1}}, {}}};
  const auto first = xparameters::values(platform);
  BOOST_TEST(first->at("LEDS_BASEADDR") == 0x4000'0000u);
  BOOST_TEST(first->at("GPIO_0_IS_DUAL") == 1u);
  BOOST_TEST(first->at("CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ") == 666'666'687u);
  BOOST_TEST(first->count("LEDS_NONE") == 0u);
  BOOST_TEST(xparameters::values(platform) == first);
  for (std::uint32_t base = 0x4100'0000; base < 0x4120'0000; base += 0x1'0000) {  // more than kept
    platform.devices[0].base = base;
    BOOST_TEST(xparameters::values(platform)->at("LEDS_BASEADDR") == base);
  }
  platform.devices[0].options[0].second = 0;
  BOOST_TEST(xparameters::values(platform)->at("GPIO_0_IS_DUAL") == 0u);
  platform.cpu_hz = 1;
  BOOST_TEST(xparameters::values(platform)->at("CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ") == 1u);
}

// The names that nine of ten headers of real projects have, and those of SDT, each with its value.
BOOST_AUTO_TEST_CASE(names_of_the_processing_system) {
  const xparameters::Platform platform{666'666'687, 33'333'333,         0x0010'0000,
                                       0x1FFF'FFFF, {uart::uart1_base}, {}};
  const std::string text = xparameters::header(platform);
  for (const char* line : {"XPAR_PS7_CORTEXA9_0_CPU_CLK_FREQ_HZ 666666687",
                           "XPAR_PS7_SCUGIC_0_DIST_BASEADDR 0xF8F01000U",
                           "XPAR_XTTCPS_4_BASEADDR 0xF8002004U",
                           "XPAR_PS7_TTC_0_TTC_CLK_FREQ_HZ 111111114",
                           "XPAR_XGPIOPS_0_DEVICE_ID 0",
                           "XPAR_PS7_I2C_1_HIGHADDR 0xE0005FFFU",
                           "XPAR_XADCPS_0_BASEADDR 0xF8007100U",
                           "XPAR_XDCFG_0_BASEADDR 0xF8007000U",
                           "XPAR_SCUWDT_0_BASEADDR 0xF8F00620U",
                           "XPAR_PS7_RAM_1_S_AXI_BASEADDR 0xFFFC0000U",
                           "XPAR_PS7_PMU_0_PMU1_S_AXI_BASEADDR 0xF8893000U",
                           "XPAR_XTTCPS_NUM_INSTANCES 6",
                           "XPAR_SCUTIMER_INTERRUPTS 0x13100d",
                           "XPAR_XSCUWDT_0_INTERRUPTS 0x10400e",
                           "XPAR_GPIO0_INTERRUPTS 0x4014",
                           "XPAR_WATCHDOG0_INTERRUPTS 0x1009",
                           "XPAR_TTC0_INTERRUPTS_2 0x400c",
                           "XPAR_XXADCPS_0_BASEADDR 0xF8007100U",
                           "XPAR_PS7_RAM_1_HIGHADDRESS 0xFFFFFDFFU",
                           "XPAR_CPU_CORE_CLOCK_FREQ_HZ 666666687",
                           "STDIN_BASEADDRESS 0xE0001000U",
                           "PLATFORM_ZYNQ"}) {
    BOOST_CHECK_MESSAGE(text.find(std::string("#define ") + line + "\n") != std::string::npos,
                        line);
  }
}

// A name has one value in each flow: a compiler would warn of another.
BOOST_AUTO_TEST_CASE(no_name_is_defined_twice) {
  const xparameters::Platform platform{1, 1, 0, 0, {uart::uart0_base, uart::uart1_base}, {}};
  std::istringstream lines(xparameters::header(platform));
  std::set<std::string> classic, sdt;
  unsigned flows = 3;
  for (std::string line; std::getline(lines, line);) {
    if (line == "#ifndef SDT") flows = 1;
    if (line == "#ifdef SDT" || line.rfind("#if defined SDT", 0) == 0) flows = 2;
    if (line == "#endif") flows = 3;
    if (line.rfind("#define ", 0) != 0) continue;
    const std::string name = line.substr(8, line.find(' ', 8) - 8);
    if (flows & 1) BOOST_CHECK_MESSAGE(classic.insert(name).second, name);
    if (flows & 2) BOOST_CHECK_MESSAGE(sdt.insert(name).second, name);
  }
  BOOST_CHECK(sdt.count("XPAR_XGPIOPS_0_DEVICE_ID") == 0 &&
              classic.count("XPAR_GPIO0_BASEADDR") == 0);
}

BOOST_AUTO_TEST_SUITE_END()
