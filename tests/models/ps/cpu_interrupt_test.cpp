// Interrupts reach the handler at exact times, wherever the program is.
#include <ucontext.h>

#include <ps/interconnect/interconnect.h>
#include <array>
#include <boost/test/unit_test.hpp>
#include <utility>

#include "bench.h"

using namespace bench;

namespace {

/// Handler times and what else a test wants to see.
std::vector<std::uint64_t> seen;

/// Acknowledges at the device, which raises nIRQ again.
void acknowledge(void*) {
  seen.push_back(now_ps());
  hal_write32(device_address, 1);
}

const Settings settings{"cpu.interrupt_entry=100 cycles", "cpu.interrupt_exit=60 cycles"};

/// nIRQ falls at given times; a write to the device raises it.
struct InterruptBench : Bench {
  explicit InterruptBench(std::vector<std::uint64_t> falls, Settings more = {})
      : Bench(merged(std::move(more))) {
    for (const std::uint64_t ps : falls) set_n_irq_at(ps, false);
    device.written = [this](std::uint32_t) { n_irq = true; };
    seen.clear();
  }
  static Settings merged(Settings more) {
    more.insert(more.end(), settings.begin(), settings.end());
    return more;
  }
};

void enable() {
  hal_interrupt_connect(acknowledge, nullptr);
  hal_interrupt_enable(true);
}

using Times = std::vector<std::uint64_t>;

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_interrupt)

