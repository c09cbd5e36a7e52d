// Looks from outside at a program that runs: at a time, and at its failure. They change nothing.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>

#include "bench.h"

using namespace bench;

namespace {

/// What a run of every kind of call left behind.
struct Course {
  std::vector<std::uint64_t> accesses, interrupts;
  std::uint64_t end_ps = 0, busy_ps = 0, idle_ps = 0, looked_ps = 0;
  bool operator==(const Course& o) const {
    return accesses == o.accesses && interrupts == o.interrupts && end_ps == o.end_ps &&
           busy_ps == o.busy_ps && idle_ps == o.idle_ps;
  }
};

std::vector<std::uint64_t> handled;

/// Work, accesses, a poll and a sleep; interrupts at 250 ns in the work, and at 2 us in the sleep.
Course run(std::optional<std::uint64_t> look_ps, const Settings& settings = {}) {
  Bench b(settings);
  Course course;
  handled.clear();
  b.device.delay_ps = 7'000;
  b.device.value = [](std::uint64_t ps) { return ps < 900'000 ? 1u : 2u; };
  b.device.written = [&](std::uint32_t) { b.n_irq = true; };
  b.set_n_irq_at(250'000, false);
  b.set_n_irq_at(2'000'000, false);
  if (look_ps) b.cpu.call_at(*look_ps, [&] { course.looked_ps = now_ps(); });
  b.run([] {
    hal_interrupt_connect(
        [](void*) {
          hal_work(step, 10);
          hal_write32(device_address + 4, 1);
          handled.push_back(now_ps());
        },
        nullptr);
    hal_interrupt_enable(true);
    hal_function_enter(outer);
    for (int i = 0; i < 100; ++i) hal_work(load, 1);
    hal_read32(device_address);
    hal_work(step, 20);
    hal_function_leave();
    hal_poll_until_changed(device_address, 1, 3, 1000);
    hal_interrupt_enable(false);
    while (handled.size() < 2) {
      hal_wait_for_interrupt();
      hal_interrupt_enable(true);
      hal_interrupt_enable(false);
    }
    hal_work(step, 5);
    return 0;
  });
  course.accesses = b.device.times();
  course.interrupts = handled;
  course.end_ps = b.cpu.end_ps();
  course.busy_ps = b.cpu.activity().busy_ps();
  course.idle_ps = b.cpu.activity().idle_ps();
  return course;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_look)

BOOST_AUTO_TEST_CASE(a_time_is_met_in_every_kind_of_call_and_nothing_changes) {
  for (const Settings& settings : {Settings{}, Settings{"cpu.quantum=0 ps"}}) {
    const Course alone = run(std::nullopt, settings);
    BOOST_TEST(alone.interrupts.size() == 2u);
    BOOST_TEST(alone.idle_ps > 900'000u);
    for (std::uint64_t ps = 1'000; ps < alone.end_ps; ps += 61'300) {
      const Course looked = run(ps, settings);
      BOOST_TEST((looked == alone), "at " << ps);
      // What is on the bus is not cut: the look comes when the program continues.
      BOOST_TEST(looked.looked_ps >= ps);
      BOOST_TEST(looked.looked_ps <= ps + 10'000);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_time_in_the_middle_of_work_or_sleep_is_met_exactly) {
  for (const std::uint64_t ps : {100'000u, 1'500'000u}) BOOST_TEST(run(ps).looked_ps == ps);
}

BOOST_AUTO_TEST_CASE(a_time_after_the_end_is_never_met) {
  BOOST_TEST(run(1'000'000'000).looked_ps == 0u);
}

BOOST_AUTO_TEST_CASE(the_time_out_is_the_same_after_a_look) {
  Bench b({"cpu.timeout=1 ms"});
  std::uint64_t looked_ps = 0;
  b.cpu.call_at(400'000'000, [&] { looked_ps = now_ps(); });
  b.run(
      [] {
        hal_wait_for_interrupt();
        return 0;
      },
      false);
  BOOST_TEST(looked_ps == 400'000'000u);
  BOOST_TEST(b.failure().find("it waits for an interrupt, and none came within 1 ms") == 0u,
             b.failure());
  BOOST_TEST(b.cpu.end_ps() == 1'000'000'000u);
}

BOOST_AUTO_TEST_CASE(a_failure_is_told_before_the_program_is_left) {
  Bench b;
  std::vector<std::string> told;
  bool in_call = false;
  b.cpu.on_failure([&](const std::string& problem) {
    told.push_back(problem);
    BOOST_TEST(in_call);
  });
  b.device.status = tlm::TLM_ADDRESS_ERROR_RESPONSE;
  b.run(
      [&] {
        in_call = true;
        hal_read32(device_address);
        in_call = false;
        return 0;
      },
      false);
  BOOST_TEST_REQUIRE(told.size() == 1u);
  BOOST_TEST(told[0] == b.failure());
}

BOOST_AUTO_TEST_CASE(a_fault_is_told_before_its_stack_is_left) {
  Bench b;
  std::vector<std::string> told;
  b.cpu.on_failure([&](const std::string& problem) { told.push_back(problem); });
  b.run(
      [] {
        *reinterpret_cast<volatile int*>(std::uintptr_t{8}) = 1;
        return 0;
      },
      false);
  BOOST_TEST_REQUIRE(!told.empty());
  BOOST_TEST(told[0].find("segmentation fault: write to 0x00000008 (a null pointer), at 0 ") == 0u,
             told[0]);
}

BOOST_AUTO_TEST_SUITE_END()
