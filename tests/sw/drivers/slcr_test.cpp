#include <drivers/slcr.h>
#include <slcr_registers.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = slcr::base;

/// Registers as a ZedBoard's boot code leaves them, with the lock.
struct Fixture {
  Fixture() {
    fake_hal::reset();
    registers(slcr::ARM_PLL_CTRL) = 0x0002'8008;
    registers(slcr::DDR_PLL_CTRL) = 0x0002'0008;
    registers(slcr::IO_PLL_CTRL) = 0x0001'E008;
    registers(slcr::FPGA0_CLK_CTRL) = 0x0020'0500;
    registers(slcr::PLL_STATUS) = 0x3F;
    fake_hal::state().on_read[base + slcr::SLCR_LOCKSTA] = [this] { return locked ? 1u : 0u; };
    fake_hal::state().on_write[base + slcr::SLCR_LOCK] = [this](std::uint32_t key) {
      locked = locked || key == slcr::lock_key;
    };
    fake_hal::state().on_write[base + slcr::SLCR_UNLOCK] = [this](std::uint32_t key) {
      locked = locked && key != slcr::unlock_key;
    };
    for (const std::uint32_t offset :
         {slcr::FPGA0_CLK_CTRL, slcr::FPGA1_CLK_CTRL, slcr::FPGA1_THR_CNT, slcr::FPGA_RST_CTRL,
          slcr::LVL_SHFTR_EN}) {
      fake_hal::state().on_write[base + offset] = [this, offset](std::uint32_t value) {
        BOOST_TEST(!locked, "a write to a locked register");
        registers(offset) = value;
      };
    }
    driver.initialise({});
  }
  static std::uint32_t& registers(std::uint32_t offset) {
    return fake_hal::state().registers[base + offset];
  }
  bool locked = true;
  drivers::Slcr driver{};
};

