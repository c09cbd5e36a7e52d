#include <boost/test/unit_test.hpp>
#include <memory>
#include <sstream>

#include <axi_gpio_registers.h>
#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include "bus_master.h"

using namespace axi_gpio;
using kit::BusMaster;
using xilinx::AxiGpioBuild;
using xilinx::GpioDirection;

namespace {

constexpr std::uint64_t period = 10'000;  // ps: 100 MHz

struct Bench : kit::Simulation {
  explicit Bench(const AxiGpioBuild& build) : gpio("gpio", clock, build) {
    reports.redirect(text);
    master.socket.bind(gpio.s_axi.socket);
    gpio.gpio.io_i(pins);
    gpio.gpio2.io_i(pins2);
    gpio.s_axi_aresetn(aresetn);
  }
  void simulate(std::function<void()> script) {
    master.simulate(std::move(script));
    BOOST_TEST(reports.count(sc_core::SC_WARNING) == expected_warnings);
  }
  /// What software reads at a time.
  std::uint32_t read_at(std::uint64_t ps, std::uint32_t address) {
    BusMaster::wait_until(ps);
    return master.read(address);
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster master{"master"};
  vp::Signal<std::uint32_t> pins{"pins"}, pins2{"pins2"};
  vp::Signal<bool> aresetn{"aresetn", 1, true};
  xilinx::AxiGpio gpio;
  std::ostringstream text;
  vp::ReportRouter reports;
  unsigned expected_warnings = 0;
};

AxiGpioBuild build(GpioDirection direction) {
  AxiGpioBuild b;
  b.gpio.direction = direction;
  return b;
}

AxiGpioBuild dual_with_interrupt() {
  AxiGpioBuild b = build(GpioDirection::mixed);
  b.is_dual = true;
  b.interrupt_present = true;
  b.gpio2.direction = GpioDirection::all_inputs;
  return b;
}

struct Outputs : Bench {
  Outputs() : Bench(build(GpioDirection::all_outputs)) {}
};
struct Inputs : Bench {
  Inputs() : Bench(build(GpioDirection::all_inputs)) {}
};
struct Mixed : Bench {
  Mixed() : Bench(build(GpioDirection::mixed)) {}
};
struct Dual : Bench {
  Dual() : Bench(dual_with_interrupt()) {}
};

}  // namespace

BOOST_AUTO_TEST_SUITE(gpio)

BOOST_FIXTURE_TEST_CASE(all_outputs, Outputs) {
  simulate([&] {
    BOOST_TEST(master.read(GPIO_DATA) == 0u);
    BOOST_TEST(master.read(GPIO_TRI) == 0xFFFFFFFFu, "a constant");
    BOOST_TEST(gpio.gpio.io_t.get() == 0u, "always driven");
    for (unsigned bit = 0; bit < 32; ++bit) {
      master.write(GPIO_DATA, 1u << bit);
      BOOST_TEST(gpio.gpio.io_o.get() == 1u << bit, "at the pins at once");
      BOOST_TEST(master.read(GPIO_DATA) == 1u << bit);
    }
    master.write(GPIO_TRI, 0);
    BOOST_TEST(master.read(GPIO_TRI) == 0xFFFFFFFFu);
    BOOST_TEST(gpio.gpio_tri.value() == 0u, "stored all the same");
    BOOST_TEST(gpio.gpio.io_o.get() == 0x80000000u);
    pins = 0x1234;
    BOOST_TEST(read_at(20 * period, GPIO_DATA) == 0x80000000u, "pins are not read");
  });
}

BOOST_FIXTURE_TEST_CASE(all_inputs, Inputs) {
  simulate([&] {
    BOOST_TEST(master.read(GPIO_TRI) == 0xFFFFFFFFu);
    master.write(GPIO_DATA, 0xA5A5A5A5);
    BOOST_TEST(gpio.gpio_data.value() == 0xA5A5A5A5u, "stored, invisible");
    BOOST_TEST(master.read(GPIO_DATA) == 0u);
    BOOST_TEST(gpio.gpio.io_o.get() == 0u);
    for (unsigned bit = 0; bit < 32; ++bit) {
      pins = 1u << bit;
      BOOST_TEST(read_at((bit + 1) * 10 * period, GPIO_DATA) == 1u << bit);
    }
  });
}

BOOST_FIXTURE_TEST_CASE(inputs_are_seen_five_clocks_later, Inputs) {
  simulate([&] {
    BusMaster::wait_until(10 * period);
    pins = 0x11;  // after edge 10: the first flip-flop takes it on edge 11
    BOOST_TEST(read_at(15 * period - 1, GPIO_DATA) == 0u);
    BOOST_TEST(read_at(15 * period, GPIO_DATA) == 0x11u);
    BusMaster::wait_until(20 * period);
    pins = 0x22;
    BusMaster::wait_until(21 * period);
    pins = 0x33;
    BusMaster::wait_until(22 * period + 1);
    pins = 0x44;  // gone again before edge 23
    BusMaster::wait_until(22 * period + 2);
    pins = 0x55;
    BOOST_TEST(read_at(24 * period, GPIO_DATA) == 0x11u);
    BOOST_TEST(read_at(25 * period, GPIO_DATA) == 0x22u);
    BOOST_TEST(read_at(26 * period, GPIO_DATA) == 0x33u);
    BOOST_TEST(read_at(27 * period, GPIO_DATA) == 0x55u);
    BOOST_TEST(read_at(500 * period, GPIO_DATA) == 0x55u);
  });
}

BOOST_FIXTURE_TEST_CASE(level_before_time_0_is_seen_at_once, Inputs) {
  pins = 0x77;
  simulate([&] { BOOST_TEST(master.read(GPIO_DATA) == 0x77u); });
}

BOOST_FIXTURE_TEST_CASE(many_changes_without_a_read_are_forgotten_in_time, Inputs) {
  simulate([&] {
    for (unsigned i = 1; i <= 200; ++i) {
      BusMaster::wait_until(i * period);
      pins = i;
    }
    BOOST_TEST(read_at(201 * period, GPIO_DATA) == 196u);
  });
}

BOOST_FIXTURE_TEST_CASE(mixed_reads_each_bit_by_its_direction, Mixed) {
  simulate([&] {
    BOOST_TEST(master.read(GPIO_TRI) == 0xFFFFFFFFu, "reset: all inputs");
    BOOST_TEST(gpio.gpio.io_t.get() == 0xFFFFFFFFu);
    pins = 0xFF00FF00;
    master.write(GPIO_DATA, 0x12345678);
    BOOST_TEST(gpio.gpio.io_o.get() == 0x12345678u);
    BOOST_TEST(read_at(10 * period, GPIO_DATA) == 0xFF00FF00u);
    for (unsigned bit = 0; bit < 32; ++bit) {
      master.write(GPIO_TRI, 1u << bit);
      BOOST_TEST(master.read(GPIO_TRI) == 1u << bit);
      BOOST_TEST(gpio.gpio.io_t.get() == 1u << bit);
      const std::uint32_t input = 1u << bit;
      BOOST_TEST(master.read(GPIO_DATA) == ((0x12345678u & ~input) | (0xFF00FF00u & input)));
    }
  });
}

BOOST_AUTO_TEST_CASE(narrow_channel_reads_0_above_its_width) {
  AxiGpioBuild b = build(GpioDirection::mixed);
  b.gpio.width = 5;
  b.gpio.dout_default = 0xFFFFFFF3;
  b.gpio.tri_default = 0xFFFFFF0F;
  Bench bench(b);
  bench.simulate([&] {
    BOOST_TEST(bench.master.read(GPIO_TRI) == 0x0Fu);
    BOOST_TEST(bench.gpio.gpio.io_o.get() == 0x13u);
    bench.master.write(GPIO_TRI, 0);
    BOOST_TEST(bench.master.read(GPIO_DATA) == 0x13u);
    bench.master.write(GPIO_DATA, 0xFFFFFFFF);
    BOOST_TEST(bench.master.read(GPIO_DATA) == 0x1Fu);
    bench.master.write(GPIO_TRI, 0xFFFFFFFF);
    BOOST_TEST(bench.master.read(GPIO_TRI) == 0x1Fu);
    bench.pins = 0xFFFFFFFF;
    BOOST_TEST(bench.read_at(10 * period, GPIO_DATA) == 0x1Fu);
  });
}

BOOST_AUTO_TEST_CASE(narrow_fixed_channel_shows_a_full_width_constant) {
  AxiGpioBuild b = build(GpioDirection::all_outputs);
  b.gpio.width = 4;
  Bench bench(b);
  bench.simulate([&] {
    BOOST_TEST(bench.master.read(GPIO_TRI) == 0xFFFFFFFFu);
    bench.master.write(GPIO_DATA, 0xFF);
    BOOST_TEST(bench.master.read(GPIO_DATA) == 0x0Fu);
  });
}

BOOST_FIXTURE_TEST_CASE(single_channel_has_no_second_one_and_no_interrupt, Outputs) {
  expected_warnings = 9;  // 4 writes, 5 reads: GPIO2_TRI answers
  simulate([&] {
    BOOST_TEST(master.read(GPIO2_DATA) == 0u);
    BOOST_TEST(master.read(GPIO2_TRI) == 0xFFFFFFFFu);
    master.write(GPIO2_DATA, 0xFFFFFFFF);
    BOOST_TEST(master.read(GPIO2_DATA) == 0u);
    BOOST_TEST(gpio.gpio2.io_o.get() == 0u);
    for (const std::uint32_t offset : {GIER, IP_ISR, IP_IER}) {
      master.write(offset, 0xFFFFFFFF);
      BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE);
      BOOST_TEST(master.read(offset) == 0u);
    }
  });
}

