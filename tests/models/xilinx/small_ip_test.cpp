#include <boost/test/unit_test.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/bram/bram.h>
#include <xilinx/concat/concat.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>
#include "memory_target.h"

namespace {

constexpr std::uint64_t period = 10'000;

struct Bench : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  /// Runs until just after edge `cycle`.
  void run_to_edge(std::uint64_t cycle) {
    sc_core::sc_start(sc_core::sc_time::from_value(cycle * period) - sc_core::sc_time_stamp());
    scheduler.synchronise();
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(bram)

BOOST_FIXTURE_TEST_CASE(leftmost_pixel_is_in_the_low_byte, Bench) {
  xilinx::Bram bram("bram");
  BOOST_TEST(bram.size_b() == 640u * 480u);
  bram.write_a(0, 0x44332211);
  bram.write_a(76'799, 0xDDCCBBAA);
  BOOST_TEST(bram.read_b(0) == 0x11);
  BOOST_TEST(bram.read_b(1) == 0x22);
  BOOST_TEST(bram.read_b(2) == 0x33);
  BOOST_TEST(bram.read_b(3) == 0x44);
  BOOST_TEST(bram.read_b(4) == 0);
  BOOST_TEST(bram.read_b(307'196) == 0xAA);
  BOOST_TEST(bram.read_b(307'199) == 0xDD);
  BOOST_TEST(bram.writes_a == 2u);
  BOOST_TEST(bram.reads_b == 7u);
}

BOOST_FIXTURE_TEST_CASE(out_of_range_is_warned_of_and_survived, Bench) {
  vp::ReportRouter reports;
  std::ostringstream text;
  reports.redirect(text);
  xilinx::Bram bram("bram", 16);
  bram.write_a(16, 1);
  BOOST_TEST(bram.read_b(64) == 0);
  BOOST_TEST(bram.read_b(0xFFFFFFFF) == 0);
  BOOST_TEST(bram.out_of_range == 3u);
  BOOST_TEST(bram.writes_a == 0u);
  BOOST_TEST(reports.count("/markervp/rule/BRAM_ADDRESS") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(concat)

BOOST_FIXTURE_TEST_CASE(each_input_is_its_bit, Bench) {
  vp::Signal<bool> a("a"), c("c", 1, true);
  xilinx::Concat concat("concat", 3);
  concat.in(0)(a);
  concat.in(2)(c);
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
  BOOST_TEST(concat.dout.get() == 0x4u);
  a = true;
  BOOST_TEST(concat.dout.get() == 0x5u);
  c = false;
  BOOST_TEST(concat.dout.get() == 0x1u);
  BOOST_TEST(concat.dout.width() == 3u);
  BOOST_CHECK_THROW(concat.in(3), std::out_of_range);
}

BOOST_FIXTURE_TEST_CASE(an_input_is_connected_once, Bench) {
  vp::Signal<bool> a("a"), b("b");
  xilinx::Concat concat("concat", 2);
  concat.connect(1, a);
  BOOST_CHECK_NO_THROW(concat.connect(1, a));
  const auto refuses = [&](unsigned i, const char* words) {
    BOOST_CHECK_EXCEPTION(concat.connect(i, b), vp::InputError, [&](const auto& error) {
      return std::string(error.what()).find(words) != std::string::npos;
    });
  };
  refuses(1, "b and a are both connected to concat.in1");
  refuses(2, "b cannot be connected to concat.in2: there are inputs 0 to 1");
}

/// A part with an interrupt.
struct Part : sc_core::sc_module {
  explicit Part(sc_core::sc_module_name name) : sc_module(name) {}
  vp::Signal<bool> irq{"irq"};
};

BOOST_FIXTURE_TEST_CASE(an_interrupt_is_a_property_of_its_part, Bench) {
  vp::Configuration configuration;
  configuration.set("b.irq_id", "84");
  const vp::Configuration::Scope scope(configuration);
  Part a("a"), b("b"), c("c");
  xilinx::Concat concat("concat", 2);
  concat.connect_interrupt(a.irq, 61);
  BOOST_TEST(concat.dout.width() == 2u);
  concat.connect_interrupt(b.irq, 62);
  BOOST_TEST(concat.dout.width() == 9u);
  BOOST_TEST(concat.in(8).signal() == &b.irq);
  const auto refuses = [&](Part& part, std::uint32_t id, const char* words) {
    BOOST_CHECK_EXCEPTION(concat.connect_interrupt(part.irq, id), vp::InputError,
                          [&](const auto& error) {
                            return std::string(error.what()).find(words) != std::string::npos;
                          });
  };
  Part d("d");
  refuses(c, 69, "c.irq_id is 69: interrupts of the PL are 61 to 68 or 84 to 91");
  refuses(d, 84, "d.irq_id is 84, which is the interrupt of b.irq: give one of them another");
}

BOOST_FIXTURE_TEST_CASE(too_many_inputs, Bench) {
  BOOST_CHECK_THROW(xilinx::Concat("none", 0), std::logic_error);
  BOOST_CHECK_THROW(xilinx::Concat("many", 33), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(proc_sys_reset)

BOOST_FIXTURE_TEST_CASE(released_at_start_and_asleep, Bench) {
  xilinx::ProcSysReset reset("reset", clock);
  run_to_edge(200);
  BOOST_TEST(reset.peripheral_aresetn.get());
  BOOST_TEST(reset.interconnect_aresetn.get());
  BOOST_TEST(!reset.peripheral_reset.get());
  BOOST_TEST(!reset.bus_struct_reset.get());
  BOOST_TEST(!reset.mb_reset.get());
  BOOST_TEST(clock.edges_run() == 1u);
}

BOOST_FIXTURE_TEST_CASE(a_long_enough_reset_goes_through_its_sequence, Bench) {
  vp::Signal<bool> ext("ext", 1, true);
  xilinx::ProcSysReset reset("reset", clock);
  reset.ext_reset_in(ext);
  run_to_edge(10);
  ext = false;
  run_to_edge(17);
  BOOST_TEST(!reset.peripheral_reset.get());
  run_to_edge(18);  // 4 stages and 4 clocks
  BOOST_TEST(reset.peripheral_reset.get());
  BOOST_TEST(!reset.peripheral_aresetn.get());
  BOOST_TEST(!reset.interconnect_aresetn.get());
  BOOST_TEST(reset.bus_struct_reset.get());
  BOOST_TEST(reset.mb_reset.get());
  run_to_edge(50);
  ext = true;
  const std::uint64_t filtered = 58;
  run_to_edge(filtered + 15);
  BOOST_TEST(reset.bus_struct_reset.get());
  run_to_edge(filtered + 16);
  BOOST_TEST(!reset.bus_struct_reset.get());
  BOOST_TEST(reset.interconnect_aresetn.get());
  BOOST_TEST(reset.peripheral_reset.get());
  run_to_edge(filtered + 31);
  BOOST_TEST(!reset.peripheral_aresetn.get());
  run_to_edge(filtered + 32);
  BOOST_TEST(!reset.peripheral_reset.get());
  BOOST_TEST(reset.peripheral_aresetn.get());
  run_to_edge(filtered + 47);
  BOOST_TEST(reset.mb_reset.get());
  run_to_edge(filtered + 48);
  BOOST_TEST(!reset.mb_reset.get());
}

BOOST_FIXTURE_TEST_CASE(a_glitch_is_filtered, Bench) {
  vp::Signal<bool> aux("aux");
  xilinx::ProcSysReset reset("reset", clock);
  reset.aux_reset_in(aux);
  run_to_edge(10);
  aux = true;
  run_to_edge(17);
  aux = false;
  run_to_edge(200);
  BOOST_TEST(reset.peripheral_aresetn.get());
}

BOOST_FIXTURE_TEST_CASE(power_on_sequence_on_request, Bench) {
  vp::Configuration configuration;
  configuration.set("reset.released_at_start=false");
  vp::Configuration::Scope scope(configuration);
  xilinx::ProcSysReset reset("reset", clock);
  run_to_edge(8 + 31);
  BOOST_TEST(reset.peripheral_reset.get());
  run_to_edge(8 + 32);
  BOOST_TEST(!reset.peripheral_reset.get());
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(axi_interconnect)

BOOST_FIXTURE_TEST_CASE(segments_follow_the_crossbar_s_rules, Bench) {
  xilinx::AxiInterconnect interconnect("interconnect", clock);
  interconnect.map("axi_gpio_0", 0x41200000, 0x10000);
  interconnect.map("axi_gpio_1", 0x41210000, 0x10000);
  BOOST_CHECK_THROW(interconnect.map("odd", 0x41300000, 0x3000), vp::InputError);
  BOOST_CHECK_THROW(interconnect.map("small", 0x41300000, 0x40), vp::InputError);
  BOOST_CHECK_THROW(interconnect.map("misplaced", 0x41308000, 0x10000), vp::InputError);
  BOOST_CHECK_THROW(interconnect.map("overlapping", 0x41200000, 0x20000), vp::InputError);
  BOOST_TEST(interconnect.find(0x4121FFFC)->name == "axi_gpio_1");
  BOOST_TEST(interconnect.find(0x41220000) == nullptr);
}

BOOST_FIXTURE_TEST_CASE(an_address_is_a_property_of_its_part, Bench) {
  vp::Configuration configuration;
  configuration.set("b.base_address", "0x60000000");
  configuration.set("c.base_address", "0x60008000");
  configuration.set("d.base_address", "0x4120F000");
  const vp::Configuration::Scope scope(configuration);
  xilinx::AxiInterconnect interconnect("interconnect", clock);
  xilinx::AxiGpio a("a", clock), b("b", clock), c("c", clock), d("d", clock);
  interconnect.connect(a.s_axi, 0x4120'0000);
  interconnect.connect(b.s_axi, 0x4121'0000);
  BOOST_TEST(interconnect.find(0x4120'0000)->name == "a");
  BOOST_TEST(interconnect.find(0x6000'FFFF)->name == "b");
  BOOST_TEST(interconnect.find(0x4121'0000) == nullptr);
  const auto refuses = [&](xilinx::AxiGpio& part, std::uint64_t size, const char* words) {
    BOOST_CHECK_EXCEPTION(interconnect.connect(part.s_axi, 0x4122'0000, size), vp::InputError,
                          [&](const auto& error) {
                            return std::string(error.what()).find(words) != std::string::npos;
                          });
  };
  refuses(c, 0x1'0000, "the base a multiple of it (c.base_address says where it is)");
  refuses(d, 0x1000, "overlaps a (0x41200000 to 0x4120FFFF)");
}

BOOST_AUTO_TEST_SUITE_END()
