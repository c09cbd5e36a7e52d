#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <chip/system/xparameters.h>
#include <chip/system/xparameters_text.h>
#include <devcfg_registers.h>
#include <gem_registers.h>
#include <gic_registers.h>
#include <ps_gpio_registers.h>
#include <ps_i2c_registers.h>
#include <ps_spi_registers.h>
#include <ps_xadc_registers.h>
#include <qspi_registers.h>
#include <sdio_registers.h>
#include <system_watchdog_registers.h>
#include <ttc_registers.h>
#include <uart_registers.h>
#include <usb_registers.h>

namespace xparameters {

namespace {

/// What Vivado states for clocks of 50, 125, 166.67 and 200 MHz. CPU_1x is a sixth of the CPU's.
constexpr std::uint32_t uart_hz = 50'000'000, sdio_hz = 50'000'000, qspi_hz = 200'000'000,
                        spi_hz = 166'666'672, enet_hz = 125'000'000;
constexpr unsigned cpu_cycles_per_1x = 6;

/// A device of the processing system, in the names of both flows.
struct Block {
  std::string instance;    ///< classic: "PS7_UART_0"
  std::string driver;      ///< classic: "XUARTPS"
  std::string label;       ///< SDT: "UART0"; empty: it has another entry there
  std::string sdt_driver;  ///< "XUARTPS"
  std::string compatible;
  std::uint32_t base, last;
  std::vector<std::uint32_t> interrupts;
  Options options, sdt_options;
};

std::string numbered(const char* name, unsigned number) {
  return name + std::to_string(number);
}

void add_serial(std::vector<Block>& list, std::uint64_t cpu_hz,
                const std::vector<std::uint32_t>& uarts) {
  for (const std::uint32_t base : uarts) {
    const unsigned n = base == uart::uart0_base ? 0 : 1;
    list.push_back({numbered("PS7_UART_", n),
                    "XUARTPS",
                    numbered("UART", n),
                    "XUARTPS",
                    "xlnx,xuartps",
                    base,
                    base + 0xFFF,
                    {n == 0 ? uart::uart0_interrupt : uart::uart1_interrupt},
                    {{"UART_CLK_FREQ_HZ", uart_hz}, {"HAS_MODEM", 0}},
                    {{"CLOCK_FREQ", uart_hz}, {"CLOCKS", 0x17 + n}, {"HAS_MODEM", 0}}});
  }
  const auto cpu_1x_hz = static_cast<std::uint32_t>(cpu_hz / cpu_cycles_per_1x);
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t base = n == 0 ? ps_i2c::i2c0_base : ps_i2c::i2c1_base;
    list.push_back({numbered("PS7_I2C_", n),
                    "XIICPS",
                    numbered("I2C", n),
                    "XIICPS",
                    "cdns,i2c-r1p10",
                    base,
                    base + 0xFFF,
                    {n == 0 ? ps_i2c::i2c0_interrupt : ps_i2c::i2c1_interrupt},
                    {{"I2C_CLK_FREQ_HZ", cpu_1x_hz}},
                    {{"CLOCK_FREQ", cpu_1x_hz}}});
  }
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t base = n == 0 ? ps_spi::spi0_base : ps_spi::spi1_base;
    list.push_back({numbered("PS7_SPI_", n),
                    "XSPIPS",
                    numbered("SPI", n),
                    "XSPIPS",
                    "xlnx,zynq-spi-r1p6",
                    base,
                    base + 0xFFF,
                    {n == 0 ? ps_spi::spi0_interrupt : ps_spi::spi1_interrupt},
                    {{"SPI_CLK_FREQ_HZ", spi_hz}},
                    {{"CLOCK_FREQ", spi_hz}}});
  }
}

