// Loops of the program without a call: noticed by the basic blocks that run.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>

#include "bench.h"

using namespace bench;

namespace {

struct Recorder : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t) override { return nullptr; }
  bool publish(std::uint32_t, const void* data, std::size_t, std::uint64_t) override {
    std::memcpy(&interrupts, data, sizeof interrupts);
    return true;
  }
  double option(std::uint32_t, const hal_option_info&) override { return 0; }
  int interrupts = 0;
};

/// Lets the program wait for interrupts at 1 ms and 3 ms. Returns when each was acknowledged.
std::vector<std::uint64_t> acknowledged(const Settings& settings) {
  const auto program = ps::Program::load(MARKERVP_TEST_PROGRAMS "/spinning.so");
  Bench b(settings);
  Recorder recorder;
  b.cpu.connect(recorder);
  b.device.written = [&](std::uint32_t) { b.n_irq = true; };
  b.set_n_irq_at(1'000'000'000, false);
  b.set_n_irq_at(3'000'000'000, false);
  b.cpu.load(*program, costs());
  sc_core::sc_start();
  b.cpu.check();
  BOOST_TEST(recorder.interrupts == 2);
  return b.device.times();
}

// A handler begins 100 cycles after its interrupt.
const std::vector<std::uint64_t> expected{1'000'100'000, 3'000'100'000};

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_loop)

BOOST_AUTO_TEST_CASE(interrupts_reach_a_loop_that_calls_nobody_at_their_time) {
  BOOST_TEST(acknowledged({}) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(how_soon_it_is_noticed_changes_no_time) {
  BOOST_TEST(acknowledged({"cpu.loop_blocks=1000"}) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(where_blocks_take_time_it_waits_for_64_at_most) {
  constexpr std::uint64_t cycles = 3, at_once_ps = 64 * cycles * 1'000;
  const Settings settings{"cpu.block_cycles=3 cycles"};
  const std::vector<std::uint64_t> times = acknowledged(settings);
  BOOST_TEST_REQUIRE(times.size() == expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    BOOST_TEST(times[i] >= expected[i]);
    BOOST_TEST(times[i] <= expected[i] + at_once_ps + 10'000);  // the handler's own blocks
  }
  BOOST_TEST(acknowledged(settings) == times, boost::test_tools::per_element());
}

/// Between the two accesses of a program that compares bytes, in ps.
std::uint64_t computing_takes(const Settings& settings) {
  const auto program = ps::Program::load(MARKERVP_TEST_PROGRAMS "/computing.so");
  Bench b(settings);
  b.cpu.load(*program, costs());
  sc_core::sc_start();
  b.cpu.check();
  const std::vector<std::uint64_t> times = b.device.times();
  return times.at(1) - times.at(0);
}

BOOST_AUTO_TEST_CASE(blocks_take_time_only_if_they_are_to) {
  BOOST_TEST(computing_takes({}) == 0u);
  const std::uint64_t one = computing_takes({"cpu.block_cycles=1 cycles"});
  BOOST_TEST(one >= 256'000u);  // a block or two a byte
  BOOST_TEST(one <= 1'024'000u);
  BOOST_TEST(computing_takes({"cpu.block_cycles=7 cycles"}) == 7 * one);
  BOOST_TEST(computing_takes({"cpu.block_cycles=7 cycles", "cpu.quantum=0 ps"}) == 7 * one);
  BOOST_TEST(computing_takes({"cpu.block_cycles=7 cycles", "cpu.loop_blocks=1000"}) == 7 * one);
}

BOOST_AUTO_TEST_CASE(without_interrupt_it_ends_at_the_timeout) {
  const auto program = ps::Program::load(MARKERVP_TEST_PROGRAMS "/spinning.so");
  Bench b({"cpu.timeout=5 ms"});
  b.cpu.load(*program, costs());
  sc_core::sc_start();
  BOOST_CHECK_EXCEPTION(b.cpu.check(), vp::ProtocolError, [](const auto& error) {
    const std::string text = error.what();
    return text.find("no end within 5 ms") == 0 &&
           text.find(
               "; it loops without a call of the HAL, as one does that waits for a variable") !=
               std::string::npos &&
           text.find("entry()+") != std::string::npos;
  });
  BOOST_TEST(b.cpu.end_ps() == 5'000'000'000u);
}

/// Code of this test is foreign to the platform: no basic block of it reports.
BOOST_AUTO_TEST_CASE(the_hosts_time_without_simulated_time_ends_it) {
  for (const bool calls : {true, false}) {
    Bench b({"cpu.host_timeout=200 ms"});
    b.run(
        [calls] {
          hal_work(step, 12);
          hal_read32(device_address);
          for (volatile bool go = true; go;) {
            if (calls) hal_option(0);
          }
          return 0;
        },
        false);
    const std::string error = b.failure();
    BOOST_TEST(error.find("the program takes the host's time and lets no simulated time pass, for "
                          "200 ms now (cpu.host_timeout)") == 0u,
               error);
    BOOST_TEST(error.find(", at 12 ns of program 'bench'") != std::string::npos, error);
    BOOST_TEST(b.cpu.end_ps() == 12'000u);
  }
}

/// Uses so much of the host's time.
void burn(std::chrono::milliseconds time) {
  const std::clock_t end =
      std::clock() + static_cast<std::clock_t>(time.count() * CLOCKS_PER_SEC / 1000);
  while (std::clock() < end) continue;
}

BOOST_AUTO_TEST_CASE(simulated_time_images_and_the_simulator_s_own_time_are_no_reason) {
  struct Slow : ps::TestBench {
    const hal_frame* next_frame(std::uint64_t) override {
      burn(std::chrono::milliseconds(frames == 0 ? 500 : 0));
      return frames++ < 6 ? &frame : nullptr;
    }
    bool publish(std::uint32_t, const void*, std::size_t, std::uint64_t) override { return true; }
    double option(std::uint32_t, const hal_option_info&) override { return 0; }
    hal_frame frame{};
    int frames = 0;
  } slow;
  Bench b({"cpu.host_timeout=400 ms"});
  b.cpu.connect(slow);
  b.run([] {
    while (hal_frame_next()) burn(std::chrono::milliseconds(100));
    for (int i = 0; i < 6; ++i) {
      burn(std::chrono::milliseconds(100));
      hal_work(step, 1);
      hal_barrier();
    }
    return 0;
  });
  BOOST_TEST(slow.frames == 7);
  BOOST_TEST((b.cpu.state() == ps::Cpu::State::finished));
}

BOOST_AUTO_TEST_CASE(interrupted_programs_stop_where_they_are) {
  Bench b;
  const auto old = std::signal(SIGUSR1, [](int) { ps::Cpu::interrupt_program(); });
  b.run(
      [] {
        hal_work(step, 12);
        hal_barrier();
        std::raise(SIGUSR1);
        while (true) hal_barrier();
        return 0;
      },
      false);
  std::signal(SIGUSR1, old);
  BOOST_TEST((b.cpu.state() != ps::Cpu::State::finished));
  b.cpu.check();
}

BOOST_AUTO_TEST_SUITE_END()
