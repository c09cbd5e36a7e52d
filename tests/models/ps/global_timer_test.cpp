#include <global_timer_registers.h>

#include <ps/global_timer/global_timer.h>
#include <boost/test/unit_test.hpp>

#include "bench.h"

using namespace bench;
namespace gt = global_timer;

namespace {

constexpr std::uint32_t at = gt::base;

/// Private bus without time: register values at the program's own times.
struct TimerBench : Bench {
  explicit TimerBench(const Settings& settings = {})
      : scope_(configure(settings)), timer("timer", cpu_clock) {
    bus.map("timer", at, 0x100).bind(timer.registers.socket);
  }

 private:
  vp::Configuration& configure(const Settings& settings) {
    for (const std::string& setting : settings) configuration_.set(setting);
    return configuration_;
  }
  vp::Configuration configuration_;
  vp::Configuration::Scope scope_;

 public:
  ps::GlobalTimer timer;
  Changes<bool> irq{timer.irq, scheduler};
};

using Times = std::vector<std::uint64_t>;

void after(std::uint64_t cycles) {
  hal_work(step, cycles);
}

std::uint64_t counter() {
  const std::uint64_t high = hal_read32(at + gt::COUNTER_HIGH);
  return high << 32 | hal_read32(at + gt::COUNTER_LOW);
}

void set_comparator(std::uint64_t value, std::uint32_t control) {
  hal_write32(at + gt::CONTROL, control & ~gt::control::Comp_Enable);
  hal_write32(at + gt::COMPARATOR_LOW, static_cast<std::uint32_t>(value));
  hal_write32(at + gt::COMPARATOR_HIGH, static_cast<std::uint32_t>(value >> 32));
  hal_write32(at + gt::CONTROL, control);
}

constexpr std::uint32_t run = gt::control::Timer_Enable;
constexpr std::uint32_t run_compare = run | gt::control::Comp_Enable | gt::control::IRQ_Enable;

}  // namespace

BOOST_AUTO_TEST_SUITE(global_timer_test)

