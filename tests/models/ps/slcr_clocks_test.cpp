// Clocks of the SLCR: what software programs, the clocks of the simulation do.
#include <ps/slcr/slcr_clocks.h>
#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <tuple>

#include "slcr_bench.h"

using namespace bench;
using ps::clock_tree::Dividers;
using ps::clock_tree::PllOutputs;

namespace {

constexpr PllOutputs zedboard{100e6 / 3 * 40, 100e6 / 3 * 32, 100e6 / 3 * 30};
constexpr std::uint32_t arm = slcr::peripheral_source::arm_pll << slcr::clk_ctrl::SRCSEL_shift;
constexpr std::uint32_t ddr = slcr::peripheral_source::ddr_pll << slcr::clk_ctrl::SRCSEL_shift;

constexpr std::uint32_t divide(std::uint32_t divisor0, std::uint32_t divisor1) {
  return divisor0 << slcr::clk_ctrl::DIVISOR0_shift | divisor1 << slcr::clk_ctrl::DIVISOR1_shift;
}
constexpr std::uint32_t feedback(std::uint32_t divider) {
  return divider << slcr::pll_ctrl::PLL_FDIV_shift | slcr::pll_ctrl::PLL_BYPASS_QUAL;
}

/// Counts the edges of a clock.
class EdgeCounter : public vp::Clocked {
 public:
  EdgeCounter(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) {}
  std::vector<std::uint64_t> times;