/// Classic: a device a counter. SDT: one a block.
void add_timers(std::vector<Block>& list, std::uint64_t cpu_hz) {
  const auto cpu_1x_hz = static_cast<std::uint32_t>(cpu_hz / cpu_cycles_per_1x);
  for (unsigned n = 0; n < 2 * ttc::counter_count; ++n) {
    const bool second = n >= ttc::counter_count;
    const unsigned counter = n % ttc::counter_count;
    const std::uint32_t base =
        (second ? ttc::ttc1_base : ttc::ttc0_base) + counter * ttc::counter_stride;
    list.push_back({numbered("PS7_TTC_", n),
                    "XTTCPS",
                    "",
                    "",
                    "",
                    base,
                    0,
                    {},
                    {{"TTC_CLK_FREQ_HZ", cpu_1x_hz}, {"TTC_CLK_CLKSRC", 0}},
                    {}});
  }
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t base = n == 0 ? ttc::ttc0_base : ttc::ttc1_base;
    const std::uint32_t first = n == 0 ? ttc::ttc0_interrupt : ttc::ttc1_interrupt;
    list.push_back({"",
                    "",
                    numbered("TTC", n),
                    "XTTCPS",
                    "cdns,ttc",
                    base,
                    base + 0xFFF,
                    {first, first + 1, first + 2},
                    {},
                    {{"CLOCK_FREQ", cpu_1x_hz}}});
  }
  list.push_back({"PS7_SCUTIMER_0",
                  "XSCUTIMER",
                  "SCUTIMER",
                  "XSCUTIMER",
                  "arm,cortex-a9-twd-timer",
                  0xF8F00600,
                  0xF8F0061F,
                  {gic::private_timer_id},
                  {},
                  {}});
  list.push_back({"PS7_SCUWDT_0",
                  "SCUWDT",
                  "SCUWDT",
                  "XSCUWDT",
                  "arm,cortex-a9-twd-wdt",
                  0xF8F00620,
                  0xF8F006FF,
                  {gic::watchdog_id},
                  {},
                  {}});
  list.push_back({"PS7_WDT_0",
                  "XWDTPS",
                  "WATCHDOG0",
                  "XWDTPS",
                  "cdns,wdt-r1p2",
                  system_watchdog::base,
                  system_watchdog::base + 0xFFF,
                  {system_watchdog::interrupt_id},
                  {{"WDT_CLK_FREQ_HZ", cpu_1x_hz}},
                  {{"CLOCK_FREQ", cpu_1x_hz}}});
}

void add_storage_and_network(std::vector<Block>& list) {
  list.push_back({"PS7_QSPI_0",
                  "XQSPIPS",
                  "QSPI",
                  "XQSPIPS",
                  "xlnx,zynq-qspi-1.0",
                  qspi::base,
                  qspi::base + 0xFFF,
                  {qspi::interrupt_id},
                  {{"QSPI_CLK_FREQ_HZ", qspi_hz}, {"QSPI_MODE", 0}, {"QSPI_BUS_WIDTH", 2}},
                  {{"CLOCK_FREQ", qspi_hz},
                   {"CONNECTION_MODE", 0},
                   {"BUS_WIDTH", 2},
                   {"QSPI_MODE", 0},
                   {"QSPI_BUS_WIDTH", 2}}});
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t sd = n == 0 ? sdio::sd0_base : sdio::sd1_base;
    list.push_back({numbered("PS7_SD_", n),
                    "XSDPS",
                    numbered("SDHCI", n),
                    "XSDPS",
                    "arasan,sdhci-8.9a",
                    sd,
                    sd + 0xFFF,
                    {n == 0 ? sdio::sd0_interrupt : sdio::sd1_interrupt},
                    {{"SDIO_CLK_FREQ_HZ", sdio_hz},
                     {"HAS_CD", 0},
                     {"HAS_WP", 0},
                     {"BUS_WIDTH", 0},
                     {"MIO_BANK", 0},
                     {"HAS_EMIO", 0}},
                    {{"CLOCK_FREQ", sdio_hz}, {"HAS_CD", 0}, {"HAS_WP", 0}, {"BUS_WIDTH", 4}}});
  }
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t base = n == 0 ? gem::gem0_base : gem::gem1_base;
    list.push_back({numbered("PS7_ETHERNET_", n),
                    "XEMACPS",
                    numbered("GEM", n),
                    "XEMACPS",
                    "xlnx,zynq-gem",
                    base,
                    base + 0xFFF,
                    {n == 0 ? gem::gem0_interrupt : gem::gem1_interrupt},
                    {{"ENET_CLK_FREQ_HZ", enet_hz},
                     {"ENET_SLCR_1000MBPS_DIV0", 8},
                     {"ENET_SLCR_1000MBPS_DIV1", 1},
                     {"ENET_SLCR_100MBPS_DIV0", 8},
                     {"ENET_SLCR_100MBPS_DIV1", 5},
                     {"ENET_SLCR_10MBPS_DIV0", 8},
                     {"ENET_SLCR_10MBPS_DIV1", 50}},
                    {}});
  }
  for (const unsigned n : {0u, 1u}) {
    const std::uint32_t base = n == 0 ? usb::usb0_base : usb::usb1_base;
    list.push_back({numbered("PS7_USB_", n),
                    "XUSBPS",
                    numbered("USB", n),
                    "XUSBPS",
                    "xlnx,zynq-usb-2.20a",
                    base,
                    base + 0xFFF,
                    {n == 0 ? usb::usb0_interrupt : usb::usb1_interrupt},
                    {},
                    {}});
  }
}

