#include <drivers/timers.h>
#include <private_timer_registers.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = private_timer::base;

struct Fixture {
  Fixture() { fake_hal::reset(); }
  using Accesses = std::vector<fake_hal::Access>;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(private_timer_driver, Fixture)

BOOST_AUTO_TEST_CASE(one_shot) {
  drivers::PrivateTimer timer;
  timer.initialise({});
  timer.start(1000);
  const Accesses expected = {{true, base + 8, 4},
                             {true, base + 0xC, 1},
                             {true, base + 8, 4},
                             {true, base + 0, 1000},
                             {true, base + 8, 5}};
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_CASE(a_period_counts_the_step_from_0) {
  drivers::PrivateTimer timer;
  timer.initialise({256, true, false});
  fake_hal::state().accesses.clear();
  timer.start(1000);
  const Accesses expected = {{true, base + 8, 0xFF02},
                             {true, base + 0, 999},
                             {true, base + 4, 1000},
                             {true, base + 8, 0xFF03}};
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_CASE(polling) {
  drivers::PrivateTimer timer;
  timer.initialise({});
  fake_hal::state().registers[base + private_timer::COUNTER] = 77;
  fake_hal::state().registers[base + private_timer::INTERRUPT_STATUS] = 1;
  BOOST_TEST(timer.remaining() == 77u);
  BOOST_TEST(timer.expired());
  fake_hal::state().registers[base + private_timer::INTERRUPT_STATUS] = 0;
  BOOST_TEST(!timer.expired());
  timer.acknowledge();
  BOOST_TEST(fake_hal::writes_to(base + private_timer::INTERRUPT_STATUS).back() == 1u);
}

BOOST_AUTO_TEST_CASE(watchdog) {
  drivers::PrivateWatchdog watchdog;
  watchdog.start(500, 4);
  watchdog.feed();
  watchdog.stop();
  const Accesses expected = {{true, base + 0x20, 500},         {true, base + 0x28, 0x309},
                             {true, base + 0x20, 500},         {true, base + 0x34, 0x1234'5678},
                             {true, base + 0x34, 0x8765'4321}, {true, base + 0x28, 0}};
  BOOST_TEST((fake_hal::state().accesses == expected));
  BOOST_TEST(!watchdog.take_reset_flag());
  fake_hal::state().registers[base + 0x30] = 1;
  BOOST_TEST(watchdog.take_reset_flag());
  BOOST_TEST(fake_hal::writes_to(base + 0x30).back() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