BOOST_FIXTURE_TEST_CASE(holes_and_repetition, Outputs) {
  expected_warnings = 8;
  simulate([&] {
    master.write(GPIO_DATA, 0x5A);
    for (const std::uint32_t hole : {0x010u, 0x118u, 0x124u, 0x1FCu}) {
      master.write(hole, 0xFFFFFFFF);
      BOOST_TEST(master.response() == tlm::TLM_OK_RESPONSE);
      BOOST_TEST(master.read(hole) == 0u);
    }
    BOOST_TEST(master.read(0x200) == 0x5Au, "nine address bits are decoded");
    BOOST_TEST(master.read(0xFE00) == 0x5Au);
    master.read(0x2);
    BOOST_TEST(master.response() == tlm::TLM_BURST_ERROR_RESPONSE);
  });
}

BOOST_FIXTURE_TEST_CASE(both_channels, Dual) {
  simulate([&] {
    master.write(GPIO_TRI, 0);
    master.write(GPIO_DATA, 0x0F0F0F0F);
    pins2 = 0xCAFE;
    BOOST_TEST(read_at(10 * period, GPIO2_DATA) == 0xCAFEu);
    BOOST_TEST(master.read(GPIO2_TRI) == 0xFFFFFFFFu);
    BOOST_TEST(master.read(GPIO_DATA) == 0x0F0F0F0Fu);
  });
}

