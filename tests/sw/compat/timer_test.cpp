// XTime and the sleeps.
#include <boost/test/unit_test.hpp>

#include <sleep.h>
#include <xiltimer.h>
#include <xtime_l.h>

#include <vector>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t low = 0xF8F0'0200;
constexpr std::uint32_t high = 0xF8F0'0204;
constexpr std::uint32_t control = 0xF8F0'0208;

/// A counter that moves on with each look at its lower half.
struct Fixture {
  Fixture() {
    fake_hal::reset();
    fake_hal::state().on_read[low] = [this] {
      counter += step;
      return static_cast<std::uint32_t>(counter);
    };
    fake_hal::state().on_read[high] = [this] { return static_cast<std::uint32_t>(counter >> 32); };
  }
  u64 counter = 0;
  u64 step = 1;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(xtime, Fixture)

BOOST_AUTO_TEST_CASE(both_halves_belong_together) {
  counter = 0xFFFF'FFFF;
  XTime now = 0;
  XTime_GetTime(&now);  // the lower half wraps during the first attempt
  BOOST_CHECK_EQUAL(now, 0x1'0000'0001u);
}

BOOST_AUTO_TEST_CASE(counts_per_second_are_those_of_half_the_cpu_clock) {
  BOOST_CHECK_EQUAL(COUNTS_PER_SECOND, 333'333'343);
  BOOST_CHECK_EQUAL(COUNTS_PER_USECOND, 333);
}

BOOST_AUTO_TEST_CASE(setting_the_time_stops_the_counter_meanwhile) {
  fake_hal::state().registers[control] = 1;
  XTime_SetTime(0x1234'5678'9ABC'DEF0);
  using fake_hal::Access;
  const std::vector<Access> expected = {{false, control, 1},
                                        {true, control, 0},
                                        {true, low, 0x9ABC'DEF0},
                                        {true, high, 0x1234'5678},
                                        {true, control, 1}};
  BOOST_CHECK(fake_hal::state().accesses == expected);
}

BOOST_AUTO_TEST_CASE(usleep_waits_at_least_so_long) {
  step = 1000;
  XTime before = 0;
  XTime_GetTime(&before);
  BOOST_CHECK_EQUAL(usleep(100), 0);
  XTime after = 0;
  XTime_GetTime(&after);
  BOOST_CHECK_GE(after - before, 33'333u);
  BOOST_CHECK_LE(after - before, 33'333u + 4 * step);
}

BOOST_AUTO_TEST_CASE(sleep_counts_seconds) {
  step = 10'000'000;
  BOOST_CHECK_EQUAL(sleep(2), 0);
  BOOST_CHECK_GE(counter, 666'666'686u);
  BOOST_CHECK_LE(counter, 666'666'686u + 4 * step);
}

BOOST_AUTO_TEST_CASE(msleep_counts_milliseconds) {
  step = 10'000;
  msleep(3);
  BOOST_CHECK_GE(counter, 1'000'000u);
  BOOST_CHECK_LE(counter, 1'000'000u + 4 * step);
}

// A tick is a whole part of a second: of 300 ms, the third.
BOOST_AUTO_TEST_CASE(the_private_timer_ticks) {
  constexpr std::uint32_t private_timer = 0xF8F0'0600;
  XTimer_SetInterval(10);
  BOOST_CHECK_EQUAL(fake_hal::state().registers[private_timer], 3'333'333u);
  BOOST_CHECK_EQUAL(fake_hal::state().registers[private_timer + 8], 7u);
  XTimer_SetInterval(300);
  BOOST_CHECK_EQUAL(fake_hal::state().registers[private_timer], 111'111'114u);
  XTimer_SetInterval(5'000);
  BOOST_CHECK_EQUAL(fake_hal::state().registers[private_timer], 333'333'343u);
  XTimer_ClearTickInterrupt();
  BOOST_CHECK_EQUAL(fake_hal::state().registers[private_timer + 12], 1u);
}

BOOST_AUTO_TEST_CASE(no_time_is_not_waited_for) {
  usleep(0);
  BOOST_CHECK_EQUAL(counter, 1);
}

BOOST_AUTO_TEST_SUITE_END()
