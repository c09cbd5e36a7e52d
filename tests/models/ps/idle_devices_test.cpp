// The XADC's interface, and the devices that answer as they do with nothing connected.
#include <devcfg_registers.h>
#include <gem_registers.h>
#include <ps_xadc_registers.h>
#include <qspi_registers.h>
#include <sdio_registers.h>

#include <ps/idle/idle_devices.h>
#include <ps/xadc/xadc.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "peripheral_bench.h"

using namespace bench;

BOOST_AUTO_TEST_SUITE(ps_idle_devices)

BOOST_AUTO_TEST_CASE(xadc_answers_one_command_later) {
  constexpr std::uint32_t at = ps_xadc::base;
  Unclocked<ps::XadcInterface> b("xadc", at);
  b.dut.set_input(board::Xadc::temperature, 51.0);
  b.dut.set_input(board::Xadc::vaux_0 + 1, 0.25);
  b.run([] {
    using namespace ps_xadc;
    constexpr std::uint32_t read_command = command::read << command::CMD_shift;
    put(at + CMDFIFO, read_command);
    BOOST_TEST(look(at + MSTS) == 0x500u, "in reset");
    put(at + MCTL, 0);
    const auto result = [](unsigned address) {
      put(at + CMDFIFO, read_command | address << command::ADDR_shift);
      look(at + RDFIFO);
      put(at + CMDFIFO, 0);
      return look(at + RDFIFO);
    };
    const double celsius = result(board::Xadc::temperature) / 65536.0 * 503.975 - 273.15;
    BOOST_TEST(celsius > 50.9);
    BOOST_TEST(celsius < 51.1);
    BOOST_TEST(result(board::Xadc::vaux_0 + 1) == 0x4000u);
    put(at + CMDFIFO, command::write << command::CMD_shift | 0x50u << command::ADDR_shift | 0x1234);
    BOOST_TEST((look(at + MSTS) & msts::DFIFOE) == 0u, "a write is answered, too");
    look(at + RDFIFO);
    BOOST_TEST(result(0x50) == 0x1234u);
    return 0;
  });
  BOOST_CHECK_THROW(b.dut.set_input(0x07, 1), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(xadc_alarms) {
  board::Xadc xadc;
  BOOST_TEST(xadc.alarms() == 0, "off in the default mode");
  xadc.write(board::Xadc::config_1, 0x2000);
  for (unsigned limit = 0x50; limit < 0x60; ++limit) xadc.write(limit, 0);
  for (const unsigned upper : {0x50, 0x51, 0x52, 0x58, 0x59, 0x5A, 0x5B}) xadc.write(upper, 0xFFFF);
  BOOST_TEST(xadc.alarms() == 0);
  xadc.write(0x52, 0x1000);
  BOOST_TEST(xadc.alarms() == 4, "VCCAUX above its limit");
  xadc.set(board::Xadc::temperature, 130);
  BOOST_TEST(xadc.alarms() == (4 | 0x80));
}

// ---- what is idle

BOOST_AUTO_TEST_CASE(sd_without_a_card_times_out) {
  constexpr std::uint32_t at = sdio::sd0_base;
  Unclocked<ps::Sdio> b("sdio0", at);
  b.run([] {
    using namespace sdio;
    put(at + CLOCK_RESET, clock_reset::Internal_Enable | clock_reset::Resets);
    BOOST_TEST(look(at + CLOCK_RESET) ==
               (clock_reset::Internal_Enable | clock_reset::Internal_Stable));
    put(at + INT_STATUS_EN, event::Command_Timeout);
    put(at + TRANSFER_COMMAND, 0x08000000);
    BOOST_TEST(look(at + INT_STATUS) == (event::Command_Timeout | event::Error));
    put(at + INT_STATUS, event::Command_Timeout);
    BOOST_TEST(look(at + INT_STATUS) == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(qspi_with_and_without_flash) {
  constexpr std::uint32_t at = qspi::base;
  Unclocked<ps::Qspi> b("qspi", at);
  const auto ask = [](std::uint32_t word) {
    using namespace qspi;
    put(at + CONFIG, 0x80000000 | config::Manual_CS);
    put(at + TXD0, word);
    const std::uint32_t reply = look(at + RX_DATA);
    put(at + CONFIG, 0x80000000 | config::Manual_CS | config::PCS);
    return reply;
  };
  b.run([&] {
    put(at + qspi::EN, 1);
    BOOST_TEST(ask(0x05) == 0x000000FFu, "ready");
    BOOST_TEST(ask(0x9F) == 0xFFFFFFFFu);
    b.dut.attach(0, std::make_shared<board::SpiFlash>());
    BOOST_TEST(ask(0x9F) == 0x1640EFFFu);
    BOOST_TEST(look(at + qspi::INTR_STATUS) == qspi::event::TX_FIFO_not_full);
    return 0;
  });
  BOOST_CHECK_THROW(b.dut.attach(1, nullptr), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(a_bitstream_takes_its_time_and_a_phy_is_absent) {
  constexpr std::uint32_t at = devcfg::base, ethernet = gem::gem0_base;
  Alone<ps::Devcfg> b("devcfg", at);
  ps::Gem gem("gem0", b.scheduler);
  b.bus.map("gem0", ethernet, 0x1000).bind(gem.registers.socket);
  b.run([] {
    using namespace devcfg;
    put(at + DMA_SRC_LEN, 1000);
    put(at + DMA_DEST_LEN, 0);
    let_pass(9'000'000);
    BOOST_TEST(look(at + INT_STS) == 0u);
    let_pass(1'200'000);
    BOOST_TEST(look(at + INT_STS) == (event::PCFG_DONE | event::D_P_DONE | event::DMA_DONE));
    put(ethernet + gem::PHY_MAINT, 0x60020000);
    BOOST_TEST((look(ethernet + gem::PHY_MAINT) & 0xFFFF) == 0xFFFFu);
    return 0;
  });
  BOOST_TEST(b.text.str().find("the PL keeps its design") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
