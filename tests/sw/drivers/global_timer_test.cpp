#include <drivers/timers.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = 0xF8F0'0200;

struct Fixture {
  Fixture() { fake_hal::reset(); }
  drivers::GlobalTimer timer;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(global_timer_driver, Fixture)

BOOST_AUTO_TEST_CASE(now_reads_high_low_high) {
  fake_hal::state().registers[base] = 0x89AB'CDEF;
  fake_hal::state().registers[base + 4] = 0x0123'4567;
  BOOST_TEST(timer.now() == 0x0123'4567'89AB'CDEFull);
  BOOST_TEST(fake_hal::state().accesses.size() == 3u);
}

BOOST_AUTO_TEST_CASE(now_repeats_when_the_low_half_overflows_between) {
  std::uint64_t counter = 0x0000'0001'FFFF'FFFEull;
  fake_hal::state().on_read[base] = [&] { return static_cast<std::uint32_t>(counter += 3); };
  fake_hal::state().on_read[base + 4] = [&] { return static_cast<std::uint32_t>(counter >> 32); };
  BOOST_TEST(timer.now() == 0x0000'0002'0000'0004ull);
}

BOOST_AUTO_TEST_CASE(initialise_starts_the_counter_without_touching_it) {
  timer.initialise();
  BOOST_TEST(fake_hal::writes_to(base + 8).back() == 1u);
  BOOST_TEST(fake_hal::writes_to(base).empty());
  BOOST_TEST(fake_hal::writes_to(base + 4).empty());
}

BOOST_AUTO_TEST_CASE(alarm_is_written_with_the_comparator_off) {
  timer.set_alarm(0x0123'4567'89AB'CDEFull);
  const std::vector<fake_hal::Access> expected = {{true, base + 8, 1},
                                                  {true, base + 0x10, 0x89AB'CDEF},
                                                  {true, base + 0x14, 0x0123'4567},
                                                  {true, base + 8, 7}};
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_CASE(clear_alarm_switches_off_before_it_clears) {
  timer.clear_alarm();
  const std::vector<fake_hal::Access> expected = {{true, base + 8, 1}, {true, base + 0xC, 1}};
  BOOST_TEST((fake_hal::state().accesses == expected));
}

BOOST_AUTO_TEST_SUITE_END()