void add_system(std::vector<Block>& list) {
  list.push_back({"PS7_GPIO_0",
                  "XGPIOPS",
                  "GPIO0",
                  "XGPIOPS",
                  "xlnx,zynq-gpio-1.0",
                  ps_gpio::base,
                  ps_gpio::base + 0xFFF,
                  {ps_gpio::interrupt_id},
                  {},
                  {}});
  list.push_back({"PS7_XADC_0",
                  "XADCPS",
                  "ADC",
                  "XXADCPS",
                  "xlnx,zynq-xadc-1.00.a",
                  ps_xadc::base,
                  ps_xadc::base + 0x20,
                  {ps_xadc::interrupt_id},
                  {},
                  {}});
  list.push_back({"PS7_DEV_CFG_0",
                  "XDCFG",
                  "DEVCFG",
                  "XDEVCFG",
                  "xlnx,zynq-devcfg-1.0",
                  devcfg::base,
                  devcfg::base + 0xFF,
                  {devcfg::interrupt_id},
                  {},
                  {}});
  constexpr std::uint32_t abort = 45;
  list.push_back({"PS7_DMA_S",
                  "XDMAPS",
                  "DMAC_S",
                  "XDMAPS",
                  "arm,pl330",
                  0xF8003000,
                  0xF8003FFF,
                  {abort, 46, 47, 48, 49, 72, 73, 74, 75},
                  {},
                  {}});
  list.push_back({"PS7_DMA_NS", "XDMAPS", "", "", "", 0xF8004000, 0xF8004FFF, {}, {}, {}});
}

std::string text_of(const Block& block, unsigned number, unsigned sdt_number) {
  Section out(block.label.empty() ? block.instance : block.label);
  if (!block.instance.empty()) {
    for (const std::string& name : {block.instance, block.driver + "_" + std::to_string(number)}) {
      out.number(Section::classic, name + "_DEVICE_ID", number);
      out.address(Section::classic, name + "_BASEADDR", block.base);
      if (block.last != 0) out.address(Section::classic, name + "_HIGHADDR", block.last);
      for (const auto& [option, value] : block.options)
        out.number(Section::classic, name + "_" + option, value);
    }
  }
  if (block.label.empty()) return out.text();
  for (const std::string& name :
       {block.label, block.sdt_driver + "_" + std::to_string(sdt_number)}) {
    out.address(Section::sdt, name + "_BASEADDR", block.base);
    out.address(Section::sdt, name + "_HIGHADDR", block.last);
    out.words(Section::sdt, name + "_COMPATIBLE", block.compatible);
    for (const auto& [option, value] : block.sdt_options)
      out.hex(Section::sdt, name + "_" + option, value);
    for (std::size_t n = 0; n < block.interrupts.size(); ++n) {
      if (n > 0 && name != block.label) break;
      out.hex(Section::sdt, name + "_INTERRUPTS" + (n == 0 ? "" : "_" + std::to_string(n)),
              sdt_interrupt(block.interrupts[n]));
    }
    out.address(Section::sdt, name + "_INTERRUPT_PARENT", gic::distributor_base);
  }
  return out.text();
}

