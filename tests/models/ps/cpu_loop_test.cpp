// Loops of the program that call nobody: noticed by the basic blocks that run.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <cstring>

#include "bench.h"

using namespace bench;

namespace {

struct Recorder : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t) override { return nullptr; }
  void publish(std::uint32_t, const void* data, std::size_t, std::uint64_t) override {
    std::memcpy(&interrupts, data, sizeof interrupts);
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

BOOST_AUTO_TEST_CASE(without_interrupt_it_ends_at_the_timeout) {
  const auto program = ps::Program::load(MARKERVP_TEST_PROGRAMS "/spinning.so");
  Bench b({"cpu.timeout=5 ms"});
  b.cpu.load(*program, costs());
  sc_core::sc_start();
  BOOST_CHECK_EXCEPTION(b.cpu.check(), vp::ProtocolError, [](const auto& error) {
    const std::string text = error.what();
    return text.find("no end within 5 ms") == 0 && text.find("entry()+") != std::string::npos;
  });
  BOOST_TEST(b.cpu.end_ps() == 5'000'000'000u);
}

BOOST_AUTO_TEST_SUITE_END()