BOOST_FIXTURE_TEST_CASE(interrupt_registers_bit_by_bit, Dual) {
  simulate([&] {
    for (const std::uint32_t offset : {GIER, IP_ISR, IP_IER}) BOOST_TEST(master.read(offset) == 0u);
    master.write(GIER, 0xFFFFFFFF);
    BOOST_TEST(master.read(GIER) == 0x80000000u);
    master.write(IP_IER, 0xFFFFFFFF);
    BOOST_TEST(master.read(IP_IER) == 0x3u);
    master.write(IP_ISR, 0x1);
    BOOST_TEST(master.read(IP_ISR) == 0x1u, "writing 1 to a clear bit sets it");
    BOOST_TEST(gpio.ip2intc_irpt.get());
    master.write(IP_ISR, 0x3);
    BOOST_TEST(master.read(IP_ISR) == 0x2u, "toggles");
    master.write(IP_ISR, 0xFFFFFFFE);
    BOOST_TEST(master.read(IP_ISR) == 0x0u);
    BOOST_TEST(!gpio.ip2intc_irpt.get());
  });
}

BOOST_FIXTURE_TEST_CASE(interrupt_seven_clocks_after_either_edge_of_a_pin, Dual) {
  simulate([&] {
    master.write(GIER, gier::Global_Interrupt_Enable);
    master.write(IP_IER, channel::Channel_1);
    BusMaster::wait_until(10 * period);
    pins = 0x100;
    BusMaster::wait_until(17 * period - 1);
    scheduler.synchronise();
    BOOST_TEST(!gpio.ip2intc_irpt.get());
    BOOST_TEST(master.read(IP_ISR) == 0u);
    BusMaster::wait_until(17 * period);
    BOOST_TEST(master.read(IP_ISR) == channel::Channel_1, "the other channel did not fire");
    BOOST_TEST(gpio.ip2intc_irpt.get());
    master.write(IP_ISR, channel::Channel_1);
    BOOST_TEST(!gpio.ip2intc_irpt.get());
    BusMaster::wait_until(30 * period);
    pins = 0;  // falling
    BOOST_TEST(read_at(37 * period - 1, IP_ISR) == 0u);
    BOOST_TEST(read_at(37 * period, IP_ISR) == channel::Channel_1);
  });
}

BOOST_FIXTURE_TEST_CASE(status_rises_while_disabled_and_enabling_fires, Dual) {
  simulate([&] {
    pins2 = 1;
    BOOST_TEST(read_at(10 * period, IP_ISR) == channel::Channel_2);
    BOOST_TEST(!gpio.ip2intc_irpt.get());
    master.write(IP_IER, channel::Channel_2);
    BOOST_TEST(!gpio.ip2intc_irpt.get(), "globally disabled");
    master.write(GIER, gier::Global_Interrupt_Enable);
    BOOST_TEST(gpio.ip2intc_irpt.get());
    master.write(IP_IER, channel::Channel_1);
    BOOST_TEST(!gpio.ip2intc_irpt.get());
  });
}