/// Parts without a driver, by their names in both flows, and what they decode.
struct Part {
  const char *name, *label;
  std::uint32_t base, last;
};
constexpr Part parts[] = {
    {"PS7_AFI_0", "AFI0", 0xF8008000, 0xF8008FFF},
    {"PS7_AFI_1", "AFI1", 0xF8009000, 0xF8009FFF},
    {"PS7_AFI_2", "AFI2", 0xF800A000, 0xF800AFFF},
    {"PS7_AFI_3", "AFI3", 0xF800B000, 0xF800BFFF},
    {"PS7_DDRC_0", "MC", 0xF8006000, 0xF8006FFF},
    {"PS7_GLOBALTIMER_0", "GLOBAL_TIMER", 0xF8F00200, 0xF8F002FF},
    {"PS7_GPV_0", "", 0xF8900000, 0xF89FFFFF},
    {"PS7_INTC_DIST_0", "", 0xF8F01000, 0xF8F01FFF},
    {"PS7_IOP_BUS_CONFIG_0", "", 0xE0200000, 0xE0200FFF},
    {"PS7_L2CACHEC_0", "", 0xF8F02000, 0xF8F02FFF},
    {"PS7_OCMC_0", "OCMC", 0xF800C000, 0xF800CFFF},
    {"PS7_PL310_0", "L2", 0xF8F02000, 0xF8F02FFF},
    {"PS7_PMU_0", "PMU", 0xF8891000, 0xF8891FFF},
    {"PS7_QSPI_LINEAR_0", "", 0xFC000000, 0xFCFFFFFF},
    {"PS7_SCUC_0", "", 0xF8F00000, 0xF8F000FC},
    {"PS7_SLCR_0", "SLCR", 0xF8000000, 0xF8000FFF},
};

std::string without_driver() {
  Section out("Parts without a driver");
  for (const Part& part : parts) {
    const std::string name = part.name;
    out.address(Section::classic, name + "_S_AXI_BASEADDR", part.base);
    out.address(Section::classic, name + "_S_AXI_HIGHADDR", part.last);
    if (*part.label == 0) continue;
    for (const std::string& sdt : {std::string(part.label), name}) {
      out.address(Section::sdt, sdt + "_BASEADDR", part.base);
      out.address(Section::sdt, sdt + "_HIGHADDR", part.last);
    }
  }
  out.address(Section::classic, "PS7_PMU_0_PMU1_S_AXI_BASEADDR", 0xF8893000);
  out.address(Section::classic, "PS7_PMU_0_PMU1_S_AXI_HIGHADDR", 0xF8893FFF);
  // Classic takes the whole of the memory; SDT what boot code leaves to a program.
  out.address(Section::classic, "PS7_RAM_0_S_AXI_BASEADDR", 0x00000000);
  out.address(Section::classic, "PS7_RAM_0_S_AXI_HIGHADDR", 0x0003FFFF);
  out.address(Section::classic, "PS7_RAM_1_S_AXI_BASEADDR", 0xFFFC0000);
  out.address(Section::classic, "PS7_RAM_1_S_AXI_HIGHADDR", 0xFFFFFFFF);
  out.address(Section::sdt, "PS7_RAM_0_BASEADDRESS", 0x00000000);
  out.address(Section::sdt, "PS7_RAM_0_HIGHADDRESS", 0x0002FFFF);
  out.address(Section::sdt, "PS7_RAM_1_BASEADDRESS", 0xFFFF0000);
  out.address(Section::sdt, "PS7_RAM_1_HIGHADDRESS", 0xFFFFFDFF);
  return out.text();
}

