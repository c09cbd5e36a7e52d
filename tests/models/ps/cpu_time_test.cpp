// Simulated time of a program: exact, in ps, and independent of how it is cut.
#include "bench.h"

#include <boost/test/unit_test.hpp>

using namespace bench;

BOOST_AUTO_TEST_SUITE(cpu_time)

BOOST_AUTO_TEST_CASE(work_passes_before_a_register_access) {
  Bench b;
  b.run([] {
    hal_work(step, 100);
    hal_work(load, 10);  // 25 cycles and 30 ns
    hal_read32(device_address);
    hal_work(step, 7);
    return 0;
  });
  BOOST_TEST(b.device.times() == (std::vector<std::uint64_t>{155'000}),
             boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 162'000u);
  BOOST_TEST(now_ps() == 162'000u);
  BOOST_TEST(kit::now_ps() == 162'000u, "at the end SystemC has caught up");
  BOOST_TEST(b.cpu.activity().busy_ps() == 162'000u);
}

BOOST_AUTO_TEST_CASE(work_is_counted_by_unit) {
  Bench b;
  b.run([] {
    for (int i = 0; i < 3; ++i) hal_work(load, 5);
    return 0;
  });
  BOOST_TEST(b.cpu.work().counts()[step].count == 0u);
  BOOST_TEST(b.cpu.work().counts()[load].count == 15u);
  BOOST_TEST(b.cpu.work().counts()[load].name == "load");
  BOOST_TEST(b.cpu.work().counts()[load].cycles == 2.5);
  BOOST_TEST(b.cpu.work().counts()[load].stall_ns == 3.0);
  BOOST_TEST(b.cpu.cost_profile() == "test");
}

BOOST_AUTO_TEST_CASE(an_access_takes_what_the_device_takes) {
  Bench b;
  b.device.wait_ps = 5'000;
  b.device.delay_ps = 20'000;
  b.device.value = [](std::uint64_t ps) { return static_cast<std::uint32_t>(ps); };
  b.run([] {
    BOOST_TEST(hal_read32(device_address + 8) == 5'000u);
    hal_write32(device_address + 4, 0xABCD);
    hal_work(step, 1);
    return 0;
  });
  const std::vector<Device::Access> expected{{false, 8, 5'000, 5'000}, {true, 4, 0xABCD, 30'000}};
  BOOST_TEST(b.device.log == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 51'000u);
  BOOST_TEST(b.cpu.activity().busy_ps() == 51'000u);
}

BOOST_AUTO_TEST_CASE(barriers_and_cache_operations_take_cycles) {
  Bench b({"cpu.barrier_cycles=20 cycles", "cpu.cache_call_cycles=60 cycles",
           "cpu.cache_line_cycles=10 cycles"});
  alignas(32) static char data[128];
  std::vector<std::uint64_t> times;
  b.run([&] {
    hal_barrier();
    times.push_back(now_ps());
    hal_cache_flush(data, sizeof data);  // 4 lines
    times.push_back(now_ps());
    hal_cache_invalidate(data + 31, 2);  // 2 lines
    times.push_back(now_ps());
    hal_cache_flush(data, 0);
    times.push_back(now_ps());
    return 0;
  });
  const std::vector<std::uint64_t> expected{20'000, 140'000, 240'000, 320'000};
  BOOST_TEST(times == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.barriers == 4u);
  BOOST_TEST(b.cpu.cache_lines == 6u);
}

BOOST_AUTO_TEST_CASE(a_poll_reads_on_its_own_grid_until_the_word_changes) {
  Bench b;
  b.device.delay_ps = 40'000;
  b.device.value = [](std::uint64_t ps) { return ps >= 151'000 ? 9u : 3u; };
  hal_poll_result result{};
  b.run([&] {
    hal_work(step, 1);
    result = hal_poll_until_changed(device_address, 3, 10, 100);
    return 0;
  });
  const std::vector<std::uint64_t> grid{1'000, 51'000, 101'000, 151'000};
  BOOST_TEST(b.device.times() == grid, boost::test_tools::per_element());
  BOOST_TEST(result.value == 9u);
  BOOST_TEST(result.polls == 4u);
  BOOST_TEST(result.changed);
  BOOST_TEST(b.cpu.polls == 4u);
  BOOST_TEST(b.cpu.end_ps() == 201'000u);
}

BOOST_AUTO_TEST_CASE(a_poll_stops_at_its_limit) {
  Bench b;
  b.device.value = [](std::uint64_t) { return 3u; };
  b.run([&] {
    const hal_poll_result none = hal_poll_until_changed(device_address, 3, 10, 0);
    BOOST_TEST(!none.changed);
    BOOST_TEST(none.polls == 0u);
    const hal_poll_result five = hal_poll_until_changed(device_address, 3, 10, 5);
    BOOST_TEST(!five.changed);
    BOOST_TEST(five.polls == 5u);
    BOOST_TEST(five.value == 3u);
    return 0;
  });
  BOOST_TEST(b.cpu.end_ps() == 50'000u);
}

std::pair<std::vector<std::uint64_t>, std::vector<std::uint64_t>> function_changes(
    const Settings& settings) {
  Bench b(settings);
  Changes changes(b.cpu.function, b.scheduler);
  b.run([] {
    hal_work(step, 10);
    hal_function_enter(outer);
    hal_work(step, 20);
    hal_function_enter(inner);
    hal_work(step, 30);
    hal_function_leave();
    hal_work(step, 40);
    hal_function_leave();
    hal_work(step, 50);
    return 0;
  });
  const auto& functions = b.cpu.activity().functions();
  BOOST_TEST(functions[outer].calls == 1u);
  BOOST_TEST(functions[outer].self_ps == 60'000u);
  BOOST_TEST(functions[outer].total_ps == 90'000u);
  BOOST_TEST(functions[inner].self_ps == 30'000u);
  BOOST_TEST(functions[dispatch].calls == 0u);
  BOOST_TEST(b.cpu.end_ps() == 150'000u);
  return {changes.times, changes.values};
}

BOOST_AUTO_TEST_CASE(the_function_signal_changes_at_the_exact_time) {
  const std::vector<std::uint64_t> times{10'000, 30'000, 60'000, 100'000};
  const std::vector<std::uint64_t> values{outer + 1, inner + 1, outer + 1, 0};
  for (const char* quantum : {"0 ps", "7 ns", "100 us"}) {
    const auto [changed, to] = function_changes({std::string("cpu.quantum=") + quantum});
    BOOST_TEST(changed == times, boost::test_tools::per_element());
    BOOST_TEST(to == values, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(a_function_that_calls_itself_counts_its_total_once) {
  Bench b;
  b.run([] {
    hal_function_enter(outer);
    hal_work(step, 1);
    hal_function_enter(outer);
    hal_work(step, 2);
    hal_function_leave();
    hal_function_leave();
    return 0;
  });
  BOOST_TEST(b.cpu.activity().functions()[outer].calls == 2u);
  BOOST_TEST(b.cpu.activity().functions()[outer].total_ps == 3'000u);
}

std::uint64_t end_of(std::uint64_t hertz, std::function<int()> body) {
  Bench b({}, hertz);
  b.run(std::move(body));
  return b.cpu.end_ps();
}

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_how_work_is_split) {
  // 1000 units of 2.5 cycles and 3 ns: 3 749 999.887… ps and 3 µs, rounded down.
  constexpr std::uint64_t hertz = 666'666'687;
  const std::uint64_t whole = end_of(hertz, [] {
    hal_work(load, 1000);
    return 0;
  });
  const std::uint64_t split = end_of(hertz, [] {
    for (int i = 0; i < 1000; ++i) {
      if (i % 7 == 0) hal_option(0);
      if (i % 5 == 0) hal_function_enter(inner);
      hal_work(load, 1);
      if (i % 5 == 0) hal_function_leave();
      if (i % 3 == 0) hal_interrupt_enable(false);  // catches up; takes no time itself
    }
    return 0;
  });
  BOOST_TEST(whole == 6'749'999u);
  BOOST_TEST(split == whole);
}

BOOST_AUTO_TEST_CASE(the_clock_of_the_cpu_may_change) {
  Bench b;
  b.device.written = [&](std::uint32_t value) { b.cpu_clock.set_frequency(value); };
  b.run([] {
    hal_work(step, 100);
    hal_write32(device_address, 500'000'000);
    hal_work(step, 100);
    return 0;
  });
  BOOST_TEST(b.cpu.end_ps() == 300'000u);
}

BOOST_AUTO_TEST_SUITE_END()
