// GPIO, I2C, SPI, TTC and system watchdog, with what is wired to their pins.
#include <ps_gpio_registers.h>
#include <ps_i2c_registers.h>
#include <ps_spi_registers.h>
#include <system_watchdog_registers.h>
#include <ttc_registers.h>

#include <ps/gpio/gpio.h>
#include <ps/i2c/i2c.h>
#include <ps/spi/spi.h>
#include <ps/system_watchdog/system_watchdog.h>
#include <ps/ttc/ttc.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <string>
#include <vector>

#include "peripheral_bench.h"

using namespace bench;

BOOST_AUTO_TEST_SUITE(ps_peripherals)

// ---- GPIO

BOOST_AUTO_TEST_CASE(gpio_outputs_and_masks) {
  Alone<ps::Gpio> b("gpio", ps_gpio::base);
  b.run([] {
    using namespace ps_gpio;
    put(base + DIRM_0, 1u << 10 | 1u << 7);
    put(base + OEN_0, 1u << 10 | 1u << 7);
    put(base + MASK_DATA_0_LSW, 0xFB7Fu << 16 | 0xFFFF);  // pins 10 and 7 only
    BOOST_TEST(look(base + DATA_0) == 0x480u);
    let_pass(100'000);
    BOOST_TEST(look(base + DATA_0_RO) == 0x400u, "pin 7 is an output only: reads 0");
    BOOST_TEST(look(base + MASK_DATA_0_LSW) == 0x480u, "the mask reads 0");
    put(base + MASK_DATA_0_LSW + 4, 0);
    BOOST_TEST(look(base + DATA_0) == 0x480u);
    BOOST_TEST(look(base + INT_TYPE_0 + bank_stride) == 0x003FFFFFu);
    return 0;
  });
  BOOST_TEST(b.dut.mio_o.get() == 0x480u);
  BOOST_CHECK_THROW(b.dut.set_pin(118, true), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(gpio_wire_from_pin_to_pin_interrupts) {
  Alone<ps::Gpio> b("gpio", ps_gpio::base);
  b.dut.connect_pins(10, 14);
  b.run([] {
    using namespace ps_gpio;
    for (unsigned bank = 0; bank < bank_count; ++bank) {
      put(base + INT_DIS_0 + bank * bank_stride, ~0u);
    }
    put(base + DIRM_0, 1u << 10);
    put(base + OEN_0, 1u << 10);
    put(base + INT_TYPE_0, 0);
    put(base + INT_POLARITY_0, 1u << 14);
    put(base + INT_STAT_0, ~0u);
    BOOST_TEST((look(base + INT_STAT_0) & 1u << 14) == 0u);
    put(base + INT_EN_0, 1u << 14);
    put(base + DATA_0, 1u << 10);
    let_pass(5 * clock_ps);
    BOOST_TEST((look(base + DATA_0_RO) & 1u << 14) != 0u);
    put(base + INT_STAT_0, 1u << 14);
    BOOST_TEST((look(base + INT_STAT_0) & 1u << 14) != 0u, "a level comes back");
    put(base + DATA_0, 0);
    let_pass(5 * clock_ps);
    put(base + INT_STAT_0, 1u << 14);
    BOOST_TEST((look(base + INT_STAT_0) & 1u << 14) == 0u);
    return 0;
  });
  BOOST_TEST(!b.dut.irq.get());
}

// What is on a pin at the start is no edge; the board is stronger than a pull-up.
BOOST_AUTO_TEST_CASE(gpio_pull_ups_hold_what_nothing_drives) {
  Alone<ps::Gpio> b("gpio", ps_gpio::base);
  b.dut.set_pull_up(12, true);
  b.dut.connect_pins(12, 13);
  b.run([&] {
    using namespace ps_gpio;
    put(base + INT_POLARITY_0, 1u << 12);
    let_pass(5 * clock_ps);
    BOOST_TEST(look(base + DATA_0_RO) == (1u << 12 | 1u << 13), "a wire to a pin with a pull-up");
    BOOST_TEST((look(base + INT_STAT_0) & 1u << 12) == 0u);
    b.dut.set_pin(12, false);
    let_pass(5 * clock_ps);
    BOOST_TEST(look(base + DATA_0_RO) == 0u);
    b.dut.release_pin(12);
    let_pass(5 * clock_ps);
    BOOST_TEST((look(base + INT_STAT_0) & 1u << 12) != 0u);
    put(base + DIRM_0, 1u << 12);
    put(base + OEN_0, 1u << 12);
    let_pass(5 * clock_ps);
    BOOST_TEST(look(base + DATA_0_RO) == 0u, "the program drives it");
    put(base + DIRM_0, 0);
    b.dut.set_pull_up(12, false);
    let_pass(5 * clock_ps);
    BOOST_TEST(look(base + DATA_0_RO) == 0u);
    return 0;
  });
}

// The level is seen two clocks after the pin, at an edge.
BOOST_AUTO_TEST_CASE(gpio_edges_of_the_emio) {
  Alone<ps::Gpio> b("gpio", ps_gpio::base);
  vp::Signal<std::uint64_t> wires{"wires"};
  b.dut.emio_gpio_i(wires);
  Changes<bool> irq{b.dut.irq, b.scheduler};
  std::uint64_t driven_ps = 0;
  b.run([&] {
    using namespace ps_gpio;
    const std::uint32_t bank = base + 2 * bank_stride;
    put(bank + INT_DIS_0, ~0u);
    put(bank + INT_POLARITY_0, 1u << 3);
    put(bank + INT_EN_0, 1u << 3);
    look(bank + INT_STAT_0);  // brings the program's time up to the bus
    driven_ps = now_ps();
    wires = 1u << 3;
    let_pass(100'000);
    BOOST_TEST(look(base + DATA_0_RO + 2 * data_stride) == 8u);
    BOOST_TEST(look(base + DATA_0 + 2 * data_stride) == 8u, "an input of the EMIO, by DATA");
    put(bank + INT_STAT_0, 1u << 3);
    look(bank + INT_STAT_0);
    wires = 0;
    let_pass(100'000);
    BOOST_TEST(look(bank + INT_STAT_0) == 0u, "the falling edge is not looked at");
    put(bank + DIRM_0, 1u << 4);
    put(bank + OEN_0, 1u << 4);
    put(base + DATA_0 + 2 * data_stride, 1u << 4);
    let_pass(100'000);
    BOOST_TEST(look(base + DATA_0_RO + 2 * data_stride) == 0u, "an output does not come back");
    return 0;
  });
  BOOST_REQUIRE(irq.times.size() == 2u);
  BOOST_TEST(irq.times[0] == (driven_ps / clock_ps + 2) * clock_ps);
  BOOST_TEST(b.dut.emio_gpio_o.get() == 0x10u);
  BOOST_TEST(b.dut.emio_gpio_t.get() == ~std::uint64_t{0x10});
}

// ---- I2C

namespace {

constexpr std::uint32_t i2c_at = ps_i2c::i2c0_base;
constexpr std::uint32_t master = ps_i2c::cr::MS | ps_i2c::cr::ACKEN | ps_i2c::cr::NEA;
/// 100 MHz / (22 · 1 · 10) = 454.5 kHz: 2.2 us a period.
constexpr std::uint32_t divider = 9u << ps_i2c::cr::DIV_B_shift;
constexpr std::uint64_t scl_ps = 220 * clock_ps;

void i2c_wait(std::uint32_t event) {
  while ((look(i2c_at + ps_i2c::ISR) & event) == 0) let_pass(clock_ps);
}

void i2c_send(std::uint32_t address, const std::vector<std::uint8_t>& bytes, bool hold = false) {
  using namespace ps_i2c;
  put(i2c_at + ISR, event::all);
  put(i2c_at + CR, master | divider | cr::CLR_FIFO | (hold ? cr::HOLD : 0));
  for (const std::uint8_t byte : bytes) put(i2c_at + DATA, byte);
  put(i2c_at + ADDR, address);
}

}  // namespace

BOOST_AUTO_TEST_CASE(i2c_eeprom_is_written_and_read) {
  Alone<ps::I2c> b("i2c0", i2c_at);
  board::I2cDevice& eeprom = b.dut.bus.attach(0x50, std::make_unique<board::I2cEeprom>(256, 16));
  b.run([] {
    using namespace ps_i2c;
    i2c_send(0x50, {0x1E, 0xA1, 0xB2, 0xC3});
    const std::uint64_t start = now_ps();
    BOOST_TEST(look(i2c_at + TRANS_SIZE) == 4u);
    i2c_wait(event::COMP);
    // A start and five bytes of nine periods; the loop looks once a bus access.
    BOOST_TEST(now_ps() - start >= 46 * scl_ps);
    BOOST_TEST(now_ps() - start < 46 * scl_ps + 100'000);
    BOOST_TEST((look(i2c_at + SR) & sr::BA) == 0u);
    i2c_send(0x50, {0x1E}, true);
    i2c_wait(event::COMP);
    BOOST_TEST((look(i2c_at + SR) & sr::BA) != 0u, "HOLD keeps the bus");
    put(i2c_at + ISR, event::all);
    put(i2c_at + CR, master | divider | cr::RW);
    put(i2c_at + TRANS_SIZE, 3);
    put(i2c_at + ADDR, 0x50);
    i2c_wait(event::COMP);
    BOOST_TEST((look(i2c_at + ISR) & event::DATA) != 0u);
    BOOST_TEST(look(i2c_at + DATA) == 0xA1u);
    BOOST_TEST(look(i2c_at + DATA) == 0xB2u);
    BOOST_TEST((look(i2c_at + SR) & sr::RXDV) != 0u);
    return 0;
  });
  BOOST_TEST(eeprom.peek(0x10) == 0xC3, "a page wraps");
}

// NACK says so, not COMP, and the bus is free again.
BOOST_AUTO_TEST_CASE(i2c_without_a_device) {
  Alone<ps::I2c> b("i2c0", i2c_at);
  b.run([] {
    using namespace ps_i2c;
    put(i2c_at + IER, event::NACK);
    i2c_send(0x42, {1});
    i2c_wait(event::NACK);
    BOOST_TEST((look(i2c_at + ISR) & event::COMP) == 0u);
    BOOST_TEST((look(i2c_at + SR) & sr::BA) == 0u);
    return 0;
  });
  BOOST_TEST(b.dut.irq.get());
}

BOOST_AUTO_TEST_CASE(i2c_slave_monitor_and_full_fifo) {
  Alone<ps::I2c> b("i2c0", i2c_at);
  b.dut.bus.attach(0x18, std::make_unique<board::I2cRegisterFile>(1, 2));
  b.run([] {
    using namespace ps_i2c;
    put(i2c_at + CR, master | divider | cr::SLVMON);
    put(i2c_at + ADDR, 0x51);  // nothing is there: the poll ends with its bit
    let_pass(1000 * clock_ps);
    BOOST_TEST((look(i2c_at + SR) & sr::BA) != 0u);
    put(i2c_at + CR, master | divider);
    BOOST_TEST((look(i2c_at + SR) & sr::BA) == 0u);
    put(i2c_at + CR, master | divider | cr::SLVMON);
    put(i2c_at + ADDR, 0x18);
    i2c_wait(event::SLV_RDY);
    BOOST_TEST((look(i2c_at + CR) & cr::SLVMON) == 0u);
    put(i2c_at + CR, master | divider | cr::RW | cr::HOLD);
    put(i2c_at + TRANS_SIZE, 20);
    put(i2c_at + ADDR, 0x18);
    let_pass(30 * 9 * scl_ps);
    BOOST_TEST(look(i2c_at + TRANS_SIZE) == 4u, "SCL is stretched while the FIFO is full");
    BOOST_TEST((look(i2c_at + ISR) & (event::COMP | event::RX_OVF)) == 0u);
    look(i2c_at + DATA);
    let_pass(10 * scl_ps);
    BOOST_TEST(look(i2c_at + TRANS_SIZE) == 3u);
    return 0;
  });
}

// ---- SPI

BOOST_AUTO_TEST_CASE(spi_reads_a_flash) {
  constexpr std::uint32_t at = ps_spi::spi0_base;
  Alone<ps::Spi> b("spi0", at);
  b.dut.attach(1, std::make_shared<board::SpiFlash>());
  b.run([] {
    using namespace ps_spi;
    BOOST_TEST(look(at + CR) == 0x20000u);
    BOOST_TEST(look(at + ISR) == event::TXOW);
    put(at + CR, cr::MSTREN | cr::SSFORCE);  // slave 0, which is not there: nothing while disabled
    put(at + CR, cr::MSTREN | cr::SSFORCE | 1u << cr::PRESC_shift | 0xDu << cr::SSCTRL_shift);
    put(at + ENABLE, 1);
    const std::uint64_t start = now_ps();
    for (const unsigned byte : {0x9F, 0, 0, 0}) put(at + TXD, byte);
    while ((look(at + ISR) & event::TXOW) == 0) let_pass(clock_ps);
    BOOST_TEST(now_ps() - start >= 4 * 8 * 4 * clock_ps, "8 bits of 4 clocks a byte");
    BOOST_TEST((look(at + ISR) & event::RXNEMPTY) != 0u);
    BOOST_TEST(look(at + RXD) == 0xFFu);
    BOOST_TEST(look(at + RXD) == 0xEFu);
    BOOST_TEST(look(at + RXD) == 0x40u);
    BOOST_TEST(look(at + RXD) == 0x16u);
    BOOST_TEST((look(at + ISR) & event::RXNEMPTY) == 0u);
    BOOST_TEST(look(at + RXD) == 0u, "an empty FIFO");
    put(at + CR, cr::MSTREN | cr::SSFORCE | 1u << cr::PRESC_shift | 0xFu << cr::SSCTRL_shift);
    return 0;
  });
  BOOST_TEST(b.dut.ss_n.get() == 7u);
  BOOST_TEST(b.reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_AUTO_TEST_CASE(spi_without_a_device_says_so) {
  constexpr std::uint32_t at = ps_spi::spi0_base;
  Alone<ps::Spi> b("spi0", at);
  b.run([] {
    using namespace ps_spi;
    put(at + CR, cr::MSTREN | cr::MANSTRTEN | 1u << cr::PRESC_shift | 0xEu << cr::SSCTRL_shift);
    put(at + ENABLE, 1);
    put(at + TXD, 5);
    let_pass(1'000'000);
    BOOST_TEST((look(at + ISR) & event::TXOW) == 0u, "it waits for MANSTRT");
    put(at + CR, look(at + CR) | cr::MANSTRT);
    let_pass(1'000'000);
    BOOST_TEST(look(at + RXD) == 0xFFu);
    return 0;
  });
  BOOST_TEST(b.text.str().find("no device is attached") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(flash_programs_and_erases) {
  board::SpiFlash flash(0x1'0000);
  const auto order = [&flash](std::vector<unsigned> bytes) {
    std::uint8_t last = 0;
    flash.select(true);
    for (const unsigned byte : bytes) last = flash.exchange(static_cast<std::uint8_t>(byte));
    flash.select(false);
    return last;
  };
  order({0x02, 0, 1, 0xFE, 0x0F, 0x55});
  BOOST_TEST(flash.contents()[0x1FE] == 0xFF, "writing is not enabled");
  order({0x06});
  BOOST_TEST(order({0x05, 0}) == 2);
  order({0x02, 0, 1, 0xFF, 0x0F, 0x55});
  BOOST_TEST(order({0x05, 0}) == 1, "busy");
  order({0x05, 0});
  BOOST_TEST(order({0x05, 0}) == 0);
  BOOST_TEST(order({0x03, 0, 1, 0xFF, 0}) == 0x0F);
  BOOST_TEST(flash.contents()[0x100] == 0x55, "a page wraps");
  order({0x06});
  order({0x20, 0, 0, 0});
  BOOST_TEST(flash.contents()[0x1FF] == 0xFF);
  BOOST_CHECK_THROW(board::SpiFlash(1000), std::invalid_argument);
}

// ---- TTC

BOOST_AUTO_TEST_CASE(ttc_interval_interrupts_each_period) {
  constexpr std::uint32_t at = ttc::ttc0_base;
  Alone<ps::Ttc> b("ttc0", at);
  Changes<bool> irq{b.dut.counter(1).irq, b.scheduler};
  b.run([] {
    using namespace ttc;
    constexpr std::uint32_t one = counter_stride;
    BOOST_TEST(look(at + CNT_CTRL_1 + one) == 0x21u);
    put(at + INTERVAL_CNT_1 + one, 99);
    put(at + INT_EN_1 + one, event::Interval);
    put(at + CNT_CTRL_1 + one, cnt_ctrl::INT | cnt_ctrl::RST | cnt_ctrl::Wave_en);
    for (int n = 0; n < 3; ++n) {
      while (look(at + INT_STS_1 + one) == 0) let_pass(clock_ps);
    }
    BOOST_TEST(look(at + INT_STS_1 + one) == 0u, "a read clears");
    BOOST_TEST(look(at + CNT_VAL_1) == 0u, "its neighbour does not count");
    return 0;
  });
  std::vector<std::uint64_t> rises;
  for (std::size_t i = 0; i < irq.times.size(); i += 2) rises.push_back(irq.times[i]);
  BOOST_REQUIRE(rises.size() >= 3u);
  BOOST_TEST(rises[1] - rises[0] == 100 * clock_ps);
  BOOST_TEST(rises[2] - rises[1] == 100 * clock_ps);
}

BOOST_AUTO_TEST_CASE(ttc_matches_and_prescaler) {
  constexpr std::uint32_t at = ttc::ttc0_base;
  Alone<ps::Ttc> b("ttc0", at);
  b.run([] {
    using namespace ttc;
    put(at + CLK_CTRL_1, clk_ctrl::Prescale_En | 1u << clk_ctrl::Prescale_shift);  // by 4
    put(at + MATCH_1_CNT_1, 50);
    put(at + CNT_CTRL_1, cnt_ctrl::DEC | cnt_ctrl::Match | cnt_ctrl::RST | cnt_ctrl::Wave_en);
    const std::uint64_t start = now_ps();
    let_pass(400 * clock_ps);
    const std::uint32_t value = look(at + CNT_VAL_1);
    BOOST_TEST(value <= 0xFFFFu - 100u);
    BOOST_TEST(value >= 0xFFFFu - 100u - (now_ps() - start - 400 * clock_ps) / (4 * clock_ps) - 1u);
    BOOST_TEST(look(at + INT_STS_1) == 0u);
    let_pass(4 * 0x10000 * clock_ps);
    constexpr std::uint32_t matches = event::Match_1 | event::Match_2 | event::Match_3;
    BOOST_TEST(look(at + INT_STS_1) == (matches | event::Overflow), "the others are 0");
    put(at + CLK_CTRL_1, clk_ctrl::Source);
    return 0;
  });
  BOOST_TEST(b.text.str().find("external clock, which is not modelled") != std::string::npos);
}

// High from match 1 to the end of the period.
BOOST_AUTO_TEST_CASE(ttc_waveform) {
  constexpr std::uint32_t at = ttc::ttc0_base;
  Alone<ps::Ttc> b("ttc0", at);
  Changes<bool> wave{b.dut.counter(0).wave, b.scheduler};
  b.run([] {
    using namespace ttc;
    put(at + INTERVAL_CNT_1, 199);
    put(at + MATCH_1_CNT_1, 150);
    put(at + CNT_CTRL_1, cnt_ctrl::INT | cnt_ctrl::Match | cnt_ctrl::RST);
    let_pass(1000 * clock_ps);
    return 0;
  });
  BOOST_REQUIRE(wave.times.size() >= 4u);
  BOOST_TEST(wave.values[0] == 1u);
  BOOST_TEST(wave.times[1] - wave.times[0] == 50 * clock_ps);
  BOOST_TEST(wave.times[2] - wave.times[0] == 200 * clock_ps);
}

// ---- watchdog

BOOST_AUTO_TEST_CASE(watchdog_needs_its_keys_and_expires) {
  constexpr std::uint32_t at = system_watchdog::base;
  Alone<ps::SystemWatchdog> b("swdt", at);
  Changes<bool> irq{b.dut.irq, b.scheduler};
  std::uint64_t started = 0;
  b.run([&] {
    using namespace system_watchdog;
    put(at + MODE, mode::WDEN);
    BOOST_TEST(look(at + MODE) == 0x1C0u, "without its key");
    put(at + CONTROL, control_key << control_key_shift);  // CRV 0, a count every 8 clocks
    BOOST_TEST(look(at + CONTROL) == 0u);
    put(at + MODE, mode_key << mode_key_shift | mode::WDEN | mode::IRQEN | mode::RSTEN);
    let_pass(4000 * 8 * clock_ps);
    put(at + RESTART, restart_key);
    started = now_ps();
    let_pass(4000 * 8 * clock_ps);
    BOOST_TEST(look(at + STATUS) == 0u);
    let_pass(200 * 8 * clock_ps);
    BOOST_TEST(look(at + STATUS) == status::WDZ);
    return 0;
  });
  BOOST_REQUIRE(irq.times.size() == 2u);
  BOOST_TEST(irq.times[1] - irq.times[0] == 4 * clock_ps);
  BOOST_TEST(irq.times[0] <= started + 4096 * 8 * clock_ps);
  BOOST_TEST(b.text.str().find("the system watchdog expired") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