constexpr std::uint32_t divide(std::uint32_t divisor0, std::uint32_t divisor1) {
  return divisor0 << slcr::clk_ctrl::DIVISOR0_shift | divisor1 << slcr::clk_ctrl::DIVISOR1_shift;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(slcr_driver, Fixture)

BOOST_AUTO_TEST_CASE(exact_frequencies) {
  const struct {
    std::uint32_t hertz, value;
  } cases[] = {{100'000'000, 0x0020'0500},
               {50'000'000, 0x0040'0500},
               {25'000'000, divide(8, 5)},
               {200'000'000, divide(5, 1)},
               {1'000'000'000, divide(1, 1)}};
  for (const auto& c : cases) {
    BOOST_TEST(driver.set_pl_clock(1, c.hertz) == c.hertz);
    BOOST_TEST(registers(slcr::FPGA1_CLK_CTRL) == c.value);
    BOOST_TEST(driver.pl_clock(1) == c.hertz);
  }
}

BOOST_AUTO_TEST_CASE(the_nearest_of_others) {
  BOOST_TEST(driver.set_pl_clock(1, 74'250'000) == 76'923'077u);  // 1000 / 13; 1000 / 14 is 71.4
  BOOST_TEST(driver.set_pl_clock(1, 73'000'000) == 71'428'571u);
  BOOST_TEST(driver.set_pl_clock(1, 2'000'000'000) == 1'000'000'000u);
  BOOST_TEST(driver.set_pl_clock(1, 1) == 251'953u);
  BOOST_TEST(driver.set_pl_clock(1, 0) == 251'953u);
  BOOST_TEST(registers(slcr::FPGA1_CLK_CTRL) == divide(63, 63));
  // 67 is prime and too large for a divisor: 66 or 68 it is.
  BOOST_TEST(driver.set_pl_clock(1, 14'925'373) == 14'705'882u);
}

BOOST_AUTO_TEST_CASE(the_lock_is_left_as_it_was) {
  driver.set_pl_clock(0, 50'000'000);
  BOOST_TEST(locked);
  locked = false;
  driver.set_pl_clock(0, 100'000'000);
  BOOST_TEST(!locked);
  BOOST_TEST(fake_hal::writes_to(base + slcr::SLCR_LOCK).size() == 1u);
}

BOOST_AUTO_TEST_CASE(frequency_from_any_source) {
  registers(slcr::FPGA0_CLK_CTRL) =
      slcr::peripheral_source::arm_pll << slcr::clk_ctrl::SRCSEL_shift | divide(8, 1);
  BOOST_TEST(driver.pl_clock(0) == 166'666'667u);
  registers(slcr::FPGA0_CLK_CTRL) =
      slcr::peripheral_source::ddr_pll << slcr::clk_ctrl::SRCSEL_shift | divide(0, 0);
  BOOST_TEST(driver.pl_clock(0) == 1'066'666'667u);
  registers(slcr::DDR_PLL_CTRL) |= slcr::pll_ctrl::PLL_BYPASS_FORCE;
  BOOST_TEST(driver.pl_clock(0) == 33'333'333u);
}

BOOST_AUTO_TEST_CASE(frequency_of_the_processors) {
  registers(slcr::ARM_CLK_CTRL) = 0x1F00'0200;
  BOOST_TEST(driver.cpu_clock() == 666'666'667u);
  registers(slcr::ARM_CLK_CTRL) = 0x1F00'0400;
  BOOST_TEST(driver.cpu_clock() == 333'333'333u);
  registers(slcr::ARM_CLK_CTRL) =
      slcr::cpu_source::ddr_pll << slcr::clk_ctrl::SRCSEL_shift | divide(2, 0);
  BOOST_TEST(driver.cpu_clock() == 533'333'333u);
  registers(slcr::ARM_CLK_CTRL) =
      slcr::cpu_source::io_pll << slcr::clk_ctrl::SRCSEL_shift | divide(2, 0);
  BOOST_TEST(driver.cpu_clock() == 500'000'000u);
  registers(slcr::IO_PLL_CTRL) |= slcr::pll_ctrl::PLL_PWRDWN;
  BOOST_TEST(driver.cpu_clock() == 0u);
}

BOOST_AUTO_TEST_CASE(refusals_change_nothing) {
  BOOST_TEST(driver.set_pl_clock(4, 50'000'000) == 0u);
  BOOST_TEST(driver.pl_clock(4) == 0u);
  driver.gate_pl_clock(4, true);
  driver.reset_pl(4, true);
  registers(slcr::IO_PLL_CTRL) |= slcr::pll_ctrl::PLL_RESET;
  BOOST_TEST(driver.set_pl_clock(1, 50'000'000) == 0u);
  BOOST_TEST(driver.pl_clock(0) == 0u);
  for (const fake_hal::Access& access : fake_hal::state().accesses) BOOST_TEST(!access.write);
}

BOOST_AUTO_TEST_CASE(gate_and_resets_and_level_shifters) {
  driver.gate_pl_clock(1, true);
  BOOST_TEST(registers(slcr::FPGA1_THR_CNT) == 1u);
  driver.gate_pl_clock(1, false);
  BOOST_TEST(registers(slcr::FPGA1_THR_CNT) == 0u);
  driver.reset_pl(0, true);
  driver.reset_pl(2, true);
  BOOST_TEST(registers(slcr::FPGA_RST_CTRL) == 5u);
  driver.reset_pl(0, false);
  BOOST_TEST(registers(slcr::FPGA_RST_CTRL) == 4u);
  driver.enable_level_shifters(true);
  BOOST_TEST(registers(slcr::LVL_SHFTR_EN) == 0xFu);
  driver.enable_level_shifters(false);
  BOOST_TEST(registers(slcr::LVL_SHFTR_EN) == 0u);
  BOOST_TEST(locked);
}

BOOST_AUTO_TEST_CASE(waiting_for_the_plls_has_an_end) {
  BOOST_TEST(driver.wait_for_plls(1));
  unsigned reads = 0;
  fake_hal::state().on_read[base + slcr::PLL_STATUS] = [&] { return ++reads < 4 ? 0x3Bu : 0x3Fu; };
  BOOST_TEST(!driver.wait_for_plls(3));
  BOOST_TEST(driver.wait_for_plls(1));
}

BOOST_AUTO_TEST_SUITE_END()