BOOST_AUTO_TEST_CASE(a_count_is_two_cycles_of_the_cpu) {
  TimerBench b;
  b.run([] {
    BOOST_TEST(hal_read32(at + gt::CONTROL) == run);
    BOOST_TEST(counter() == 0u);
    after(1);
    BOOST_TEST(counter() == 0u);
    after(1);
    BOOST_TEST(counter() == 1u);
    after(997);
    BOOST_TEST(counter() == 499u);
    after(1);
    BOOST_TEST(counter() == 500u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(without_boot_code_it_stands) {
  TimerBench b({"timer.enabled_by_boot=false"});
  b.run([] {
    after(100);
    BOOST_TEST(counter() == 0u);
    BOOST_TEST(hal_read32(at + gt::CONTROL) == 0u);
    hal_write32(at + gt::CONTROL, run);
    after(100);
    BOOST_TEST(counter() == 50u);
    hal_write32(at + gt::CONTROL, 0);
    after(100);
    BOOST_TEST(counter() == 50u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_counter_can_be_set_as_the_driver_does) {
  TimerBench b;
  b.run([] {
    after(100);
    hal_write32(at + gt::CONTROL, 0);
    hal_write32(at + gt::COUNTER_LOW, 0xFFFF'FFFF);
    hal_write32(at + gt::COUNTER_HIGH, 0x12);
    hal_write32(at + gt::CONTROL, run);
    BOOST_TEST(counter() == 0x12'FFFF'FFFFu);
    after(2);
    BOOST_TEST(counter() == 0x13'0000'0000u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_prescaler_divides) {
  TimerBench b;
  b.run([] {
    after(100);
    hal_write32(at + gt::CONTROL, run | 9u << gt::control::Prescaler_shift);
    BOOST_TEST(counter() == 50u);
    after(19);
    BOOST_TEST(counter() == 50u);
    after(1);
    BOOST_TEST(counter() == 51u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_event_comes_at_the_exact_time_and_once) {
  TimerBench b;
  b.run([] {
    set_comparator(250, run_compare);
    after(499);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    after(1);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 1u);
    after(100);
    hal_write32(at + gt::INTERRUPT_STATUS, 0);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 1u);
    hal_write32(at + gt::INTERRUPT_STATUS, 1);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    after(1000);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    return 0;
  });
  const Times expected{500'000, 600'000};
  BOOST_TEST(b.irq.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(auto_increment_repeats) {
  TimerBench b;
  b.run([] {
    hal_write32(at + gt::AUTO_INCREMENT, 100);
    set_comparator(50, run_compare | gt::control::Auto_Increment);
    for (int i = 0; i < 3; ++i) {
      after(150);
      hal_write32(at + gt::INTERRUPT_STATUS, 1);
      after(50);
    }
    BOOST_TEST(hal_read32(at + gt::COMPARATOR_LOW) == 350u);
    return 0;
  });
  const Times expected{100'000, 150'000, 300'000, 350'000, 500'000, 550'000};
  BOOST_TEST(b.irq.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(an_increment_of_0_repeats_nothing) {
  TimerBench b;
  b.run([] {
    set_comparator(50, run_compare | gt::control::Auto_Increment);
    after(150);
    hal_write32(at + gt::INTERRUPT_STATUS, 1);
    after(500);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    return 0;
  });
}

// Enabling the comparator arms it again, writing the same control once more does not.
BOOST_AUTO_TEST_CASE(an_event_comes_again_when_the_comparator_is_enabled_again) {
  TimerBench b;
  b.run([] {
    set_comparator(50, run_compare);
    after(150);
    hal_write32(at + gt::INTERRUPT_STATUS, 1);
    hal_write32(at + gt::CONTROL, run_compare);
    after(10);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    hal_write32(at + gt::CONTROL, run);
    hal_write32(at + gt::CONTROL, run_compare);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 1u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(control_written_again_does_not_hold_up_the_count) {
  TimerBench b;
  b.run([] {
    const std::uint32_t slow = run | 9u << gt::control::Prescaler_shift;  // a count in 20 cycles
    hal_write32(at + gt::CONTROL, slow);
    const std::uint64_t start = counter();
    after(15);
    hal_write32(at + gt::CONTROL, slow | gt::control::IRQ_Enable);
    after(4);
    BOOST_TEST(counter() == start);
    after(1);
    BOOST_TEST(counter() == start + 1);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_comparator_in_the_past_matches_at_once) {
  TimerBench b;
  b.run([] {
    after(100);
    set_comparator(10, run_compare);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 1u);
    after(1);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{100'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_interrupt_needs_its_enable) {
  TimerBench b;
  b.run([] {
    set_comparator(10, run | gt::control::Comp_Enable);
    after(100);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 1u);
    hal_write32(at + gt::CONTROL, run_compare);
    after(1);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{100'000}, boost::test_tools::per_element());
  BOOST_TEST(b.timer.irq.get());
}

BOOST_AUTO_TEST_CASE(a_disabled_comparator_is_silent) {
  TimerBench b;
  b.run([] {
    set_comparator(10, run | gt::control::IRQ_Enable);
    after(100);
    BOOST_TEST(hal_read32(at + gt::INTERRUPT_STATUS) == 0u);
    return 0;
  });
  BOOST_TEST(b.irq.times.empty());
}

BOOST_AUTO_TEST_CASE(it_follows_the_clock_of_the_cpu) {
  TimerBench b;
  b.device.written = [&](std::uint32_t hertz) { b.cpu_clock.set_frequency(hertz); };
  b.run([] {
    set_comparator(300, run_compare);
    after(200);  // 100 counts at 1 GHz
    hal_write32(device_address, 500'000'000);
    after(399);
    BOOST_TEST(counter() == 299u);
    after(1);
    BOOST_TEST(counter() == 300u);
    after(1);
    return 0;
  });
  BOOST_TEST(b.irq.times == Times{1'000'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
