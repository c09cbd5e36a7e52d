#include <drivers/gic.h>

#include <boost/test/unit_test.hpp>
#include <deque>

#include "fake_hal.h"

namespace {

constexpr std::uint32_t interface_of_cpu = 0xF8F0'0100;
constexpr std::uint32_t distributor = 0xF8F0'1000;

void count(void* context) {
  ++*static_cast<int*>(context);
}

/// Interrupts wait in a queue; ICCIAR takes one out.
struct Fixture {
  Fixture() {
    fake_hal::reset();
    auto& s = fake_hal::state();
    s.interrupt_pending = [this] { return !pending.empty(); };
    s.on_read[interface_of_cpu + 0x0C] = [this] {
      const std::uint32_t id = pending.front();
      pending.pop_front();
      return id;
    };
    controller.initialise();
    hal_interrupt_enable(true);
  }
  std::vector<std::uint32_t> ended() const { return fake_hal::writes_to(interface_of_cpu + 0x10); }

  std::deque<std::uint32_t> pending;
  drivers::Gic controller{};
  int calls = 0;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(gic_driver, Fixture)

BOOST_AUTO_TEST_CASE(initialise_follows_the_vendors_order) {
  const auto& accesses = fake_hal::state().accesses;
  BOOST_TEST((accesses.front() == fake_hal::Access{true, distributor, 0}));
  BOOST_TEST((accesses.back() == fake_hal::Access{true, interface_of_cpu, 7}));
  BOOST_TEST(fake_hal::writes_to(interface_of_cpu + 4).at(0) == 0xF0u);
  BOOST_TEST(fake_hal::writes_to(distributor).back() == 1u);
  for (std::uint32_t id = 0; id < 96; id += 4) {
    BOOST_TEST(fake_hal::writes_to(distributor + 0x400 + id).at(0) == 0xA0A0A0A0u);
    BOOST_TEST(fake_hal::writes_to(distributor + 0x800 + id).size() == (id < 32 ? 0u : 1u));
  }
  for (std::uint32_t n = 0; n < 3; ++n) {
    BOOST_TEST(fake_hal::writes_to(distributor + 0x180 + 4 * n).at(0) == 0xFFFFFFFFu);
  }
}

BOOST_AUTO_TEST_CASE(connect_enables_one_interrupt) {
  BOOST_TEST(controller.connect(61, drivers::Trigger::level_high, count, &calls));
  BOOST_TEST(fake_hal::writes_to(distributor + 0x104).at(0) == 1u << 29);
  BOOST_TEST(fake_hal::writes_to(distributor + 0xC0C).back() == 1u << 26);
  BOOST_TEST(controller.connect(62, drivers::Trigger::rising_edge, count, &calls));
  BOOST_TEST(fake_hal::writes_to(distributor + 0xC0C).back() == (1u << 26 | 3u << 28));
}

BOOST_AUTO_TEST_CASE(private_interrupts_keep_their_sensitivity) {
  controller.connect(27, drivers::Trigger::rising_edge, count, &calls);
  BOOST_TEST(fake_hal::writes_to(distributor + 0xC04).empty());
  BOOST_TEST(fake_hal::writes_to(distributor + 0x100).at(0) == 1u << 27);
}

BOOST_AUTO_TEST_CASE(dispatcher_calls_the_handler_and_ends_the_interrupt) {
  controller.connect(61, drivers::Trigger::level_high, count, &calls);
  pending = {61, 61};
  hal_barrier();
  BOOST_TEST(calls == 2);
  BOOST_TEST((ended() == std::vector<std::uint32_t>{61, 61}));
}

BOOST_AUTO_TEST_CASE(end_of_a_software_interrupt_names_its_cpu) {
  controller.connect(5, drivers::Trigger::rising_edge, count, &calls);
  pending = {1u << 10 | 5};
  hal_barrier();
  BOOST_TEST(calls == 1);
  BOOST_TEST((ended() == std::vector<std::uint32_t>{1u << 10 | 5}));
}

BOOST_AUTO_TEST_CASE(spurious_interrupt_is_not_ended) {
  pending = {1023};
  hal_barrier();
  BOOST_TEST(ended().empty());
  BOOST_TEST(controller.unhandled() == 0u);
}

BOOST_AUTO_TEST_CASE(interrupt_without_handler_is_ended_and_counted) {
  pending = {62};
  hal_barrier();
  BOOST_TEST(controller.unhandled() == 1u);
  BOOST_TEST((ended() == std::vector<std::uint32_t>{62}));
}

BOOST_AUTO_TEST_CASE(disconnect_disables) {
  controller.connect(61, drivers::Trigger::level_high, count, &calls);
  controller.disconnect(61);
  BOOST_TEST(fake_hal::writes_to(distributor + 0x184).back() == 1u << 29);
  pending = {61};
  hal_barrier();
  BOOST_TEST(calls == 0);
}

BOOST_AUTO_TEST_CASE(numbers_that_do_not_exist_are_refused) {
  BOOST_TEST(!controller.connect(96, drivers::Trigger::level_high, count, &calls));
  BOOST_TEST(!controller.connect(61, drivers::Trigger::level_high, nullptr, nullptr));
  controller.disconnect(96);
}

BOOST_AUTO_TEST_SUITE_END()