/// The interrupt controller has addresses of its own kind, and both timers of the core short names.
std::string processor_devices() {
  Section out("Cortex-A9 MPCore");
  out.number(Section::classic, "PS7_SCUGIC_0_DEVICE_ID", 0);
  out.address(Section::classic, "PS7_SCUGIC_0_BASEADDR", gic::cpu_interface_base);
  out.address(Section::classic, "PS7_SCUGIC_0_HIGHADDR", gic::cpu_interface_base + 0xFF);
  out.address(Section::classic, "PS7_SCUGIC_0_DIST_BASEADDR", gic::distributor_base);
  out.number(Section::classic, "SCUGIC_0_DEVICE_ID", 0);
  out.number(Section::classic, "SCUGIC_SINGLE_DEVICE_ID", 0);
  out.address(Section::classic, "SCUGIC_0_CPU_BASEADDR", gic::cpu_interface_base);
  out.address(Section::classic, "SCUGIC_0_CPU_HIGHADDR", gic::cpu_interface_base + 0xFF);
  out.address(Section::classic, "SCUGIC_0_DIST_BASEADDR", gic::distributor_base);
  out.number(Section::both, "XSCUGIC_NUM_INSTANCES", 1);
  out.address(Section::both, "XSCUGIC_0_BASEADDR", gic::distributor_base);
  out.address(Section::sdt, "INTC_BASEADDR", gic::distributor_base);
  for (const char* name : {"INTC", "XSCUGIC_0"}) {
    out.words(Section::sdt, std::string(name) + "_COMPATIBLE", "arm,cortex-a9-gic");
  }
  out.address(Section::sdt, "INTC_BASEADDR_1", gic::cpu_interface_base);
  out.address(Section::both, "GLOBAL_TMR_BASEADDR", 0xF8F00200);
  out.number(Section::both, "GLOBAL_TMR_INTR", gic::global_timer_id);
  out.address(Section::classic, "SCUTIMER_0_BASEADDR", 0xF8F00600);
  out.number(Section::both, "SCUTIMER_INTR", gic::private_timer_id);
  out.number(Section::classic, "SCUTIMER_DEVICE_ID", 0);
  out.number(Section::classic, "XSCUWDT_0_DEVICE_ID", 0);
  out.address(Section::classic, "XSCUWDT_0_BASEADDR", 0xF8F00620);
  return out.text();
}

}  // namespace

// Senses by UG585 table 7-3. The two private interrupts are as the generator writes them.
std::uint32_t sdt_interrupt(std::uint32_t id) {
  if (id == gic::private_timer_id) return 0x13100D;
  if (id == gic::watchdog_id) return 0x10400E;
  constexpr std::uint32_t rising = 1u << 12, level_high = 4u << 12;
  const bool is_edge = id == system_watchdog::interrupt_id || id == 55 || id == 78;
  constexpr std::uint32_t is_private = 1u << 20;
  if (id < gic::first_spi) return is_private | level_high | (id - gic::sgi_count);
  return (id - gic::first_spi) | (is_edge ? rising : level_high);
}

std::string processing_system(std::uint64_t cpu_hz, const std::vector<std::uint32_t>& uarts) {
  std::vector<Block> blocks;
  add_serial(blocks, cpu_hz, uarts);
  add_system(blocks);
  add_timers(blocks, cpu_hz);
  add_storage_and_network(blocks);
  std::string text = processor_devices();
  std::vector<std::pair<std::string, unsigned>> classic, sdt;
  const auto next = [](std::vector<std::pair<std::string, unsigned>>& counts,
                       const std::string& driver) {
    const auto found = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == driver; });
    if (found != counts.end()) return found->second++;
    if (!driver.empty()) counts.emplace_back(driver, 1);
    return 0u;
  };
  for (const Block& block : blocks) {
    const unsigned number = next(classic, block.driver);
    text += text_of(block, number, next(sdt, block.sdt_driver));
  }
  Section counts("How many of them a driver has");
  for (const auto& [driver, count] : classic)
    counts.number(Section::classic, (driver[0] == 'X' ? "" : "X") + driver + "_NUM_INSTANCES",
                  count);
  for (const auto& [driver, count] : sdt)
    counts.number(Section::sdt, driver + "_NUM_INSTANCES", count);
  if (uarts.empty()) counts.number(Section::both, "XUARTPS_NUM_INSTANCES", 0);
  return text + counts.text() + without_driver();
}

}  // namespace xparameters
