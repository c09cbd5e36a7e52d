#include <private_timer_registers.h>

#include <ps/private_timer/private_timer.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "bench.h"
#include "register_policy.h"

using namespace bench;
namespace pt = private_timer;

namespace {

constexpr std::uint32_t at = pt::base;

/// Private bus without time: register values at the program's own times. The CPU has 1 GHz.
struct TimerBench : Bench {
  TimerBench() {
    reports.redirect(text);
    bus.map("private_timer", at, 0x100).bind(timer.registers.socket);
  }
  ps::PrivateTimer timer{"timer", cpu_clock};
  Changes<bool> irq{timer.irq, scheduler};
  Changes<bool> watchdog_irq{timer.watchdog_irq, scheduler};
  Changes<bool> watchdog_reset{timer.watchdog_reset, scheduler};
  std::ostringstream text;
  vp::ReportRouter reports;
};

using Times = std::vector<std::uint64_t>;

void after(std::uint64_t cycles) {
  hal_work(step, cycles);
}
std::uint32_t get(std::uint32_t offset) {
  return hal_read32(at + offset);
}
void set(std::uint32_t offset, std::uint32_t value) {
  hal_write32(at + offset, value);
}

constexpr std::uint32_t run_once = pt::control::Enable | pt::control::IRQ_Enable;
constexpr std::uint32_t run_again = run_once | pt::control::Auto_Reload;
constexpr std::uint32_t run_watchdog = pt::control::Enable | pt::control::Watchdog_Mode;

}  // namespace

BOOST_AUTO_TEST_SUITE(private_timer_test)

BOOST_AUTO_TEST_CASE(reset_values) {
  TimerBench b;
  b.run([] {
    for (const vp::RegisterInfo& info : pt::registers) {
      BOOST_TEST(get(info.offset) == seen_after_reset(info), info.name);
    }
    BOOST_TEST(get(0x10) == 0u, "a hole");
    after(1000);
    BOOST_TEST(get(pt::COUNTER) == 0u);
    return 0;
  });
  BOOST_TEST(!b.timer.irq.get());
}

