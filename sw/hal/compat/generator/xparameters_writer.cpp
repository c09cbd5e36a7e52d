#include <xparameters_writer.h>

#include <cstdio>
#include <map>

namespace xparameters {
namespace {

/// The lines "#define NAME value", all beginning with XPAR_.
class Definitions {
 public:
  void number(const std::string& name, std::uint64_t value) { line(name, std::to_string(value)); }

  void address(const std::string& name, std::uint32_t value) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "0x%08XU", static_cast<unsigned>(value));
    line(name, digits);
  }

  void line(const std::string& name, const std::string& value) {
    text += "#define XPAR_" + name + " " + value + "\n";
  }

  std::string text;
};

/// Both under the instance's name and under that of the driver: code uses either.
void define_device(Definitions& out, const Device& device, unsigned number) {
  out.text += "\n/* " + device.name + " */\n";
  const bool has_driver = !device.driver.empty();
  std::vector<std::string> names{device.name};
  if (has_driver) names.push_back(device.driver + "_" + std::to_string(number));
  for (const std::string& name : names) {
    if (has_driver) out.number(name + "_DEVICE_ID", number);
    out.address(name + "_BASEADDR", device.base);
    out.address(name + "_HIGHADDR", device.last);
    for (const auto& [option, value] : device.options) out.number(name + "_" + option, value);
  }
  for (const auto& [line, id] : device.interrupts) {
    out.number("FABRIC_" + device.name + "_" + line + "_INTR", id);
  }
}

constexpr const char* beginning =
    "#ifndef XPARAMETERS_H\n"
    "#define XPARAMETERS_H\n"
    "\n"
    "/*\n"
    " * Written from the memory map of the platform: what Vivado would export for it. A test "
    "holds\n"
    " * the two together.\n"
    " */\n";

/// The private devices of the Cortex-A9 MPCore are where they are (UG585 table 4-7).
constexpr const char* processor_devices =
    "\n/* Cortex-A9 MPCore */\n"
    "#define XPAR_PS7_SCUGIC_0_DEVICE_ID 0\n"
    "#define XPAR_SCUGIC_0_DEVICE_ID 0\n"
    "#define XPAR_SCUGIC_SINGLE_DEVICE_ID 0\n"
    "#define XPAR_SCUGIC_0_CPU_BASEADDR 0xF8F00100U\n"
    "#define XPAR_SCUGIC_0_DIST_BASEADDR 0xF8F01000U\n"
    "#define XPAR_GLOBAL_TMR_BASEADDR 0xF8F00200U\n"
    "#define XPAR_GLOBAL_TMR_INTR 27\n"
    "#define XPAR_SCUTIMER_0_BASEADDR 0xF8F00600U\n"
    "#define XPAR_SCUTIMER_INTR 29\n"
    "#define XPAR_PS7_SLCR_0_S_AXI_BASEADDR 0xF8000000U\n";

}  // namespace

std::string header(const Platform& platform) {
  Definitions out;
  out.text = beginning;
  out.text += "\n/* Clocks, Hz */\n";
  out.number("CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ", platform.cpu_hz);
  out.number("CPU_CORTEXA9_0_CPU_CLK_FREQ_HZ", platform.cpu_hz);
  out.number("PS7_CRYSTAL_FREQ_HZ", platform.ps_clock_hz);
  out.text += "\n/* Memory */\n";
  out.address("PS7_DDR_0_S_AXI_BASEADDR", platform.ddr_base);
  out.address("PS7_DDR_0_S_AXI_HIGHADDR", platform.ddr_last);
  out.text += processor_devices;
  std::map<std::string, unsigned> numbers;
  for (const Device& device : platform.devices) {
    define_device(out, device, numbers[device.driver]++);
  }
  out.text += "\n/* How many a driver has */\n";
  for (const auto& [driver, count] : numbers) {
    if (!driver.empty()) out.number("X" + driver + "_NUM_INSTANCES", count);
  }
  out.text += "\n/* Console */\n#define STDOUT_BASEADDRESS ";
  char digits[16];
  std::snprintf(digits, sizeof digits, "0x%08XU\n", static_cast<unsigned>(platform.console_uart));
  out.text += digits;
  out.text += "\n#endif\n";
  return out.text;
}

}  // namespace xparameters
