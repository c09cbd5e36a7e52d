// The wires of interrupts: from one to the handler and back, and pulses too short for one.
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <vector>

#include "gic_bench.h"

using namespace bench;
using namespace bench::gic_at_bus;

namespace {

struct SystemBench : GicBench {
  SystemBench() { cpu.n_irq(gic.n_irq); }
};

std::vector<std::uint64_t> served;

}  // namespace

BOOST_AUTO_TEST_SUITE(gic_wire)

BOOST_AUTO_TEST_CASE(from_the_wire_to_the_handler_and_back) {
  SystemBench b;
  served.clear();
  b.device.written = [&](std::uint32_t) { b.irq_f2p = 0; };
  sc_core::sc_spawn([&] {
    sc_core::wait(vp::from_ps(700'000));
    b.irq_f2p = 1;
  });
  b.run([] {
    set_up(61);
    hal_interrupt_connect(
        [](void*) {
          const std::uint32_t id = acknowledge();
          served.push_back(id);
          served.push_back(now_ps());
          hal_write32(device_address, 0);
          end(id);
        },
        nullptr);
    hal_interrupt_enable(true);
    hal_work(step, 1000);
    hal_barrier();
    return 0;
  });
  const std::vector<std::uint64_t> expected{61, 800'000};  // 100 cycles of entry
  BOOST_TEST(served == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.interrupts == 1u);
  BOOST_TEST(b.cpu.end_ps() == 1'180'000u);
}

namespace {

/// IRQ_F2P[0] is high for `ps`; how often that was too short.
std::size_t short_pulses(GicBench& bench, std::uint64_t ps, bool edge, bool enabled = true) {
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  bench.run([&] {
    if (enabled) set_up(61, 0xA0, edge);
    bench.irq_f2p = 1;
    sc_core::wait(sc_core::sc_time::from_value(ps));
    bench.irq_f2p = 0;
    return 0;
  });
  return reports.count("/markervp/rule/INTERRUPT_PULSE");
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_pulse_of_one_clock_is_too_short_for_a_level, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, false) == 1u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_one_clock_is_long_enough_for_an_edge, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, true) == 0u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_4_ns_is_too_short_for_an_edge, GicBench) {
  BOOST_TEST(short_pulses(*this, 4'000, true) == 1u);
}
BOOST_FIXTURE_TEST_CASE(a_level_that_software_can_have_ended_is_silent, GicBench) {
  BOOST_TEST(short_pulses(*this, 100'000, false) == 0u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_an_interrupt_that_is_not_enabled_is_silent, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, false, false) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