BOOST_FIXTURE_TEST_CASE(a_pulse_between_two_edges_is_no_change, Dual) {
  simulate([&] {
    BusMaster::wait_until(10 * period + 1);
    pins = 1;
    BusMaster::wait_until(10 * period + 2);
    pins = 0;
    BOOST_TEST(read_at(40 * period, IP_ISR) == 0u);
  });
}

/// The HDL of v2.0 compares all pins of the channel with what they were: TRI is not in it. (PG144
/// speaks of "inputs" only.) A bit that is driven interrupts if its pin is wired back.
BOOST_FIXTURE_TEST_CASE(a_pin_of_an_output_bit_interrupts_all_the_same, Dual) {
  simulate([&] {
    master.write(GPIO_TRI, 0);
    BusMaster::wait_until(10 * period);
    pins = 0x100;
    BOOST_TEST(read_at(17 * period, IP_ISR) == channel::Channel_1);
    BOOST_TEST(master.read(GPIO_DATA) == 0u, "the output register, not the pin");
    master.write(IP_ISR, channel::Channel_1);
    master.write(GPIO_DATA, 0xFF);
    BOOST_TEST(read_at(60 * period, IP_ISR) == 0u, "the output itself is no pin");
  });
}

BOOST_FIXTURE_TEST_CASE(reset_restores_everything, Dual) {
  expected_warnings = 1;
  simulate([&] {
    master.write(GPIO_TRI, 0);
    master.write(GPIO_DATA, 0xFF);
    master.write(GIER, gier::Global_Interrupt_Enable);
    master.write(IP_IER, 3);
    master.write(IP_ISR, 3);
    BOOST_TEST(gpio.ip2intc_irpt.get());
    aresetn = false;
    BOOST_TEST(!gpio.ip2intc_irpt.get());
    BOOST_TEST(gpio.gpio.io_o.get() == 0u);
    BOOST_TEST(gpio.gpio.io_t.get() == 0xFFFFFFFFu);
    pins = 1;  // while in reset: no interrupt of it
    master.read(GPIO_DATA);
    BOOST_TEST(master.response() == tlm::TLM_GENERIC_ERROR_RESPONSE, "held in reset");
    BusMaster::wait_until(20 * period);
    aresetn = true;
    BOOST_TEST(master.read(GPIO_TRI) == 0xFFFFFFFFu);
    for (const std::uint32_t offset : {GIER, IP_ISR, IP_IER}) BOOST_TEST(master.read(offset) == 0u);
    BOOST_TEST(master.read(GPIO_DATA) == 1u, "the synchroniser has no reset");
  });
}

BOOST_AUTO_TEST_CASE(build_options_are_parameters) {
  kit::Simulation simulation;
  vp::Configuration configuration;
  configuration.set("gpio.gpio_direction=all_inputs");
  configuration.set("gpio.gpio_width=8");
  configuration.set("gpio.input_latency=3 cycles");
  vp::Configuration::Scope scope(configuration);
  vp::ClockScheduler scheduler("scheduler");
  vp::Clock clock("clock", scheduler, 100'000'000);
  xilinx::AxiGpio gpio("gpio", clock);
  configuration.check_unused();
  BOOST_TEST(static_cast<int>(gpio.gpio.direction.get()) ==
             static_cast<int>(GpioDirection::all_inputs));
  BOOST_TEST(gpio.gpio.mask() == 0xFFu);
  configuration.set("gpio2.gpio_width=33");
  BOOST_CHECK_THROW(xilinx::AxiGpio("gpio2", clock), vp::InputError);
}

BOOST_AUTO_TEST_CASE(description_agrees_with_the_full_build) {
  AxiGpioBuild b = dual_with_interrupt();
  b.gpio2.direction = GpioDirection::mixed;
  Bench bench(b);
  bench.simulate([&] {
    for (const vp::RegisterInfo& info : registers) {
      BOOST_TEST_CONTEXT(info.name) {
        BOOST_TEST(bench.master.read(info.offset) == info.reset);
        vp::Register& r = bench.gpio.s_axi[info.offset];
        bench.master.write(info.offset, 0xFFFFFFFF);
        const std::uint32_t expected = (info.reset & ~info.writable) | info.writable;
        BOOST_TEST(r.value() == expected);
      }
    }
  });
}

BOOST_AUTO_TEST_SUITE_END()
