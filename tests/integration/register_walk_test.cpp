// Every bit of every register of the platform as it runs, through the processor's port: what it
// reads after reset, and what writing ones and zeros does, is what its description says.
#include <chip/system/designs.h>
#include <chip/system/hardware_map.h>
#include <slcr_registers.h>
#include <vp/configuration.h>
#include <vp/register_bank.h>
#include <vp/report.h>
#include <vp/text.h>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulation.h"

namespace {

using Name = std::pair<std::string, std::string>;  // device, register

/// What the walk leaves alone, and which test has it instead.
struct Exception {
  std::uint32_t bits;  ///< that are neither written nor compared
  const char* reason;
};
constexpr std::uint32_t all = 0xFFFF'FFFF;
const std::map<Name, Exception>& exceptions() {
  static const std::map<Name, Exception> list{
      // axi_dma_register_test
      {{"axi_dma_0", "MM2S_DMACR"},
       {0x00FF'0004, "Reset clears itself; a threshold of 0 stores 1"}},
      {{"axi_dma_1", "S2MM_DMACR"},
       {0x00FF'0004, "Reset clears itself; a threshold of 0 stores 1"}},
      {{"axi_dma_0", "MM2S_DMASR"}, {0x0000'0003, "Halted and Idle follow DMACR"}},
      {{"axi_dma_1", "S2MM_DMASR"}, {0x0000'0003, "Halted and Idle follow DMACR"}},
      // gic_test
      {{"gic_cpu_interface", "ICCBPR"}, {0x0000'0007, "at least 2"}},
      {{"gic_cpu_interface", "ICCABPR"}, {0x0000'0007, "at least 3"}},
      {{"gic_distributor", "ICDISPR0"}, {0x0000'FFFF, "software interrupts come from ICDSGIR"}},
      {{"gic_distributor", "ICDICPR0"}, {0x0000'FFFF, "software interrupts come from ICDSGIR"}},
      // private_timer_test
      {{"private_timer", "WDT_CONTROL"}, {0x0000'0009, "a watchdog that expires ends the run"}},
      {{"private_timer", "INTERRUPT_STATUS"}, {0x0000'0001, "follows the counter"}},
      {{"private_timer", "WDT_INTERRUPT_STATUS"}, {0x0000'0001, "follows the counter"}},
      {{"private_timer", "COUNTER"}, {all, "counts"}},
      {{"private_timer", "WDT_COUNTER"}, {all, "counts"}},
      // global_timer_test
      {{"global_timer", "INTERRUPT_STATUS"}, {0x0000'0001, "follows the counter"}},
      // uart_test
      {{"uart0", "CR"}, {0x0000'0043, "resets clear themselves"}},
      {{"uart1", "CR"}, {0x0000'0043, "resets clear themselves"}},
      {{"uart0", "IMR"}, {all, "follows IER and IDR"}},
      {{"uart1", "IMR"}, {all, "follows IER and IDR"}},
      {{"uart0", "ISR"}, {0x0000'1FFF, "events"}},
      {{"uart1", "ISR"}, {0x0000'1FFF, "events"}},
      {{"uart0", "MODEMSR"}, {0x0000'0100, "follows MODEMCR"}},
      {{"uart1", "MODEMSR"}, {0x0000'0100, "follows MODEMCR"}},
      {{"uart0", "SR"}, {all, "the state of the FIFOs"}},
      {{"uart1", "SR"}, {all, "the state of the FIFOs"}},
      {{"uart0", "FIFO"}, {all, "the line"}},
      {{"uart1", "FIFO"}, {all, "the line"}},
      {{"uart0", "BAUD_DIV"}, {0x0000'00FF, "values below 4 are not taken"}},
      {{"uart1", "BAUD_DIV"}, {0x0000'00FF, "values below 4 are not taken"}},
      // ps_peripherals_test
      {{"gpio", "MASK_DATA_0_LSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_0_MSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_1_LSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_1_MSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_2_LSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_2_MSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_3_LSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "MASK_DATA_3_MSW"}, {all, "a mask in its upper half"}},
      {{"gpio", "DATA_0_RO"}, {all, "pull-ups hold what nothing drives"}},
      {{"gpio", "DATA_1_RO"}, {all, "pull-ups hold what nothing drives"}},
      {{"gpio", "DATA_2"}, {all, "inputs show their level"}},
      {{"gpio", "DATA_3"}, {all, "inputs show their level"}},
      {{"i2c0", "CR"}, {0x0000'0042, "CLR_FIFO clears itself; a master's ADDR starts"}},
      {{"i2c0", "DATA"}, {all, "the FIFO"}},
      {{"i2c0", "TRANS_SIZE"}, {all, "what is in the FIFO"}},
      {{"usb0", "USBCMD"}, {0x0000'0003, "a reset clears itself"}},
      {{"usb0", "ULPI_VIEWPORT"}, {0xC000'0000, "clear themselves"}},
      {{"usb0", "ENDPTPRIME"}, {all, "clears itself"}},
      {{"usb0", "ENDPTFLUSH"}, {all, "clears itself"}},
      {{"sdio0", "CLOCK_RESET"}, {0x0700'0003, "resets clear themselves, the clock is stable"}},
      {{"gem0", "PHY_MAINT"}, {0x3000'FFFF, "no PHY answers"}},
      {{"ttc0", "CNT_CTRL_1"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc0", "INT_STS_1"}, {all, "a read clears it"}},
      {{"ttc0", "CNT_CTRL_2"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc0", "INT_STS_2"}, {all, "a read clears it"}},
      {{"ttc0", "CNT_CTRL_3"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc0", "INT_STS_3"}, {all, "a read clears it"}},
      {{"i2c1", "CR"}, {0x0000'0042, "CLR_FIFO clears itself; a master's ADDR starts"}},
      {{"i2c1", "DATA"}, {all, "the FIFO"}},
      {{"i2c1", "TRANS_SIZE"}, {all, "what is in the FIFO"}},
      {{"usb1", "USBCMD"}, {0x0000'0003, "a reset clears itself"}},
      {{"usb1", "ULPI_VIEWPORT"}, {0xC000'0000, "clear themselves"}},
      {{"usb1", "ENDPTPRIME"}, {all, "clears itself"}},
      {{"usb1", "ENDPTFLUSH"}, {all, "clears itself"}},
      {{"sdio1", "CLOCK_RESET"}, {0x0700'0003, "resets clear themselves, the clock is stable"}},
      {{"gem1", "PHY_MAINT"}, {0x3000'FFFF, "no PHY answers"}},
      {{"ttc1", "CNT_CTRL_1"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc1", "INT_STS_1"}, {all, "a read clears it"}},
      {{"ttc1", "CNT_CTRL_2"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc1", "INT_STS_2"}, {all, "a read clears it"}},
      {{"ttc1", "CNT_CTRL_3"}, {0x0000'0011, "RST clears itself; DIS lets it count"}},
      {{"ttc1", "INT_STS_3"}, {all, "a read clears it"}},
      {{"qspi", "CONFIG"}, {0x0001'0000, "starts a transfer, and clears itself"}},
      {{"swdt", "MODE"}, {all, "needs a key"}},
      {{"swdt", "CONTROL"}, {all, "needs a key"}},
      {{"xadc", "INT_STS"}, {all, "follows the FIFOs"}},
      {{"xadc", "MSTS"}, {all, "follows the FIFOs"}},
      {{"devcfg", "DMA_DEST_LEN"}, {all, "starts a transfer"}},
      // slcr_test, slcr_clocks_test
      {{"slcr", "SCL"}, {0x0000'0001, "locks until power-on"}},
      {{"slcr", "PSS_RST_CTRL"}, {0x0000'0001, "ends the run"}},
      {{"slcr", "A9_CPU_RST_CTRL"}, {0x0000'0011, "ends the run"}},
      {{"slcr", "ARM_CLK_CTRL"}, {0x0100'3F30, "clock of the processor"}},
      {{"slcr", "ARM_PLL_CTRL"}, {0x0007'F01B, "clock of the processor"}},
      {{"slcr", "PLL_STATUS"}, {0x0000'003F, "follows the PLLs"}},
      {{"slcr", "FPGA0_THR_STA"}, {0x0001'FFFF, "follows the clock"}},
      {{"slcr", "FPGA1_THR_STA"}, {0x0001'FFFF, "follows the clock"}},
      {{"slcr", "FPGA2_THR_STA"}, {0x0001'FFFF, "follows the clock"}},
      {{"slcr", "FPGA3_THR_STA"}, {0x0001'FFFF, "follows the clock"}},
  };
  return list;
}

/// In this platform's builds (axi_gpio_test has the others): all outputs, all inputs.
const std::map<Name, std::uint32_t>& constants() {
  static const std::map<Name, std::uint32_t> list{{{"axi_gpio_0", "GPIO_TRI"}, all},
                                                  {{"axi_gpio_0", "GPIO2_TRI"}, all},
                                                  {{"axi_gpio_1", "GPIO_DATA"}, 0},
                                                  {{"axi_gpio_1", "GPIO_TRI"}, all},
                                                  {{"axi_gpio_1", "GPIO2_TRI"}, all},
                                                  // Pull-ups, which pins 2 to 8 lack.
                                                  {{"gpio", "DATA_0_RO"}, 0xFFFF'FE03},
                                                  {{"gpio", "DATA_1_RO"}, 0x003F'FFFF}};
  return list;
}

/// Bits that a write can change, where this platform's builds have fewer.
const std::map<Name, std::uint32_t>& narrow() {
  static const std::map<Name, std::uint32_t> list{{{"axi_dma_0", "MM2S_LENGTH"}, 0x3FFF},
                                                  {{"axi_dma_1", "S2MM_LENGTH"}, 0x3FFF}};
  return list;
}

class Walk {
 public:
  using Device = platform::facts::HardwareMap::Device;

  /// Runs `look` on a device of a new platform.
  void on_device(const std::string& name, const std::function<void(const Device&)>& look) {
    const kit::Simulation context;
    vp::Configuration configuration;
    const vp::Configuration::Scope scope(configuration);
    platform::Zynq zynq{*platform::builtin_designs().front()};
    zynq_ = &zynq;
    vp::ReportRouter reports;
    std::ostringstream text;
    reports.redirect(text);  // it warns of much of this
    bool done = false;
    sc_core::sc_spawn([&] {
      for (const Device& device : platform::hardware_map(zynq).devices) {
        if (device.name == name) look(device);
      }
      done = true;
      sc_core::sc_stop();
    });
    sc_core::sc_start();
    BOOST_TEST(done);
  }

  tlm::tlm_response_status access(bool read, std::uint64_t address, std::uint32_t& word,
                                  unsigned bytes = 4) {
    tlm::tlm_generic_payload payload;
    unsigned char data[4];
    std::memcpy(data, &word, sizeof data);
    payload.set_command(read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND);
    payload.set_address(address);
    payload.set_data_ptr(data);
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    sc_core::sc_time rest = sc_core::SC_ZERO_TIME;
    zynq_->ps.cpu.m_axi.transport(payload, rest);
    zynq_->scheduler.forget_horizon();
    zynq_->scheduler.pass_until(zynq_->scheduler.now_ps() + vp::to_ps(rest));
    std::memcpy(&word, data, sizeof word);
    return payload.get_response_status();
  }
  std::uint32_t read(std::uint64_t address) {
    std::uint32_t word = 0xDEAD'BEEF;
    BOOST_TEST(access(true, address, word) == tlm::TLM_OK_RESPONSE);
    return word;
  }
  void write(std::uint64_t address, std::uint32_t word) {
    BOOST_TEST(access(false, address, word) == tlm::TLM_OK_RESPONSE);
  }
  std::uint64_t now_ps() const { return zynq_->scheduler.now_ps(); }

 private:
  platform::Zynq* zynq_ = nullptr;
};

/// The bits of a register by what writing does to them.
struct Policy {
  std::uint32_t rw = 0, w1c = 0, w1s = 0, w1t = 0, wo = 0;

  std::uint32_t* of(const std::string& access) {
    if (access == "rw") return &rw;
    if (access == "w1c") return &w1c;
    if (access == "w1s") return &w1s;
    if (access == "w1t") return &w1t;
    return access == "wo" ? &wo : nullptr;
  }
  std::uint32_t after(std::uint32_t before, std::uint32_t word) const {
    std::uint32_t value = (before & ~rw) | (word & rw);
    value &= ~(word & w1c);
    value |= word & w1s;
    value ^= word & w1t;
    return value & ~wo;
  }
};

Policy policy_of(const Name& name, const platform::facts::HardwareMap::Register& r) {
  Policy policy;
  if (!r.built || constants().count(name) != 0) return policy;
  if (const auto found = narrow().find(name); found != narrow().end()) {
    *policy.of(r.access) = found->second;
    return policy;
  }
  if (r.fields.empty()) {
    if (std::uint32_t* bits = policy.of(r.access)) *bits = r.writable;
  }
  for (const auto& field : r.fields) {
    if (std::uint32_t* bits = policy.of(field.access)) *bits |= field.mask;
  }
  return policy;
}

std::uint32_t excepted(const Name& name) {
  const auto found = exceptions().find(name);
  return found == exceptions().end() ? 0 : found->second.bits;
}

const char* const devices[] = {"axi_dma_0",
                               "axi_dma_1",
                               "axi_gpio_0",
                               "axi_gpio_1",
                               "uart0",
                               "uart1",
                               "slcr",
                               "gic_cpu_interface",
                               "global_timer",
                               "private_timer",
                               "gic_distributor",
                               "gpio",
                               "i2c0",
                               "i2c1",
                               "spi0",
                               "spi1",
                               "ttc0",
                               "ttc1",
                               "swdt",
                               "xadc",
                               "devcfg",
                               "qspi",
                               "sdio0",
                               "sdio1",
                               "gem0",
                               "gem1",
                               "usb0",
                               "usb1"};

/// Takes away what would make registers move by themselves.
void prepare(Walk& walk, const Walk::Device& device) {
  if (device.name == "slcr") walk.write(device.base + slcr::SLCR_UNLOCK, slcr::unlock_key);
  if (device.name == "global_timer") walk.write(device.base + 0x08, 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(register_walk)

BOOST_AUTO_TEST_CASE(no_device_is_left_out) {
  const kit::Simulation context;
  vp::Configuration configuration;
  const vp::Configuration::Scope scope(configuration);
  platform::Zynq zynq{*platform::builtin_designs().front()};
  std::size_t with_registers = 0, registers = 0;
  for (const auto& device : platform::hardware_map(zynq).devices) {
    with_registers += device.registers.empty() ? 0 : 1;
    registers += device.registers.size();
  }
  BOOST_TEST(with_registers == std::size(devices));
  BOOST_TEST(registers > 300u);
}

/// As boot code leaves them: what it changed is in the map, too.
BOOST_AUTO_TEST_CASE(values_at_the_start) {
  Walk walk;
  for (const char* name : devices) {
    walk.on_device(name, [&](const Walk::Device& device) {
      for (const auto& r : device.registers) {
        const Name key{name, r.name};
        const std::uint32_t value = walk.read(device.base + r.offset);
        const bool write_only = r.access == "wo";
        const auto constant = constants().find(key);
        const std::uint32_t expected = !r.built || write_only          ? 0
                                       : constant != constants().end() ? constant->second
                                                                       : r.at_start;
        // The boot code has started the global timer.
        if (key == Name("global_timer", "COUNTER_LOW")) continue;
        // The read of the empty DATA before it is an event.
        if (key.second == "ISR" && key.first.rfind("i2c", 0) == 0) continue;
        if (key.second == "SR" && key.first.rfind("uart", 0) == 0) {
          BOOST_TEST(value == 0xAu, "both FIFOs are empty");
          continue;
        }
        BOOST_TEST(value == expected, name << "." << r.name << ": " << vp::hex(value));
      }
    });
  }
}

BOOST_AUTO_TEST_CASE(each_bit_answers_as_described) {
  Walk walk;
  for (const char* name : devices) {
    walk.on_device(name, [&](const Walk::Device& device) {
      prepare(walk, device);
      for (const auto& r : device.registers) {
        const Name key{name, r.name};
        const std::uint64_t address = device.base + r.offset;
        const Policy policy = policy_of(key, r);
        const std::uint32_t care = ~excepted(key);
        const std::uint32_t before = walk.read(address);
        const auto check = [&](std::uint32_t word) {
          const std::uint32_t old = walk.read(address);
          // What is left alone keeps its value.
          word = (word & care) | (old & ~care & ~policy.w1c & ~policy.w1t);
          if (excepted(key) != all) walk.write(address, word);
          const std::uint32_t expected = policy.after(old, word);
          const std::uint32_t value = walk.read(address);
          BOOST_TEST((value & care) == (expected & care),
                     name << "." << r.name << " = " << vp::hex(word) << " after " << vp::hex(old)
                          << ": " << vp::hex(value) << ", not " << vp::hex(expected));
        };
        for (unsigned bit = 0; bit < 32; ++bit) check(std::uint32_t{1} << bit);
        check(all);
        for (unsigned bit = 0; bit < 32; ++bit) check(~(std::uint32_t{1} << bit));
        check(0);
        if (policy.rw != 0) check(before);
      }
    });
  }
}

/// Parts of a word, and words across the boundary of a register, are refused wherever they go.
BOOST_AUTO_TEST_CASE(partial_accesses_are_refused) {
  Walk walk;
  for (const char* name : devices) {
    walk.on_device(name, [&](const Walk::Device& device) {
      for (const auto& r : device.registers) {
        std::uint32_t word = 0;
        for (const bool read : {true, false}) {
          for (const unsigned bytes : {1u, 2u}) {
            BOOST_TEST(walk.access(read, device.base + r.offset, word, bytes) ==
                       tlm::TLM_BURST_ERROR_RESPONSE);
          }
          BOOST_TEST(walk.access(read, device.base + r.offset + 2, word) != tlm::TLM_OK_RESPONSE);
        }
      }
    });
  }
}

/// A word without register is acknowledged and reads 0, or nothing answers; it never is another's.
BOOST_AUTO_TEST_CASE(holes) {
  Walk walk;
  for (const char* name : devices) {
    walk.on_device(name, [&](const Walk::Device& device) {
      std::vector<bool> taken(0x1000 / 4);
      std::uint32_t last = 0;
      for (const auto& r : device.registers) {
        taken[r.offset / 4] = true;
        last = std::max(last, r.offset);
      }
      for (std::uint32_t offset = 0; offset < last; offset += 4) {
        if (taken[offset / 4]) continue;
        for (const bool read : {true, false, true}) {
          std::uint32_t word = read ? 0 : all;
          const auto status = walk.access(read, device.base + offset, word);
          const bool sound = status == tlm::TLM_ADDRESS_ERROR_RESPONSE ||
                             (status == tlm::TLM_OK_RESPONSE && (!read || word == 0));
          BOOST_TEST(sound, name << "+" << vp::hex(offset));
        }
      }
    });
  }
}

/// The time of an access is the bus's, the same for every register behind it: 80 ns and 8 clocks of
/// 100 MHz through GP0; 32 cycles of the CPU on the private bus.
BOOST_AUTO_TEST_CASE(times) {
  const std::map<std::string, std::uint64_t> read_ps{
      {"axi_dma_0", 160'000},   {"axi_dma_1", 160'000},        {"axi_gpio_0", 160'000},
      {"axi_gpio_1", 160'000},  {"gic_cpu_interface", 48'000}, {"gic_distributor", 48'000},
      {"global_timer", 48'000}, {"private_timer", 48'000},     {"gpio", 117'000},
      {"xadc", 117'000}};
  Walk walk;
  for (const auto& [name, expected] : read_ps) {
    walk.on_device(name, [&, ps = expected](const Walk::Device& device) {
      for (const auto& r : device.registers) {
        const std::uint64_t start = walk.now_ps();
        walk.read(device.base + r.offset);
        BOOST_TEST(walk.now_ps() - start == ps, device.name << "." << r.name);
      }
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
