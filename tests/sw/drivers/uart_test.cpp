#include <drivers/uart.h>
#include <uart_registers.h>

#include <boost/test/unit_test.hpp>
#include <deque>
#include <string>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t base = uart::uart1_base;

struct Fixture {
  Fixture() {
    fake_hal::reset();
    fake_hal::state().on_read[base + uart::SR] = [this] { return status; };
    BOOST_TEST(driver.initialise({base}));
  }
  static std::uint32_t last(std::uint32_t offset) {
    return fake_hal::writes_to(base + offset).back();
  }
  std::uint32_t status = uart::sr::REMPTY | uart::sr::TEMPTY;
  drivers::Uart driver{};
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(uart_driver, Fixture)

BOOST_AUTO_TEST_CASE(initialise_sets_format_and_baud_rate_with_everything_off) {
  const auto& accesses = fake_hal::state().accesses;
  BOOST_TEST(accesses.front().address == base + uart::CR);
  BOOST_TEST(accesses.front().value == (uart::cr::TXDIS | uart::cr::RXDIS));
  BOOST_TEST(last(uart::MR) == uart::mr::PAR_none);
  const std::uint32_t baud = 50'000'000 / (last(uart::BAUDGEN) * (last(uart::BAUD_DIV) + 1));
  BOOST_TEST(baud == 115'207u);
  BOOST_TEST(last(uart::IDR) == uart::event::all);
  BOOST_TEST(last(uart::CR) ==
             (uart::cr::TXEN | uart::cr::RXEN | uart::cr::TXRES | uart::cr::RXRES));
}

BOOST_AUTO_TEST_CASE(baud_rates_from_slow_to_fast) {
  for (const std::uint32_t baud : {300u, 9'600u, 38'400u, 921'600u, 3'000'000u}) {
    BOOST_TEST(driver.initialise({base, 50'000'000, baud}));
    const double given =
        50e6 / (last(uart::BAUDGEN) * static_cast<double>(last(uart::BAUD_DIV) + 1));
    BOOST_TEST(given == baud, boost::test_tools::tolerance(0.03));
    BOOST_TEST(last(uart::BAUD_DIV) >= 4u);
  }
}

BOOST_AUTO_TEST_CASE(a_baud_rate_that_cannot_be_is_refused) {
  fake_hal::state().accesses.clear();
  BOOST_TEST(!driver.initialise({base, 50'000'000, 20'000'000}));
  BOOST_TEST(!driver.initialise({base, 50'000'000, 1}));
  BOOST_TEST(!driver.initialise({base, 50'000'000, 0}));
  BOOST_TEST(!driver.initialise({base, 0, 115'200}));
  BOOST_TEST(fake_hal::state().accesses.empty());
}

BOOST_AUTO_TEST_CASE(put_looks_for_room) {
  BOOST_TEST(driver.try_put('x'));
  BOOST_TEST(last(uart::FIFO) == 'x');
  status = uart::sr::TFUL;
  BOOST_TEST(!driver.try_put('y'));
  BOOST_TEST(fake_hal::writes_to(base + uart::FIFO).size() == 1u);
}

BOOST_AUTO_TEST_CASE(write_waits_while_the_fifo_is_full) {
  unsigned reads = 0;
  fake_hal::state().on_read[base + uart::SR] = [&] {
    return ++reads % 3 == 0 ? 0u : uart::sr::TFUL;
  };
  driver.write("abc", 3);
  BOOST_TEST(fake_hal::writes_to(base + uart::FIFO) == (std::vector<std::uint32_t>{'a', 'b', 'c'}),
             boost::test_tools::per_element());
  BOOST_TEST(reads == 9u);
}

BOOST_AUTO_TEST_CASE(read_takes_what_there_is) {
  std::deque<std::uint8_t> fifo{'1', '2', '3'};
  fake_hal::state().on_read[base + uart::SR] = [&] { return fifo.empty() ? uart::sr::REMPTY : 0u; };
  fake_hal::state().on_read[base + uart::FIFO] = [&] {
    const std::uint32_t byte = fifo.front();
    fifo.pop_front();
    return byte;
  };
  char text[8] = {};
  BOOST_TEST(driver.read(text, 2) == 2u);
  BOOST_TEST(driver.read(text + 2, 6) == 1u);
  BOOST_TEST(driver.read(text + 3, 5) == 0u);
  BOOST_TEST(std::string(text) == "123");
  std::uint8_t byte = 7;
  BOOST_TEST(!driver.try_get(byte));
  BOOST_TEST(byte == 7);
}

BOOST_AUTO_TEST_CASE(idle_is_empty_and_quiet) {
  status = uart::sr::TEMPTY;
  BOOST_TEST(driver.is_idle());
  status = uart::sr::TEMPTY | uart::sr::TACTIVE;
  BOOST_TEST(!driver.is_idle());
  status = 0;
  BOOST_TEST(!driver.is_idle());
}

BOOST_AUTO_TEST_CASE(interrupts) {
  fake_hal::state().accesses.clear();
  driver.enable_interrupts(uart::event::RTRIG | uart::event::ROVR, 8);
  const std::vector<fake_hal::Access> expected = {
      {true, base + uart::IDR, uart::event::all},
      {true, base + uart::RXWM, 8},
      {true, base + uart::IER, uart::event::RTRIG | uart::event::ROVR}};
  BOOST_TEST((fake_hal::state().accesses == expected));
  fake_hal::state().registers[base + uart::ISR] = 0x21;
  BOOST_TEST(driver.acknowledge() == 0x21u);
  BOOST_TEST(last(uart::ISR) == 0x21u);
}

BOOST_AUTO_TEST_SUITE_END()
