// Programs that do wrong: the run ends with one line, and what was done before is kept.
#include <vp/error.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <stdexcept>

#include <hal/option_data.h>

#include "bench.h"

using namespace bench;

namespace {

std::string failure_of(Bench& b, std::function<int()> body) {
  b.run(std::move(body), false);
  BOOST_TEST((b.cpu.state() == ps::Cpu::State::failed));
  BOOST_CHECK_THROW(b.cpu.check(), vp::ProtocolError);
  return b.failure();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_errors)

BOOST_AUTO_TEST_CASE(a_program_that_ends_well) {
  Bench b;
  BOOST_TEST((b.cpu.state() == ps::Cpu::State::waiting));
  b.run([] { return 7; });
  BOOST_TEST((b.cpu.state() == ps::Cpu::State::finished));
  BOOST_TEST(b.cpu.exit_code() == 7);
}

BOOST_AUTO_TEST_CASE(nothing_mapped) {
  Bench b;
  const std::string error = failure_of(b, [] {
    hal_function_enter(inner);
    hal_work(step, 12);
    hal_read32(0x4123'0000);
    return 0;
  });
  BOOST_TEST(error ==
             "data abort: read of 0x41230000: DECERR, nothing answers there, at 12 ns in function "
             "'inner' of program 'bench'");
  BOOST_TEST(b.cpu.end_ps() == 12'000u);
  BOOST_TEST(b.cpu.work().counts()[step].count == 12u);
}

BOOST_AUTO_TEST_CASE(the_device_refuses) {
  Bench b;
  b.cpu.surroundings.device = [](std::uint32_t address) {
    return ps::Answerer{address == device_address + 4 ? "gpio" : ""};
  };
  b.device.status = tlm::TLM_COMMAND_ERROR_RESPONSE;
  BOOST_TEST(
      failure_of(b,
                 [] {
                   hal_write32(device_address + 4, 1);
                   return 0;
                 }) ==
      "data abort: write to 0x40000004 (gpio): SLVERR, the device does not allow it, at 0 ps "
      "of program 'bench'");
}

BOOST_AUTO_TEST_CASE(every_answer_of_a_device_has_its_words) {
  const std::vector<std::pair<tlm::tlm_response_status, std::string>> answers{
      {tlm::TLM_BURST_ERROR_RESPONSE, "size or alignment"},
      {tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE, "part of a word"},
      {tlm::TLM_GENERIC_ERROR_RESPONSE, "reports an error"},
      {tlm::TLM_INCOMPLETE_RESPONSE, "its model is wrong"}};
  for (const auto& [status, words] : answers) {
    Bench b;
    b.device.status = status;
    const std::string error = failure_of(b, [] { return hal_read32(device_address) ? 1 : 0; });
    BOOST_TEST(error.find(words) != std::string::npos, error);
  }
}

BOOST_AUTO_TEST_CASE(an_unaligned_access) {
  Bench b;
  const std::string error = failure_of(b, [] { return hal_read32(device_address + 2) ? 1 : 0; });
  BOOST_TEST(error.find("0x40000002, which is not a multiple of 4") != std::string::npos, error);
  BOOST_TEST(b.device.log.empty());
}

BOOST_AUTO_TEST_CASE(an_error_inside_the_handler) {
  Bench b;
  b.set_n_irq_at(5'000, false);
  const std::string error = failure_of(b, [] {
    hal_interrupt_connect([](void*) { hal_read32(0); }, nullptr);
    hal_interrupt_enable(true);
    hal_work(step, 10);
    hal_barrier();
    return 0;
  });
  BOOST_TEST(error ==
             "data abort: read of 0x00000000: DECERR, nothing answers there, at 105 ns in the "
             "interrupt handler of program 'bench'");
}

BOOST_AUTO_TEST_CASE(the_program_is_frozen_not_unwound) {
  static bool destroyed;
  destroyed = false;
  struct Guard {
    ~Guard() { destroyed = true; }
  };
  Bench b;
  failure_of(b, [] {
    const Guard guard;
    hal_read32(0);
    return 0;
  });
  BOOST_TEST(!destroyed);
}

BOOST_AUTO_TEST_CASE(a_program_that_catches_everything_does_not_catch_this) {
  Bench b;
  static bool caught;
  caught = false;
  failure_of(b, [] {
    try {
      hal_read32(0);
    } catch (...) {
      caught = true;
    }
    return 0;
  });
  BOOST_TEST(!caught);
}

BOOST_AUTO_TEST_CASE(of_a_register_that_is_read_for_ever_the_bits_that_changed_are_told) {
  Bench b({"cpu.timeout=1 us"});
  b.device.delay_ps = 40'000;
  b.device.value = [](std::uint64_t ps) { return ps > 500'000 ? 0x13u : 0x10u; };
  const std::string error = failure_of(b, [] {
    while (true) hal_read32(device_address);
    return 0;
  });
  BOOST_TEST(
      error.find("; the last register that it read was 0x40000000: 0x00000013, 25 times in a "
                 "row, of which only the bits 0x00000003 changed, at 1 us") != error.npos,
      error);
}

BOOST_AUTO_TEST_CASE(endless_work_polling_sleeping_and_reading_hit_the_timeout) {
  const Settings settings{"cpu.timeout=1 us"};
  const std::string head =
      "no end within 1 us of simulated time since the last input (cpu.timeout)";
  struct Loop {
    std::function<void()> body;
    std::string hint;
  };
  const std::vector<Loop> loops{
      {[] { hal_work(step, 3); }, ""},
      {[] { hal_read32(device_address); },
       "; the last register that it read was 0x40000000: 0x00000000, 25 times in a row, of which "
       "no "
       "bit changed"},
      {[] { hal_read32(device_address), hal_read32(device_address + 8); },
       "; the last register that it read was 0x40000000: 0x00000000"},
      {[] { hal_poll_until_changed(device_address, 0, 10, 0xFFFF'FFFF); },
       "; it polls for a change of any bit of 0x40000000: 0x00000000"},
      {[] { hal_barrier(); }, ""},
  };
  for (const auto& [loop, hint] : loops) {
    Bench b(settings);
    b.device.delay_ps = 40'000;
    const std::string error = failure_of(b, [&] {
      while (true) loop();
      return 0;
    });
    BOOST_TEST(error == head + hint + ", at 1 us of program 'bench'");
    BOOST_TEST(b.cpu.end_ps() == 1'000'000u);
  }
  Bench b(settings);
  const std::string error = failure_of(b, [&] {
    hal_function_enter(outer);
    hal_wait_for_interrupt();
    return 0;
  });
  BOOST_TEST(
      error ==
      "it waits for an interrupt, and none came within 1 us of simulated time since the last "
      "input (cpu.timeout), at 1 us in function 'outer' of program 'bench'");
  BOOST_TEST(b.cpu.activity().idle_ps() == 1'000'000u);
}

BOOST_AUTO_TEST_CASE(the_timeout_counts_the_same_work_under_any_quantum) {
  std::vector<std::uint64_t> counts;
  for (const char* quantum : {"0 ps", "10 ns", "100 us", "10 s"}) {
    Bench b({"cpu.timeout=1 us", std::string("cpu.quantum=") + quantum}, 666'666'687);
    failure_of(b, [] {
      while (true) hal_work(load, 1);
      return 0;
    });
    counts.push_back(b.cpu.work().counts()[load].count);
  }
  // 6.75 ns each: the 149th reaches 1 us.
  const std::vector<std::uint64_t> expected(4, 149);
  BOOST_TEST(counts == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(mistakes_with_annotations_and_options) {
  const std::vector<std::pair<std::function<void()>, std::string>> mistakes{
      {[] { hal_work(2, 1); }, "hal_work(2): no such unit of work"},
      {[] { hal_function_enter(3); }, "hal_function_enter(3): no such function"},
      {[] { hal_function_leave(); }, "hal_function_leave() without hal_function_enter()"},
      {[] { hal_option(2); }, "hal_option(2): no such option"},
      {[] {
         std::size_t size = 0;
         hal_option_data(0, &size);
       },
       "hal_option_data(0): no such option of a file"},
  };
  for (const auto& [mistake, message] : mistakes) {
    Bench b;
    const std::string error = failure_of(b, [m = mistake] {
      hal_work(step, 5);
      m();
      return 0;
    });
    BOOST_TEST(error == message + ", at 5 ns of program 'bench'");
  }
}

BOOST_AUTO_TEST_CASE(a_handler_may_not_leave_what_it_did_not_enter) {
  for (const bool leaves : {true, false}) {
    Bench b;
    b.set_n_irq_at(5'000, false);
    static bool leave;
    leave = leaves;
    const std::string error = failure_of(b, [] {
      hal_interrupt_connect([](void*) { leave ? hal_function_leave() : hal_function_enter(inner); },
                            nullptr);
      hal_interrupt_enable(true);
      hal_function_enter(outer);
      hal_work(step, 10);
      hal_barrier();
      return 0;
    });
    const std::string words =
        leaves ? "without hal_function_enter()" : "without leaving its function";
    BOOST_TEST(error.find(words) != std::string::npos, error);
  }
}

BOOST_AUTO_TEST_CASE(an_interrupt_that_nobody_acknowledges) {
  Bench b({"cpu.timeout=1 ms"});
  vp::ReportRouter reports;
  std::ostringstream ignored;
  reports.redirect(ignored);
  b.set_n_irq_at(5'000, false);
  failure_of(b, [] {
    hal_interrupt_connect([](void*) {}, nullptr);
    hal_interrupt_enable(true);
    while (true) hal_work(step, 10);
    return 0;
  });
  BOOST_TEST(reports.count("/markervp/cpu/not_acknowledged") == 1u);
}

// Each asks again after the handler has begun.
BOOST_AUTO_TEST_CASE(interrupts_that_overrun_the_handler) {
  Bench b({"cpu.timeout=1 ms"});
  vp::ReportRouter reports;
  std::ostringstream text;
  reports.redirect(text);
  b.cpu.surroundings.request = [&b] { return ps::Surroundings::Request{"a tick", now_ps()}; };
  b.set_n_irq_at(5'000, false);
  failure_of(b, [] {
    hal_interrupt_connect([](void*) {}, nullptr);
    hal_interrupt_enable(true);
    while (true) hal_work(step, 10);
    return 0;
  });
  BOOST_TEST(reports.count("/markervp/cpu/not_acknowledged") == 0u);
  BOOST_TEST(reports.count("/markervp/cpu/overrun") == 1u);
  BOOST_TEST(text.str().find("with the next one pending (a tick)") != std::string::npos,
             text.str());
}

BOOST_AUTO_TEST_CASE(an_endless_poll_names_its_register) {
  Bench b({"cpu.timeout=1 ms"});
  b.cpu.surroundings.register_text = [](std::uint32_t address, std::uint32_t) {
    return address == device_address ? "device.STATUS" : "";
  };
  const std::string error = failure_of(b, [] {
    while (!hal_poll_until_changed(device_address, 0, 10, 100).changed) continue;
    return 0;
  });
  BOOST_TEST(error.find("; it polls for a change of any bit of device.STATUS, at 1 ms") !=
                 std::string::npos,
             error);
}

BOOST_AUTO_TEST_CASE(a_sleep_while_interrupts_are_unmasked) {
  for (const bool unmasked : {false, true}) {
    Bench b;
    vp::ReportRouter reports;
    std::ostringstream ignored;
    reports.redirect(ignored);
    b.set_n_irq_at(5'000, false);
    static bool enable;
    enable = unmasked;
    b.device.written = [&b](std::uint32_t) { b.n_irq = true; };
    b.run([] {
      hal_interrupt_connect([](void*) { hal_write32(device_address, 1); }, nullptr);
      hal_interrupt_enable(enable);
      hal_wait_for_interrupt();
      return 0;
    });
    BOOST_TEST(reports.count("/markervp/cpu/sleeps_unmasked") == (unmasked ? 1u : 0u));
  }
}

BOOST_AUTO_TEST_CASE(an_exception_of_the_program) {
  Bench b;
  BOOST_TEST(failure_of(b, []() -> int { throw std::runtime_error("oops"); }) ==
             "the program threw an exception: oops, at 0 ps of program 'bench'");
  Bench c;
  BOOST_TEST(failure_of(c, []() -> int { throw 1; }) ==
             "the program threw an exception, at 0 ps of program 'bench'");
}

namespace {

struct ThrowingBench : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t) override { throw vp::InputError("no such image"); }
  bool publish(std::uint32_t, const void*, std::size_t, std::uint64_t) override { return true; }
  double option(std::uint32_t, const hal_option_info&) override { return 1; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_exception_of_the_test_bench_stays_what_it_is) {
  Bench b;
  ThrowingBench bench;
  b.cpu.connect(bench);
  b.run([] { return hal_frame_next() ? 1 : 0; }, false);
  BOOST_CHECK_THROW(b.cpu.check(), vp::InputError);
  BOOST_TEST(b.failure() == "no such image");
}

BOOST_AUTO_TEST_CASE(a_stopped_cpu_clock) {
  Bench b;
  b.device.written = [&](std::uint32_t) { b.cpu_clock.set_frequency(0); };
  const std::string error = failure_of(b, [] {
    hal_write32(device_address, 0);
    hal_work(step, 1);
    return 0;
  });
  BOOST_TEST(error == "the clock of the CPU was stopped, at 0 ps of program 'bench'");
}

BOOST_AUTO_TEST_CASE(a_unit_of_work_without_cost) {
  Bench b;
  auto program = ps::Program::linked(bench::program([] { return 0; }));
  ps::CostTable table("sparse");
  table.set("step", {1, 0});
  table.set("loads", {1, 0});
  BOOST_CHECK_EXCEPTION(b.cpu.load(*program, table), vp::InputError, [](const auto& error) {
    return std::string(error.what()) ==
           "cost table 'sparse' has no entry for 'load', a unit of work of program 'bench': add it "
           "to other_units of a profile of your own (nearest entry: 'loads')";
  });
}

BOOST_AUTO_TEST_CASE(absurd_costs_are_refused) {
  ps::CostTable table("test");
  const double bad[] = {-1.0, 2e9, std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    BOOST_CHECK_EXCEPTION(table.set("grid_samples", {value, 0}), vp::InputError, [](const auto& e) {
      return std::string(e.what()).find("grid_samples") != std::string::npos;
    });
    BOOST_CHECK_THROW(table.set("grid_samples", {0, value}), vp::InputError);
  }
  BOOST_TEST(table.entries().empty());
}

BOOST_AUTO_TEST_CASE(the_hal_outside_of_a_program) {
  BOOST_CHECK_EXCEPTION(hal_barrier(), vp::ProtocolError, [](const auto& error) {
    return std::string(error.what()) == "hal_barrier() was called, but no program runs";
  });
}

BOOST_AUTO_TEST_SUITE_END()