BOOST_AUTO_TEST_CASE(work_is_interrupted_in_the_middle_and_goes_on) {
  InterruptBench b({400'000});
  b.run([] {
    enable();
    hal_work(step, 1000);
    hal_read32(device_address);
    return 0;
  });
  BOOST_TEST(seen == Times{400'000}, boost::test_tools::per_element());
  // The handler's access after 100 cycles of entry; the program's 60 cycles of exit and 600 of work
  // later.
  const Times expected{500'000, 1'160'000};
  BOOST_TEST(b.device.times() == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.interrupts == 1u);
  BOOST_TEST(b.cpu.activity().handler_ps() == 160'000u);
  BOOST_TEST(b.cpu.activity().busy_ps() == 1'160'000u);
}

BOOST_AUTO_TEST_CASE(in_handler_shows_entry_to_exit) {
  InterruptBench b({400'000});
  Changes changes(b.cpu.in_handler, b.scheduler);
  b.run([] {
    enable();
    hal_work(step, 1000);
    hal_barrier();
    return 0;
  });
  const Times expected{400'000, 560'000};
  BOOST_TEST(changes.times == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(an_interrupt_during_an_access_waits_for_its_end) {
  InterruptBench b({20'000});
  b.device.wait_ps = 10'000;
  b.device.delay_ps = 30'000;
  b.run([] {
    enable();
    hal_read32(device_address);
    hal_barrier();
    return 0;
  });
  BOOST_TEST(seen == Times{40'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_masked_interrupt_waits_for_the_unmasking) {
  InterruptBench b({100'000});
  b.run([] {
    hal_interrupt_connect(acknowledge, nullptr);
    hal_work(step, 300);
    hal_barrier();
    BOOST_TEST(seen.empty());
    BOOST_TEST(!hal_interrupt_enable(true));
    BOOST_TEST(seen.size() == 1u);
    BOOST_TEST(hal_interrupt_enable(false));
    BOOST_TEST(!hal_interrupt_enable(false));
    return 0;
  });
  BOOST_TEST(seen == Times{320'000}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(an_interrupt_that_was_withdrawn_is_not_taken) {
  InterruptBench b({100'000});
  b.set_n_irq_at(200'000, true);
  b.run([] {
    hal_interrupt_connect(acknowledge, nullptr);
    hal_work(step, 300);
    hal_interrupt_enable(true);
    return 0;
  });
  BOOST_TEST(seen.empty());
  BOOST_TEST(b.cpu.interrupts == 0u);
}

BOOST_AUTO_TEST_CASE(handlers_do_not_nest) {
  InterruptBench b({100'000});
  static int depth, deepest;
  depth = deepest = 0;
  const auto handler = [](void*) {
    deepest = std::max(deepest, ++depth);
    hal_interrupt_enable(true);  // does not let another one in
    if (seen.size() < 2) {
      seen.push_back(now_ps());
      hal_barrier();  // nIRQ is low all the time
    } else {
      acknowledge(nullptr);
    }
    --depth;
  };
  b.run([&] {
    hal_interrupt_connect(handler, nullptr);
    hal_interrupt_enable(true);
    hal_work(step, 1000);
    hal_barrier();
    BOOST_TEST(hal_interrupt_enable(true));
    return 0;
  });
  // Unmasking catches up with the 100 cycles of entry; then 20 of the barrier and 60 of exit.
  const Times expected{200'000, 380'000, 560'000};
  BOOST_TEST(seen == expected, boost::test_tools::per_element());
  BOOST_TEST(deepest == 1);
  BOOST_TEST(b.cpu.interrupts == 3u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_between_two_polls_shifts_the_grid) {
  InterruptBench b({75'000});
  b.device.delay_ps = 40'000;
  b.device.value = [](std::uint64_t ps) { return ps >= 300'000 ? 1u : 0u; };
  hal_poll_result result{};
  b.run([&] {
    enable();
    result = hal_poll_until_changed(device_address, 0, 10, 100);
    return 0;
  });
  BOOST_TEST(seen == Times{90'000}, boost::test_tools::per_element());
  // Polls at 0 and 50 ns. The interrupt waits for the second one's end at 90 ns: handler's write at
  // 190 ns, 40 ns, exit at 290 ns, then the 10 cycles of the loop.
  const Times expected{0, 50'000, 190'000, 300'000};
  BOOST_TEST(b.device.times() == expected, boost::test_tools::per_element());
  BOOST_TEST(result.polls == 3u);
}

BOOST_AUTO_TEST_CASE(waiting_for_an_interrupt_sleeps_until_it_comes) {
  InterruptBench b({700'000});
  b.run([] {
    enable();
    hal_work(step, 200);
    hal_wait_for_interrupt();
    BOOST_TEST(seen.size() == 1u);
    return 0;
  });
  BOOST_TEST(seen == Times{700'000}, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 860'000u);
  BOOST_TEST(b.cpu.activity().idle_ps() == 500'000u);
  BOOST_TEST(b.cpu.activity().busy_ps() == 360'000u);
}

BOOST_AUTO_TEST_CASE(a_masked_interrupt_ends_the_sleep_without_handler) {
  InterruptBench b({700'000});
  b.run([] {
    hal_interrupt_connect(acknowledge, nullptr);
    hal_wait_for_interrupt();
    BOOST_TEST(now_ps() == 700'000u);
    BOOST_TEST(seen.empty());
    hal_wait_for_interrupt();  // still pending: no sleep
    BOOST_TEST(now_ps() == 700'000u);
    hal_interrupt_enable(true);
    BOOST_TEST(seen.size() == 1u);
    return 0;
  });
  BOOST_TEST(b.cpu.activity().idle_ps() == 700'000u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_without_handler_ends_the_run) {
  InterruptBench b({100'000});
  b.run(
      [] {
        hal_interrupt_enable(true);
        hal_work(step, 300);
        hal_barrier();
        return 0;
      },
      false);
  BOOST_TEST(b.failure() ==
             "an interrupt is pending and IRQ is unmasked, but no handler is connected, at 100 ns "
             "of program 'bench'");
}

namespace {

/// Lowers nIRQ on one edge of the PL's clock: the clocks run ahead of the simulation.
struct PlSource : vp::Clocked {
  PlSource(sc_core::sc_module_name name, vp::Clock& clock, vp::Signal<bool>& n_irq)
      : vp::Clocked(name, clock), n_irq(n_irq) {}
  void edge() override {
    if (clock().cycle() == 37) n_irq = false;
    if (clock().cycle() == 500) sleep();
  }
  vp::Signal<bool>& n_irq;
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_interrupt_from_a_clock_edge_comes_at_the_time_of_the_edge) {
  InterruptBench b({});
  PlSource source("source", b.pl_clock, b.n_irq);
  b.run([] {
    enable();
    hal_work(step, 1000);
    hal_barrier();
    return 0;
  });
  BOOST_TEST(seen == Times{370'000}, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.end_ps() == 1'180'000u);
}

BOOST_AUTO_TEST_CASE(an_edge_at_the_very_time_of_the_check_counts) {
  InterruptBench b({});
  PlSource source("source", b.pl_clock, b.n_irq);
  b.run([] {
    enable();
    hal_work(step, 350);
    hal_barrier();  // 20 cycles: ends at 370 ns
    BOOST_TEST(seen.size() == 1u);
    return 0;
  });
  BOOST_TEST(seen == Times{370'000}, boost::test_tools::per_element());
}

namespace {

/// Lowers nIRQ on every 611th edge of the PL's clock.
struct PlPulses : vp::Clocked {
  PlPulses(sc_core::sc_module_name name, vp::Clock& clock, vp::Signal<bool>& n_irq)
      : vp::Clocked(name, clock), n_irq(n_irq) {}
  void edge() override {
    if (clock().cycle() % 611 == 37) n_irq = false;
  }
  vp::Signal<bool>& n_irq;
};

/// A program with everything, under a quantum: what it did, and when.
struct Trail {
  std::vector<Device::Access> accesses, pl_accesses;
  Times handlers, functions, numbers;
};

Trail trail(const std::string& quantum) {
  InterruptBench b({90'000, 400'000, 2'000'123, 5'100'000, 30'000'000}, {"cpu.quantum=" + quantum});
  PlPulses pulses("pulses", b.pl_clock, b.n_irq);
  ps::GpPort port("port", b.pl_clock);
  Device slave("slave", b.scheduler);
  constexpr std::uint32_t slave_address = 0x8000'0000;
  b.bus.map("m_axi_gp0", slave_address, 0x1000).bind(port.socket);
  port.link.socket.bind(slave.socket);
  slave.value = [](std::uint64_t ps) { return static_cast<std::uint32_t>(ps / 700'000); };
  b.device.delay_ps = 37'000;
  Changes functions(b.cpu.function, b.scheduler);
  Changes handlers(b.cpu.in_handler, b.scheduler);
  Trail result;
  static volatile int plain;
  plain = 0;
  const auto handler = [](void*) {
    hal_function_enter(dispatch);
    plain = plain + 1;
    hal_work(load, 3);
    acknowledge(nullptr);
    hal_function_leave();
  };
  b.run([&] {
    hal_interrupt_connect(handler, nullptr);
    hal_interrupt_enable(true);
    std::uint32_t last = 0;
    for (int round = 0; round < 20; ++round) {
      hal_function_enter(round % 2 ? outer : inner);
      for (int i = 0; i < 50; ++i) hal_work(i % 2 ? load : step, 10);
      const int before = plain;
      hal_work(step, 500);
      // Handlers run in calls that catch up, not in annotations.
      result.numbers.push_back(static_cast<std::uint64_t>(plain - before));
      last = hal_poll_until_changed(slave_address, last, 13, 1000).value;
      hal_function_leave();
      if (round % 3 == 0) hal_wait_for_interrupt();
    }
    hal_work(step, 1);
    return 0;
  });
  result.accesses = b.device.log;
  result.pl_accesses = slave.log;
  result.functions = functions.times;
  result.handlers = handlers.times;
  result.numbers.push_back(b.cpu.end_ps());
  for (const auto& f : b.cpu.activity().functions()) result.numbers.push_back(f.self_ps);
  result.numbers.push_back(b.cpu.activity().idle_ps());
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_depends_on_the_quantum) {
  const Trail reference = trail("100 us");
  BOOST_TEST(reference.handlers.size() >= 16u);
  for (const char* quantum : {"0 ps", "1 ns", "333 ns", "1 us", "10 ms", "10 s"}) {
    BOOST_TEST_CONTEXT("quantum " << quantum) {
      const Trail other = trail(quantum);
      BOOST_TEST(other.accesses == reference.accesses, boost::test_tools::per_element());
      BOOST_TEST(other.pl_accesses == reference.pl_accesses, boost::test_tools::per_element());
      BOOST_TEST(other.handlers == reference.handlers, boost::test_tools::per_element());
      BOOST_TEST(other.functions == reference.functions, boost::test_tools::per_element());
      BOOST_TEST(other.numbers == reference.numbers, boost::test_tools::per_element());
    }
  }
}

/// The one image comes at 1 us.
struct Camera : ps::TestBench {
  std::uint64_t next_frame_ps(std::uint64_t) override { return 1'000'000; }
  const hal_frame* next_frame(std::uint64_t now_ps) override {
    asked_ps = now_ps;
    return nullptr;
  }
  bool publish(std::uint32_t, const void*, std::size_t, std::uint64_t) override { return true; }
  double option(std::uint32_t, const hal_option_info& info) override { return info.default_value; }
  std::uint64_t asked_ps = 0;
};

// At 400 ns as in work; that at 950 ns ends after the image came.
BOOST_AUTO_TEST_CASE(handlers_run_while_the_program_waits_for_the_camera) {
  InterruptBench b({400'000, 950'000});
  Camera camera;
  b.cpu.connect(camera);
  b.run([] {
    enable();
    hal_frame_next();
    return 0;
  });
  BOOST_TEST(seen == (Times{400'000, 950'000}), boost::test_tools::per_element());
  BOOST_TEST(camera.asked_ps > 1'050'000u);
  BOOST_TEST(b.cpu.interrupts == 2u);
  BOOST_TEST(b.cpu.activity().idle_ps() < 950'000u);
}

// Masked, it waits as the program does, until that lets it come.
BOOST_AUTO_TEST_CASE(a_masked_interrupt_does_not_end_the_wait_for_the_camera) {
  InterruptBench b({400'000});
  Camera camera;
  b.cpu.connect(camera);
  b.run([] {
    hal_interrupt_connect(acknowledge, nullptr);
    hal_frame_next();
    hal_interrupt_enable(true);
    return 0;
  });
  BOOST_TEST(camera.asked_ps == 1'000'000u);
  BOOST_TEST(seen == Times{1'000'000}, boost::test_tools::per_element());
}

namespace {

/// Two contexts of a program: the main one, and one that an interrupt continues.
ucontext_t main_context, other_context;
bool in_other = false;

// As a kernel switches tasks.
void to_other() {
  if (std::exchange(in_other, !in_other)) return;
  swapcontext(&main_context, &other_context);
}

void run_other() {
  hal_write32(device_address, 2);
  hal_work(step, 500);
  hal_write32(device_address, 3);
  swapcontext(&other_context, &main_context);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hook_behind_the_handler_may_continue_another_context) {
  Bench b;
  b.device.written = [&](std::uint32_t value) {
    if (value == 1) b.n_irq = true;
  };
  b.set_n_irq_at(1'000'000, false);
  b.run([] {
    static std::array<char, 256 * 1024> stack;
    in_other = false;
    getcontext(&other_context);
    other_context.uc_stack.ss_sp = stack.data();
    other_context.uc_stack.ss_size = stack.size();
    makecontext(&other_context, &run_other, 0);
    hal_interrupt_connect([](void*) { hal_write32(device_address, 1); }, nullptr);
    hal_after_interrupt(&to_other);
    hal_interrupt_enable(true);
    hal_work(step, 3000);
    hal_write32(device_address, 4);
    return 0;
  });
  std::vector<std::uint32_t> values;
  for (const Device::Access& access : b.device.log) values.push_back(access.value);
  BOOST_TEST(values == (std::vector<std::uint32_t>{1, 2, 3, 4}), boost::test_tools::per_element());
  // Entry of the handler 100 cycles, exit 60; then the other one, whose 500 cycles the main one
  // waits.
  const std::vector<std::uint64_t> times{1'100'000, 1'160'000, 1'660'000, 3'660'000};
  BOOST_TEST(b.device.times() == times, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
