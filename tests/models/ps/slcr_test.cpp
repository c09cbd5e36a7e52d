// Registers of the SLCR: values, lock, resets, level shifters.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>

#include "register_policy.h"
#include "slcr_bench.h"

using namespace bench;

namespace {

/// Registers whose value is a build option.
bool is_build_option(std::uint32_t offset) {
  return offset == slcr::BOOT_MODE || offset == slcr::PSS_IDCODE;
}
/// Registers that end the program.
bool ends_the_program(std::uint32_t offset) {
  return offset == slcr::PSS_RST_CTRL || offset == slcr::A9_CPU_RST_CTRL;
}
bool is_key(std::uint32_t offset) {
  return offset == slcr::SLCR_LOCK || offset == slcr::SLCR_UNLOCK;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(slcr_registers)

BOOST_AUTO_TEST_CASE(reset_values) {
  SlcrBench b(without_boot_code);
  b.run([] {
    for (const vp::RegisterInfo& info : slcr::registers) {
      if (is_build_option(info.offset)) continue;
      BOOST_TEST(get(info.offset) == seen_after_reset(info), info.name);
    }
    BOOST_TEST(get(slcr::PSS_IDCODE) == 0x0372'7093u);
    BOOST_TEST(get(slcr::BOOT_MODE) == 5u);
    BOOST_TEST(get(0x1B0) == 0u, "a hole");
    return 0;
  });
  BOOST_TEST(!b.slcr.fclk_reset0_n.get());
  BOOST_TEST(!b.slcr.fclk_reset3_n.get());
  BOOST_TEST(!b.slcr.level_shifters.on());
}

BOOST_AUTO_TEST_CASE(build_options) {
  SlcrBench b({"slcr.boot_mode=0x11", "slcr.idcode=0x13722093"});
  b.run([] {
    BOOST_TEST(get(slcr::BOOT_MODE) == 0x11u);
    BOOST_TEST(get(slcr::PSS_IDCODE) == 0x1372'2093u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(boot_code_leaves_the_values_of_a_zedboard) {
  SlcrBench b;
  b.run([] {
    BOOST_TEST(get(slcr::SLCR_LOCKSTA) == 1u);
    BOOST_TEST(get(slcr::ARM_PLL_CTRL) == 0x0002'8008u);
    BOOST_TEST(get(slcr::DDR_PLL_CTRL) == 0x0002'0008u);
    BOOST_TEST(get(slcr::IO_PLL_CTRL) == 0x0001'E008u);
    BOOST_TEST(get(slcr::ARM_CLK_CTRL) == 0x1F00'0200u);
    BOOST_TEST(get(slcr::FPGA0_CLK_CTRL) == 0x0020'0500u);  // 100 MHz: 1000 / 5 / 2
    BOOST_TEST(get(slcr::FPGA1_CLK_CTRL) == 0x0040'0500u);  // 50 MHz: 1000 / 5 / 4
    BOOST_TEST(get(slcr::FPGA_RST_CTRL) == 0u);
    BOOST_TEST(get(slcr::LVL_SHFTR_EN) == 0xFu);
    BOOST_TEST(get(slcr::UART_CLK_CTRL) == 0x1403u);
    return 0;
  });
  BOOST_TEST(b.slcr.fclk_reset0_n.get());
  BOOST_TEST(b.slcr.level_shifters.on());
  BOOST_TEST(b.fclk0.frequency_hz() == 100'000'000u);
  BOOST_TEST(b.fclk1.frequency_hz() == 50'000'000u);
  BOOST_TEST(b.reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_AUTO_TEST_CASE(locked_registers_ignore_writes_and_say_so) {
  SlcrBench b(without_boot_code);
  unsigned attempts = 0;
  b.run([&] {
    for (const vp::RegisterInfo& info : slcr::registers) {
      if (is_key(info.offset) || info.access == vp::Access::read_only) continue;
      const std::uint32_t before = get(info.offset);
      set(info.offset, ~before);
      ++attempts;
      BOOST_TEST(get(info.offset) == before, info.name);
    }
    return 0;
  });
  BOOST_TEST(b.warnings("/markervp/slcr/locked") == attempts);
  BOOST_TEST(b.text.str().find("0xFFFFFFFE written to FPGA0_THR_CTRL is ignored") ==
             std::string::npos);
  BOOST_TEST(b.text.str().find("the registers are locked; write 0xDF0D to SLCR_UNLOCK first") !=
             std::string::npos);
  BOOST_TEST(b.fclk1.frequency_hz() == 36'111'111u, "866.67 MHz / 24, as after reset");
}

BOOST_AUTO_TEST_CASE(keys) {
  SlcrBench b;
  b.run([] {
    set(slcr::SLCR_UNLOCK, slcr::lock_key);
    BOOST_TEST(get(slcr::SLCR_LOCKSTA) == 1u);
    set(slcr::SLCR_UNLOCK, 0xABCD'0000 | slcr::unlock_key);  // the upper half does not count
    BOOST_TEST(get(slcr::SLCR_LOCKSTA) == 0u);
    BOOST_TEST(get(slcr::SLCR_UNLOCK) == 0u);
    set(slcr::SLCR_LOCK, slcr::unlock_key);
    BOOST_TEST(get(slcr::SLCR_LOCKSTA) == 0u);
    set(slcr::SLCR_LOCK, slcr::lock_key);
    BOOST_TEST(get(slcr::SLCR_LOCKSTA) == 1u);
    BOOST_TEST(get(slcr::SLCR_LOCK) == 0u);
    return 0;
  });
  BOOST_TEST(b.warnings("/markervp/slcr/key") == 2u);
}

BOOST_AUTO_TEST_CASE(every_bit_of_every_register) {
  SlcrBench b(without_boot_code);
  b.run([] {
    unlock();
    for (const vp::RegisterInfo& info : slcr::registers) {
      if (info.access != vp::Access::read_write || ends_the_program(info.offset) ||
          info.offset == slcr::SCL) {
        continue;
      }
      check_stored_bits(slcr_at, info);
    }
    for (const std::uint32_t offset : {slcr::DDR_CAL_START, slcr::DDR_REF_START}) {
      set(offset, 3);
      BOOST_TEST(get(offset) == 0u);
    }
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(read_only_registers_keep_their_values) {
  SlcrBench b;
  b.run([] {
    unlock();
    for (const vp::RegisterInfo& info : slcr::registers) {
      if (info.access != vp::Access::read_only) continue;
      const std::uint32_t before = get(info.offset);
      set(info.offset, ~before);
      BOOST_TEST(get(info.offset) == before, info.name);
    }
    return 0;
  });
  BOOST_TEST(b.warnings("/markervp/register_bank/ignored_write") > 0u);
}

BOOST_AUTO_TEST_CASE(the_secure_lock_holds_until_power_on) {
  SlcrBench b;
  b.run([] {
    unlock();
    set(slcr::APU_CTRL, 1);
    BOOST_TEST(get(slcr::APU_CTRL) == 1u);
    set(slcr::SCL, 1);
    set(slcr::SCL, 0);
    BOOST_TEST(get(slcr::SCL) == 1u);
    set(slcr::APU_CTRL, 2);
    set(slcr::PSS_RST_CTRL, 1);
    set(slcr::WDT_CLK_SEL, 1);
    BOOST_TEST(get(slcr::APU_CTRL) == 1u);
    BOOST_TEST(get(slcr::WDT_CLK_SEL) == 0u);
    set(slcr::TZ_DMA_NS, 1);
    BOOST_TEST(get(slcr::TZ_DMA_NS) == 1u, "others are free");
    return 0;
  });
  BOOST_TEST(b.warnings("/markervp/slcr/locked") == 3u);
}

BOOST_AUTO_TEST_CASE(resets_to_the_pl_at_the_time_of_the_write) {
  SlcrBench b;
  Changes<bool> reset0(b.slcr.fclk_reset0_n, b.scheduler),
      reset2(b.slcr.fclk_reset2_n, b.scheduler);
  b.run([] {
    unlock();
    after(100);
    set(slcr::FPGA_RST_CTRL, 5);
    after(100);
    set(slcr::FPGA_RST_CTRL, 4);
    after(100);
    set(slcr::FPGA_RST_CTRL, 0);
    after(100);
    return 0;
  });
  using Times = std::vector<std::uint64_t>;
  BOOST_TEST(reset0.times == (Times{100'000, 200'000}), boost::test_tools::per_element());
  BOOST_TEST(reset2.times == (Times{100'000, 300'000}), boost::test_tools::per_element());
  BOOST_TEST(b.slcr.fclk_reset1_n.get());
}

BOOST_AUTO_TEST_CASE(resets_of_the_uarts) {
  SlcrBench b;
  b.run([&] {
    unlock();
    set(slcr::UART_RST_CTRL, 1);
    BOOST_TEST((b.slcr.uart0_rst.get() && !b.slcr.uart1_rst.get()));
    set(slcr::UART_RST_CTRL, 8);
    BOOST_TEST((!b.slcr.uart0_rst.get() && b.slcr.uart1_rst.get()));
    set(slcr::UART_RST_CTRL, 0);
    BOOST_TEST((!b.slcr.uart0_rst.get() && !b.slcr.uart1_rst.get()));
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(an_access_with_the_level_shifters_off_is_a_hang) {
  SlcrBench b;
  b.slcr.level_shifters.guard(*b.bus.find(device_address)->link);
  b.run(
      [] {
        hal_write32(device_address, 1);
        unlock();
        set(slcr::LVL_SHFTR_EN, slcr::lvl_shftr_en::ps_to_pl);
        set(slcr::LVL_SHFTR_EN, slcr::lvl_shftr_en::all);
        hal_write32(device_address, 2);
        set(slcr::LVL_SHFTR_EN, slcr::lvl_shftr_en::ps_to_pl);
        return static_cast<int>(hal_read32(device_address + 8));
      },
      false);
  BOOST_TEST(b.device.log.size() == 2u);
  BOOST_TEST(b.failure().find("bus hang: read of ") == 0u, b.failure());
  BOOST_TEST(b.failure().find("the level shifters between PS and PL are off (LVL_SHFTR_EN is "
                              "0x0000000A): write 0xF to it first") != std::string::npos,
             b.failure());
}

BOOST_AUTO_TEST_CASE(without_boot_code_the_level_shifters_are_off) {
  SlcrBench b(without_boot_code);
  b.slcr.level_shifters.guard(*b.bus.find(device_address)->link);
  b.run([] { return static_cast<int>(hal_read32(device_address)); }, false);
  BOOST_TEST(b.failure().find("LVL_SHFTR_EN is 0x00000000") != std::string::npos, b.failure());
}

BOOST_AUTO_TEST_CASE(a_reset_of_the_processor_ends_the_run) {
  const struct {
    std::uint32_t offset, value;
    const char* what;
  } cases[] = {{slcr::PSS_RST_CTRL, 1, "resets the processing system (PSS_RST_CTRL)"},
               {slcr::A9_CPU_RST_CTRL, 0x01, "resets its own processor"},
               {slcr::A9_CPU_RST_CTRL, 0x10, "stops the clock of its own processor"}};
  for (const auto& c : cases) {
    SlcrBench b;
    b.run(
        [&] {
          unlock();
          set(c.offset, c.value);
          return 0;
        },
        false);
    BOOST_CHECK_THROW(b.cpu.check(), vp::ProtocolError);
    BOOST_TEST(b.failure().find(c.what) != std::string::npos, b.failure());
  }
}

BOOST_AUTO_TEST_CASE(the_second_processor_may_be_held_in_reset) {
  SlcrBench b;
  b.run([] {
    unlock();
    set(slcr::A9_CPU_RST_CTRL, 0x122);
    BOOST_TEST(get(slcr::A9_CPU_RST_CTRL) == 0x122u);
    return 0;
  });
}

// What the tables of a board's boot code (ps7_init) write and wait for, in their order: the polls
// on the DDR controller aside, which has no model.
BOOST_AUTO_TEST_CASE(every_wait_of_the_boot_code_ends) {
  SlcrBench b(without_boot_code);
  b.run([] {
    const auto mask_write = [](std::uint32_t offset, std::uint32_t mask, std::uint32_t value) {
      set(offset, (get(offset) & ~mask) | value);
    };
    const auto wait_for = [](std::uint32_t offset, std::uint32_t bits) {
      for (unsigned us = 0; us < 100; ++us, after(1000)) {
        if ((get(offset) & bits) == bits) return true;
      }
      return false;
    };
    unlock();
    const struct {
      std::uint32_t ctrl, cfg, cfg_value, fdiv;
    } plls[] = {{slcr::ARM_PLL_CTRL, slcr::ARM_PLL_CFG, 0x000FA220, 0x28000},
                {slcr::DDR_PLL_CTRL, slcr::DDR_PLL_CFG, 0x0012C220, 0x20000},
                {slcr::IO_PLL_CTRL, slcr::IO_PLL_CFG, 0x001452C0, 0x1E000}};
    for (unsigned n = 0; n < 3; ++n) {
      mask_write(plls[n].cfg, 0x003FFFF0, plls[n].cfg_value);
      mask_write(plls[n].ctrl, slcr::pll_ctrl::PLL_FDIV, plls[n].fdiv);
      mask_write(plls[n].ctrl, slcr::pll_ctrl::PLL_BYPASS_FORCE, slcr::pll_ctrl::PLL_BYPASS_FORCE);
      mask_write(plls[n].ctrl, slcr::pll_ctrl::PLL_RESET, slcr::pll_ctrl::PLL_RESET);
      BOOST_TEST((get(slcr::PLL_STATUS) & slcr::pll_status::LOCK << n) == 0u);
      mask_write(plls[n].ctrl, slcr::pll_ctrl::PLL_RESET, 0);
      BOOST_TEST(wait_for(slcr::PLL_STATUS, slcr::pll_status::LOCK << n));
      mask_write(plls[n].ctrl, slcr::pll_ctrl::PLL_BYPASS_FORCE, 0);
    }
    BOOST_TEST(get(slcr::DDRIOB_DCI_STATUS) == 0u);
    mask_write(slcr::DDRIOB_DCI_CTRL, 0x00000001, 0x00000001);
    mask_write(slcr::DDRIOB_DCI_CTRL, 0x00000021, 0x00000020);
    BOOST_TEST(get(slcr::DDRIOB_DCI_STATUS) == 0u);
    mask_write(slcr::DDRIOB_DCI_CTRL, 0x07FEFFFF, 0x00000823);
    BOOST_TEST(wait_for(slcr::DDRIOB_DCI_STATUS, slcr::ddriob_dci_status::DONE));
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_impedances_are_calibrated_while_enabled_and_reset_once) {
  using namespace slcr::ddriob_dci_ctrl;
  static constexpr std::uint32_t calibrated =
      slcr::ddriob_dci_status::DONE | slcr::ddriob_dci_status::LOCK;
  SlcrBench b(without_boot_code);
  b.run([] {
    const auto status_after = [](std::uint32_t ctrl) {
      set(slcr::DDRIOB_DCI_CTRL, ctrl);
      return get(slcr::DDRIOB_DCI_STATUS);
    };
    unlock();
    BOOST_TEST(status_after(ENABLE) == 0u);
    BOOST_TEST(status_after(RESET | ENABLE) == 0u, "RESET did not fall yet");
    BOOST_TEST(status_after(ENABLE) == 0u);
    BOOST_TEST(status_after(RESET | ENABLE) == calibrated);
    BOOST_TEST(status_after(RESET | ENABLE | UPDATE_CONTROL) == 0u);
    BOOST_TEST(status_after(RESET) == 0u);
    BOOST_TEST(status_after(RESET | ENABLE) == calibrated);
    set(slcr::SLCR_LOCK, slcr::lock_key);
    BOOST_TEST(status_after(0) == calibrated, "the lock holds");
    return 0;
  });
  SlcrBench booted;
  booted.run([] {
    BOOST_TEST(get(slcr::DDRIOB_DCI_CTRL) == 0x0000'0823u);
    BOOST_TEST(get(slcr::DDRIOB_DCI_STATUS) == calibrated, "boot code has set up the DDR");
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(boot_code_leaves_192_KiB_of_on_chip_memory_at_0) {
  SlcrBench b;
  b.run([] {
    BOOST_TEST(get(slcr::OCM_CFG) == 8u);
    unlock();
    set(slcr::OCM_CFG, 0x1F);
    BOOST_TEST(get(slcr::OCM_CFG) == 0x1Fu);
    return 0;
  });
}

// On at reset but for pins 2 to 8, which choose how the chip boots (UG585, table 6-4); software
// switches those of unlocked registers.
BOOST_AUTO_TEST_CASE(pull_ups_follow_their_registers) {
  SlcrBench b;
  std::uint64_t on = 0;
  b.slcr.on_pull_up([&on](unsigned pin, bool is_on) {
    const std::uint64_t bit = std::uint64_t{1} << pin;
    on = is_on ? on | bit : on & ~bit;
  });
  constexpr std::uint64_t all = slcr::mio_pin::pull_ups_at_reset;
  BOOST_TEST(on == all);
  b.run([&] {
    set(slcr::MIO_PIN(50), 0x0600);
    get(slcr::MIO_PIN(50));
    BOOST_TEST(on == all, "locked");
    unlock();
    set(slcr::MIO_PIN(50), 0x0600);
    set(slcr::MIO_PIN(51), 0x1600);
    get(slcr::MIO_PIN(50));
    BOOST_TEST(on == (all & ~(std::uint64_t{1} << 50)));
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(boot_code_switches_the_pull_ups_that_are_set) {
  const std::string setting = "slcr.mio_pull_ups=0x20000000000004";  // pins 2 and 53
  SlcrBench booted({setting});
  booted.run([] {
    BOOST_TEST(get(slcr::MIO_PIN(2)) == 0x1601u);
    BOOST_TEST(get(slcr::MIO_PIN(9)) == 0x0601u);
    BOOST_TEST(get(slcr::MIO_PIN(53)) == 0x1601u);
    return 0;
  });
  SlcrBench bare({setting, without_boot_code.front()});
  bare.run([] {
    BOOST_TEST(get(slcr::MIO_PIN(2)) == 0x0601u);
    BOOST_TEST(get(slcr::MIO_PIN(9)) == 0x1601u);
    return 0;
  });
  BOOST_CHECK_THROW(SlcrBench({"slcr.mio_pull_ups=0x40000000000000"}), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
