#include <axi_gpio_registers.h>
#include <drivers/axi_gpio.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = 0x4121'0000;

struct Fixture {
  Fixture() {
    fake_hal::reset();
    gpio.initialise({base, 0xFFFF'FFFF});
  }
  drivers::AxiGpio gpio{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(axi_gpio_driver, Fixture)

BOOST_AUTO_TEST_CASE(initialise_sets_the_direction) {
  BOOST_TEST(fake_hal::writes_to(base + axi_gpio::GPIO_TRI).at(0) == 0xFFFF'FFFFu);
}

BOOST_AUTO_TEST_CASE(write_and_read_use_the_data_register) {
  gpio.write(0x1234);
  BOOST_TEST(fake_hal::writes_to(base + axi_gpio::GPIO_DATA).at(0) == 0x1234u);
  fake_hal::state().registers[base + axi_gpio::GPIO_DATA] = 7;
  BOOST_TEST(gpio.read() == 7u);
}

BOOST_AUTO_TEST_CASE(poll_ends_at_a_change_or_the_limit) {
  unsigned reads = 0;
  fake_hal::state().on_read[base + axi_gpio::GPIO_DATA] = [&] { return ++reads < 5 ? 9u : 10u; };
  const hal_poll_result found = gpio.poll_until_changed(9, 8, 100);
  BOOST_TEST(found.changed);
  BOOST_TEST(found.value == 10u);
  BOOST_TEST(found.polls == 5u);
  const hal_poll_result none = gpio.poll_until_changed(10, 8, 3);
  BOOST_TEST(!none.changed);
  BOOST_TEST(none.polls == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