 private:
  void edge() override { times.push_back(clock().scheduler().now_ps()); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(slcr_clocks)

BOOST_AUTO_TEST_CASE(published_divider_values) {
  const auto value = [](std::uint64_t hertz) {
    return ps::clock_tree::nearest_dividers(hertz, zedboard).clk_ctrl();
  };
  BOOST_TEST(value(100'000'000) == 0x0020'0500u);  // ZedBoard
  BOOST_TEST(value(50'000'000) == 0x0040'0500u);   // ZC702
  BOOST_TEST(value(1'000'000'000) == 0x0010'0100u);
  BOOST_TEST(value(10'000'000) == divide(10, 10));
}

BOOST_AUTO_TEST_CASE(nearest_dividers_try_all_three_plls) {
  const Dividers d = ps::clock_tree::nearest_dividers(148'500'000, zedboard);
  BOOST_TEST(d.source == slcr::peripheral_source::arm_pll);
  BOOST_TEST(d.divisor0 * d.divisor1 == 9u);
  BOOST_TEST(d.hertz == 148'148'148u);
  const Dividers slow = ps::clock_tree::nearest_dividers(1, zedboard);
  BOOST_TEST(slow.divisor0 * slow.divisor1 == 63u * 63u);
  const Dividers fast = ps::clock_tree::nearest_dividers(5'000'000'000, zedboard);
  BOOST_TEST(fast.hertz == 1'333'333'333u);
}

BOOST_AUTO_TEST_CASE(cpu_divisors) {
  BOOST_TEST(ps::clock_tree::nearest_cpu_divisor(666'666'667, zedboard.arm) == 2u);
  BOOST_TEST(ps::clock_tree::nearest_cpu_divisor(333'333'333, zedboard.arm) == 4u);
  BOOST_TEST(ps::clock_tree::nearest_cpu_divisor(1'333'333'333, zedboard.arm) == 2u, "1 is not");
  BOOST_TEST(ps::clock_tree::nearest_cpu_divisor(1, zedboard.arm) == 63u);
}

BOOST_AUTO_TEST_CASE(software_sets_the_clocks_of_the_pl) {
  SlcrBench b;
  b.run([&] {
    unlock();
    const auto check = [&](std::uint32_t value, std::uint64_t hertz) {
      set(slcr::FPGA1_CLK_CTRL, value);
      BOOST_TEST(b.fclk1.frequency_hz() == hertz);
    };
    check(divide(5, 2), 100'000'000);
    check(divide(10, 4), 25'000'000);
    check(divide(63, 63), 251'953);
    check(divide(1, 1), 1'000'000'000);
    check(arm | divide(9, 1), 148'148'148);
    check(ddr | divide(8, 1), 133'333'333);
    check(1u << slcr::clk_ctrl::SRCSEL_shift | divide(20, 1), 50'000'000);  // 01 is the IO PLL, too
    BOOST_TEST(b.fclk0.frequency_hz() == 100'000'000u, "the other clock stays");
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_divisor_of_0_divides_by_1) {
  SlcrBench b;
  b.run([&] {
    unlock();
    set(slcr::FPGA1_CLK_CTRL, divide(0, 10));
    BOOST_TEST(b.fclk1.frequency_hz() == 100'000'000u);
    set(slcr::FPGA1_CLK_CTRL, divide(10, 0));
    BOOST_TEST(b.fclk1.frequency_hz() == 100'000'000u);
    set(slcr::FPGA1_CLK_CTRL, 0);
    BOOST_TEST(b.fclk1.frequency_hz() == 1'000'000'000u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_new_period_counts_from_the_write) {
  SlcrBench b;
  EdgeCounter edges("edges", b.fclk1);
  b.run([] {
    unlock();
    after(45);  // edges at 20 and 40 ns
    set(slcr::FPGA1_CLK_CTRL, divide(10, 10));
    after(255);
    return 0;
  });
  const std::vector<std::uint64_t> expected{20'000, 40'000, 145'000, 245'000};
  BOOST_TEST(edges.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_frequency_that_no_dividers_give_stays_until_the_register_is_written) {
  SlcrBench b({}, 74'250'000);
  b.run([&] {
    BOOST_TEST(get(slcr::FPGA1_CLK_CTRL) == (arm | divide(6, 3)), "74.074 MHz");
    unlock();
    set(slcr::IO_PLL_CTRL, feedback(30));  // its own PLL is another
    BOOST_TEST(b.fclk1.frequency_hz() == 74'250'000u);
    set(slcr::FPGA1_CLK_CTRL, get(slcr::FPGA1_CLK_CTRL));
    BOOST_TEST(b.fclk1.frequency_hz() == 74'074'074u);
    return 0;
  });
  BOOST_TEST(b.reports.count("/markervp/slcr/inexact") == 1u);
  BOOST_TEST(b.reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_AUTO_TEST_CASE(pll_values_are_those_that_boot_code_writes) {
  SlcrBench b;
  b.run([&] {
    for (const auto& [feedback, ctrl, cfg] :
         {std::tuple{40u, slcr::ARM_PLL_CTRL, slcr::ARM_PLL_CFG},
          std::tuple{32u, slcr::DDR_PLL_CTRL, slcr::DDR_PLL_CFG},
          std::tuple{30u, slcr::IO_PLL_CTRL, slcr::IO_PLL_CFG}}) {
      BOOST_TEST(ps::clock_tree::pll_ctrl_of(feedback) == get(ctrl));
      BOOST_TEST(ps::clock_tree::pll_cfg_of(feedback) == get(cfg));
    }
    return 0;
  });
  BOOST_TEST(ps::clock_tree::pll_cfg_of(13) == 0x002E'E260u);
  BOOST_TEST(ps::clock_tree::pll_cfg_of(48) == 0x000F'A240u);
  BOOST_TEST(ps::clock_tree::pll_cfg_of(66) == 0x000F'A240u);
}

BOOST_AUTO_TEST_CASE(boot_code_may_choose_other_plls_and_dividers) {
  BootedSlcr b({48, 48, 32});
  vp::Clock pixel("pixel", b.scheduler, 55'172'414);
  b.slcr.drive_fclk(1, pixel, Dividers{slcr::peripheral_source::io_pll, 29, 1, 55'172'414});
  b.run([&] {
    BOOST_TEST(get(slcr::ARM_PLL_CTRL) == feedback(48));
    BOOST_TEST(get(slcr::IO_PLL_CTRL) == feedback(48));
    BOOST_TEST(get(slcr::FPGA1_CLK_CTRL) == divide(29, 1));
    BOOST_TEST(pixel.frequency_hz() == 55'172'414u);
    BOOST_TEST(b.uart_ref.frequency_hz() == 50'000'000u);  // 1600 MHz / 32
    unlock();
    set(slcr::FPGA1_CLK_CTRL, get(slcr::FPGA1_CLK_CTRL));
    BOOST_TEST(pixel.frequency_hz() == 55'172'414u);
    set(slcr::FPGA1_CLK_CTRL, divide(8, 4));
    BOOST_TEST(pixel.frequency_hz() == 50'000'000u);
    return 0;
  });
  BOOST_TEST(b.reports.count("/markervp/slcr/inexact") == 0u);
}

BOOST_AUTO_TEST_CASE(another_crystal) {
  SlcrBench b({"slcr.ps_clk=50 MHz"});
  b.run([&] {
    unlock();
    set(slcr::FPGA0_CLK_CTRL, divide(5, 2));
    BOOST_TEST(b.fclk0.frequency_hz() == 150'000'000u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_pll_locks_after_its_count_of_the_crystal) {
  SlcrBench b;
  b.run([&] {
    unlock();
    const std::uint32_t io_lock = slcr::pll_status::LOCK << 2,
                        io_stable = slcr::pll_status::STABLE << 2;
    BOOST_TEST(get(slcr::PLL_STATUS) == 0x3Fu);
    set(slcr::IO_PLL_CFG, 300u << slcr::pll_cfg::LOCK_CNT_shift);
    set(slcr::IO_PLL_CTRL, feedback(32) | slcr::pll_ctrl::PLL_BYPASS_FORCE);
    BOOST_TEST(get(slcr::PLL_STATUS) == 0x3Fu, "bypassed, but still locked");
    BOOST_TEST(b.fclk0.frequency_hz() == 3'333'333u, "the crystal behind the dividers");
    set(slcr::IO_PLL_CTRL,
        feedback(32) | slcr::pll_ctrl::PLL_BYPASS_FORCE | slcr::pll_ctrl::PLL_RESET);
    BOOST_TEST(get(slcr::PLL_STATUS) == (0x3Fu & ~io_lock));
    set(slcr::IO_PLL_CTRL, feedback(32) | slcr::pll_ctrl::PLL_BYPASS_FORCE);
    after(8999);  // 300 cycles of 30 ns
    BOOST_TEST(get(slcr::PLL_STATUS) == (0x3Fu & ~io_lock), "stable, for it is bypassed");
    after(1);
    BOOST_TEST(get(slcr::PLL_STATUS) == 0x3Fu);
    set(slcr::IO_PLL_CTRL, feedback(32));
    BOOST_TEST(b.fclk0.frequency_hz() == 106'666'667u);
    BOOST_TEST(b.fclk1.frequency_hz() == 53'333'333u);
    BOOST_TEST(b.uart_ref.frequency_hz() == 53'333'333u);
    set(slcr::IO_PLL_CTRL, feedback(32) | slcr::pll_ctrl::PLL_PWRDWN);
    BOOST_TEST(get(slcr::PLL_STATUS) == (0x3Fu & ~io_lock & ~io_stable));
    BOOST_TEST(b.fclk0.frequency_hz() == 0u, "no source, no clock");
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_feedback_divider_needs_a_reset_to_take_effect) {
  SlcrBench b;
  b.run([&] {
    unlock();
    set(slcr::IO_PLL_CTRL, feedback(45));
    BOOST_TEST(b.fclk0.frequency_hz() == 100'000'000u);
    BOOST_TEST(get(slcr::PLL_STATUS) == 0x3Fu);
    set(slcr::IO_PLL_CTRL, feedback(45) | slcr::pll_ctrl::PLL_RESET);
    set(slcr::IO_PLL_CTRL, feedback(45));
    BOOST_TEST(b.fclk0.frequency_hz() == 150'000'000u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_throttle_gives_a_number_of_clocks_and_stops) {
  SlcrBench b;
  EdgeCounter edges("edges", b.fclk1);
  b.run([&] {
    unlock();
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 0x0001'0000u);
    after(30);  // an edge at 20 ns
    set(slcr::FPGA1_THR_CNT, 5);
    BOOST_TEST(b.fclk1.frequency_hz() == 0u);
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 0u);
    after(1000);
    set(slcr::FPGA1_THR_CTRL, slcr::thr_ctrl::CPU_START);
    BOOST_TEST((get(slcr::FPGA1_THR_STA) & slcr::thr::RUNNING) != 0u);
    after(1000);
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 5u);
    set(slcr::FPGA1_THR_CTRL, slcr::thr_ctrl::CPU_START);  // no change from 0 to 1
    after(1000);
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 5u);
    set(slcr::FPGA1_THR_CTRL, 0);
    set(slcr::FPGA1_THR_CNT, 2);
    set(slcr::FPGA1_THR_CTRL, slcr::thr_ctrl::CPU_START);
    after(1000);
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 2u);
    set(slcr::FPGA1_THR_CNT, 0);
    after(30);
    BOOST_TEST(b.fclk1.frequency_hz() == 50'000'000u);
    BOOST_TEST(get(slcr::FPGA1_THR_STA) == 0x0001'0000u);
    return 0;
  });
  const std::vector<std::uint64_t> expected{20'000,    1'050'000, 1'070'000,
                                            1'090'000, 1'110'000, 1'130'000,  // 1 and 5
                                            3'050'000, 3'070'000,             // 2
                                            4'050'000};
  BOOST_TEST(edges.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_cpu) {
  SlcrBench b;
  b.slcr.drive_cpu(b.cpu_clock);
  b.run([&] {
    BOOST_TEST(get(slcr::ARM_CLK_CTRL) == 0x1F00'0200u, "nearest to the bench's 1 GHz");
    BOOST_TEST(b.cpu_clock.frequency_hz() == 1'000'000'000u);
    unlock();
    set(slcr::ARM_CLK_CTRL, 0x1F00'0400);
    BOOST_TEST(b.cpu_clock.frequency_hz() == 333'333'333u);
    const std::uint64_t before = now_ps();
    hal_work(step, 1'000'000);
    hal_barrier();
    BOOST_TEST(now_ps() - before > 3'000'000'000u);
    set(slcr::ARM_CLK_CTRL, 0x1F00'0230);  // IO PLL
    BOOST_TEST(b.cpu_clock.frequency_hz() == 500'000'000u);
    set(slcr::ARM_CLK_CTRL, 0x1F00'0220);  // DDR PLL
    BOOST_TEST(b.cpu_clock.frequency_hz() == 533'333'333u);
    BOOST_TEST(b.warnings("/markervp/slcr/cpu_divisor") == 0u);
    set(slcr::ARM_CLK_CTRL, 0x1F00'0300);
    BOOST_TEST(b.warnings("/markervp/slcr/cpu_divisor") == 1u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_ratio_of_cpu_clocks) {
  SlcrBench b;
  b.run([&] {
    ps::Slcr::CpuClocks clocks = b.slcr.cpu_clocks();
    BOOST_TEST(clocks.cpu_6x4x == 666'666'667u);
    BOOST_TEST(clocks.cpu_3x2x == 333'333'333u);
    BOOST_TEST(clocks.cpu_2x == 222'222'222u);
    BOOST_TEST(clocks.cpu_1x == 111'111'111u);
    unlock();
    set(slcr::CLK_621_TRUE, 0);
    clocks = b.slcr.cpu_clocks();
    BOOST_TEST(clocks.cpu_2x == 333'333'333u);
    BOOST_TEST(clocks.cpu_1x == 166'666'667u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(who_stops_the_processor_s_clock_ends_the_run) {
  for (const bool by_gate : {true, false}) {
    SlcrBench b;
    b.slcr.drive_cpu(b.cpu_clock);
    b.run(
        [&] {
          unlock();
          if (by_gate) {
            set(slcr::ARM_CLK_CTRL, 0x0000'0200);
          } else {
            set(slcr::ARM_PLL_CTRL, feedback(40) | slcr::pll_ctrl::PLL_RESET);
          }
          return 0;
        },
        false);
    BOOST_TEST(b.failure().find("stops the clock of its own processor") != std::string::npos,
               b.failure());
  }
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_uarts) {
  SlcrBench b;
  b.run([&] {
    BOOST_TEST(b.uart_ref.frequency_hz() == 50'000'000u);
    unlock();
    set(slcr::UART_CLK_CTRL, 0x0A02);
    BOOST_TEST(b.uart_ref.frequency_hz() == 100'000'000u);
    set(slcr::UART_CLK_CTRL, 0x0A01);  // UART 0 only
    BOOST_TEST(b.uart_ref.frequency_hz() == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(without_boot_code_the_clocks_are_those_of_the_silicon) {
  SlcrBench b(without_boot_code);
  b.slcr.drive_cpu(b.cpu_clock);
  BOOST_TEST(b.fclk0.frequency_hz() == 36'111'111u);
  BOOST_TEST(b.cpu_clock.frequency_hz() == 216'666'667u);
  BOOST_TEST(b.uart_ref.frequency_hz() == 13'756'614u);
}

BOOST_AUTO_TEST_CASE(a_clock_that_is_too_fast_or_has_no_source) {
  SlcrBench b;
  b.slcr.limit_fclk(250'000'000);
  b.run([] {
    hal_write32(slcr_at + slcr::SLCR_UNLOCK, slcr::unlock_key);
    hal_write32(slcr_at + slcr::FPGA0_CLK_CTRL, divide(4, 1));                          // 250 MHz
    hal_write32(slcr_at + slcr::FPGA0_CLK_CTRL + 3 * slcr::fclk_stride, divide(1, 1));  // unused
    return 0;
  });
  BOOST_TEST(b.warnings("/markervp/slcr/fclk_too_fast") == 0u);
  SlcrBench fast;
  fast.slcr.limit_fclk(250'000'000);
  fast.run([] {
    hal_write32(slcr_at + slcr::SLCR_UNLOCK, slcr::unlock_key);
    hal_write32(slcr_at + slcr::FPGA0_CLK_CTRL, divide(3, 1));
    hal_write32(slcr_at + slcr::FPGA0_CLK_CTRL, divide(0, 3));
    return 0;
  });
  BOOST_TEST(fast.warnings("/markervp/slcr/fclk_too_fast") == 2u);
  BOOST_TEST(fast.text.str().find("FCLK_CLK0 is set to 333333333 Hz") != std::string::npos,
             fast.text.str());
  SlcrBench off;
  off.run([] {
    hal_write32(slcr_at + slcr::SLCR_UNLOCK, slcr::unlock_key);
    hal_write32(slcr_at + slcr::IO_PLL_CTRL, slcr::pll_ctrl::PLL_PWRDWN);
    hal_write32(slcr_at + slcr::FPGA0_CLK_CTRL, divide(10, 1));
    return 0;
  });
  BOOST_TEST(off.warnings("/markervp/slcr/fclk_without_source") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