BOOST_AUTO_TEST_CASE(every_bit) {
  TimerBench b;
  b.run([] {
    for (const vp::RegisterInfo& info : pt::registers) {
      if (info.offset == pt::LOAD || info.offset == pt::COUNTER || info.offset == pt::WDT_LOAD ||
          info.offset == pt::WDT_COUNTER) {
        check_stored_bits(at, info);
      }
    }
    // Without Enable and Watchdog_Mode, which have effects.
    for (const std::uint32_t offset : {pt::CONTROL, pt::WDT_CONTROL}) {
      for (unsigned bit = 1; bit < 32; ++bit) {
        if (1u << bit == pt::control::Watchdog_Mode) continue;
        set(offset, 1u << bit);
        BOOST_TEST(get(offset) == (1u << bit & 0xFF06), "bit " << bit);
      }
      set(offset, 0);
    }
    set(pt::CONTROL, pt::control::Watchdog_Mode);
    BOOST_TEST(get(pt::CONTROL) == 0u, "the timer has no such bit");
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(it_counts_down_at_half_the_clock) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 500);
    BOOST_TEST(get(pt::COUNTER) == 500u, "LOAD sets the counter");
    after(100);
    BOOST_TEST(get(pt::COUNTER) == 500u, "it stands");
    set(pt::CONTROL, pt::control::Enable);
    after(1);
    BOOST_TEST(get(pt::COUNTER) == 500u);
    after(1);
    BOOST_TEST(get(pt::COUNTER) == 499u);
    after(996);
    BOOST_TEST(get(pt::COUNTER) == 1u);
    set(pt::CONTROL, 0);
    after(100);
    BOOST_TEST(get(pt::COUNTER) == 1u, "it stands again");
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(one_shot_at_the_exact_time) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 100);
    set(pt::CONTROL, run_once);
    after(199);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u);
    after(1);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    BOOST_TEST(get(pt::COUNTER) == 0u);
    after(100);
    set(pt::INTERRUPT_STATUS, 0);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    set(pt::INTERRUPT_STATUS, 1);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u);
    after(10'000);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u, "once");
    BOOST_TEST(get(pt::COUNTER) == 0u);
    BOOST_TEST(get(pt::CONTROL) == run_once, "the enable stays");
    set(pt::LOAD, 10);
    after(20);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u, "a new load starts it again");
    return 0;
  });
  BOOST_TEST(b.irq.times == (Times{200'000, 300'000, 10'320'000}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_reload_of_0_has_no_further_event) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 0);
    set(pt::COUNTER, 10);
    set(pt::CONTROL, run_again);
    after(20);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    set(pt::INTERRUPT_STATUS, 1);
    after(1000);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(control_written_while_it_counts_does_not_reload) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 99);
    set(pt::CONTROL, run_again);
    after(100);
    BOOST_TEST(get(pt::COUNTER) == 49u);
    set(pt::CONTROL, run_again | 1u << pt::control::Prescaler_shift);
    BOOST_TEST(get(pt::COUNTER) == 49u);
    after(4);
    BOOST_TEST(get(pt::COUNTER) == 48u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(auto_reload_has_a_period_of_load_plus_1) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 99);
    set(pt::CONTROL, run_again);
    after(198);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    BOOST_TEST(get(pt::COUNTER) == 0u);
    set(pt::INTERRUPT_STATUS, 1);
    after(1);
    BOOST_TEST(get(pt::COUNTER) == 0u);
    after(1);
    BOOST_TEST(get(pt::COUNTER) == 99u);
    after(198);
    set(pt::INTERRUPT_STATUS, 1);
    after(200);
    set(pt::INTERRUPT_STATUS, 1);
    after(1000);
    return 0;
  });
  BOOST_TEST(b.irq.times == (Times{198'000, 198'000, 398'000, 398'000, 598'000, 598'000, 798'000}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_prescaler_divides) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 10);
    set(pt::CONTROL, run_once | 255u << pt::control::Prescaler_shift);
    after(511);
    BOOST_TEST(get(pt::COUNTER) == 10u);
    after(1);
    BOOST_TEST(get(pt::COUNTER) == 9u);
    set(pt::CONTROL, run_once | 1u << pt::control::Prescaler_shift);
    after(4 * 9);
    BOOST_TEST(get(pt::COUNTER) == 0u);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{548'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_written_counter_counts_from_there) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 1000);
    set(pt::CONTROL, run_again);
    after(100);
    set(pt::COUNTER, 5);
    after(10);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    after(2);
    BOOST_TEST(get(pt::COUNTER) == 1000u, "then from LOAD again");
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{110'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(without_interrupt_enable_only_the_flag) {
  TimerBench b;
  b.run([] {
    set(pt::LOAD, 10);
    set(pt::CONTROL, pt::control::Enable);
    after(100);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 1u);
    set(pt::CONTROL, run_once);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{100'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_counter_set_to_0_has_no_event) {
  TimerBench b;
  b.run([] {
    set(pt::CONTROL, run_once);
    set(pt::LOAD, 0);
    after(100);
    set(pt::CONTROL, run_again);
    after(100);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u);
    return 0;
  });
  BOOST_TEST(b.irq.times.empty());
}

BOOST_AUTO_TEST_CASE(it_follows_the_clock_of_the_cpu) {
  TimerBench b;
  b.device.written = [&](std::uint32_t hertz) { b.cpu_clock.set_frequency(hertz); };
  b.run([] {
    set(pt::LOAD, 300);
    set(pt::CONTROL, run_once);
    after(200);  // 100 counts at 1 GHz
    hal_write32(device_address, 500'000'000);
    after(500);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{1'000'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_watchdog_as_a_timer) {
  TimerBench b;
  b.run([] {
    set(pt::WDT_LOAD, 50);
    set(pt::WDT_CONTROL, run_again);
    after(100);
    BOOST_TEST(get(pt::WDT_INTERRUPT_STATUS) == 1u);
    BOOST_TEST(get(pt::WDT_RESET_STATUS) == 0u);
    set(pt::WDT_INTERRUPT_STATUS, 1);
    set(pt::WDT_COUNTER, 10);
    after(20);
    BOOST_TEST(get(pt::WDT_INTERRUPT_STATUS) == 1u);
    BOOST_TEST(get(pt::INTERRUPT_STATUS) == 0u, "the timer is another");
    return 0;
  });
  BOOST_TEST(b.watchdog_irq.times == (Times{100'000, 100'000, 120'000}),
             boost::test_tools::per_element());
  BOOST_TEST(b.irq.times.empty());
  BOOST_TEST(b.watchdog_reset.times.empty());
}

BOOST_AUTO_TEST_CASE(a_watchdog_that_is_fed_is_silent) {
  TimerBench b;
  b.run([] {
    set(pt::WDT_LOAD, 100);
    set(pt::WDT_CONTROL, run_watchdog);
    for (int i = 0; i < 5; ++i) {
      after(199);
      set(pt::WDT_LOAD, 100);
    }
    BOOST_TEST(get(pt::WDT_RESET_STATUS) == 0u);
    return 0;
  });
  BOOST_TEST(b.watchdog_reset.times.empty());
  BOOST_TEST(b.reports.count(sc_core::SC_WARNING) == 0u);
}

BOOST_AUTO_TEST_CASE(a_watchdog_that_expires_is_told) {
  TimerBench b;
  b.run([] {
    set(pt::WDT_LOAD, 100);
    set(pt::WDT_CONTROL, run_watchdog);
    after(300);
    BOOST_TEST(get(pt::WDT_RESET_STATUS) == 1u);
    BOOST_TEST(get(pt::WDT_INTERRUPT_STATUS) == 0u);
    set(pt::WDT_RESET_STATUS, 1);
    BOOST_TEST(get(pt::WDT_RESET_STATUS) == 0u);
    return 0;
  });
  BOOST_TEST(b.watchdog_reset.times == (Times{200'000, 300'000}), boost::test_tools::per_element());
  BOOST_TEST(b.reports.count("/markervp/private_timer/watchdog") == 1u);
}

BOOST_AUTO_TEST_CASE(only_the_two_keys_leave_watchdog_mode) {
  TimerBench b;
  b.run([] {
    set(pt::WDT_CONTROL, run_watchdog);
    set(pt::WDT_CONTROL, pt::control::Enable);
    BOOST_TEST(get(pt::WDT_CONTROL) == run_watchdog);
    set(pt::WDT_COUNTER, 7);
    BOOST_TEST(get(pt::WDT_COUNTER) == 0u, "not in watchdog mode");
    set(pt::WDT_DISABLE, pt::disable_key_2);
    set(pt::WDT_DISABLE, pt::disable_key_1);
    set(pt::WDT_DISABLE, 0);
    set(pt::WDT_DISABLE, pt::disable_key_2);
    BOOST_TEST(get(pt::WDT_CONTROL) == run_watchdog);
    set(pt::WDT_DISABLE, pt::disable_key_1);
    set(pt::WDT_DISABLE, pt::disable_key_2);
    BOOST_TEST(get(pt::WDT_CONTROL) == pt::control::Enable);
    BOOST_TEST(get(pt::WDT_DISABLE) == 0u);
    set(pt::WDT_COUNTER, 7);
    BOOST_TEST(get(pt::WDT_COUNTER) == 7u);
    return 0;
  });
  BOOST_TEST(b.reports.count("/markervp/private_timer/watchdog_counter") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
