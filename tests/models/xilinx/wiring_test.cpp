// Wires between parts: concat, slice, constant and gates; the stub of an IP; clocks of the fabric.
#include <simulation.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/fabric_clock/fabric_clock.h>
#include <xilinx/register_stub/register_stub.h>
#include <xilinx/wiring/wiring.h>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bus_master.h"
#include "input_error.h"

namespace {

struct Wires : kit::Simulation {
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  vp::Signal<bool> bit{"bit"};
  vp::Signal<std::uint32_t> word{"word", 8};

  void start() { sc_core::sc_start(sc_core::SC_ZERO_TIME); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(wiring)

BOOST_FIXTURE_TEST_CASE(concat_puts_its_first_input_low, Wires) {
  const auto concat = xilinx::make_concat("concat", {8, 1, 3, 1});
  concat->connect(0, word);
  concat->connect(1, bit);
  concat->connect(3, bit);
  start();
  BOOST_TEST(concat->out.width() == 13u);
  word = 0xA5;
  bit = true;
  BOOST_TEST(concat->out.get() == 0x11A5u);
  word = 0;
  BOOST_TEST(concat->out.get() == 0x1100u);
  const xilinx::BitOrigin origin = xilinx::Wiring::origin(concat->out, 12);
  BOOST_TEST(origin.signal == &bit);
  BOOST_TEST(xilinx::Wiring::origin(concat->out, 5).bit == 5u);
  BOOST_TEST(xilinx::Wiring::origin(concat->out, 9).signal == nullptr);  // an open input
  BOOST_TEST(input_error([&] { concat->connect(1, word); }) ==
             "concat: word and bit both drive its input 1");
}

BOOST_FIXTURE_TEST_CASE(slice_and_constant, Wires) {
  const auto slice = xilinx::make_slice("slice", 6, 4);
  slice->connect(0, word);
  const auto constant = xilinx::make_constant("constant", 4, 0x1A);
  start();
  word = 0x5F;
  BOOST_TEST(slice->out.get() == 5u);
  BOOST_TEST(slice->out.width() == 3u);
  BOOST_TEST(xilinx::Wiring::origin(slice->out, 2).bit == 6u);
  BOOST_TEST(constant->out.get() == 0xAu);
  BOOST_TEST(input_error([&] {
               xilinx::make_slice("other", 3, 4);
             }).find("DIN_FROM is the upper one") != std::string::npos);
  BOOST_TEST(input_error([&] {
               xilinx::make_constant("wide", 65, 0);
             }).find("wires of 1 to 64 bits") != std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(gates, Wires) {
  vp::Signal<std::uint32_t> other("other", 8);
  std::vector<std::unique_ptr<xilinx::Wiring>> all_gates;  // the signals do not forget a listener
  for (const auto& [operation, result] : {std::pair<std::string, std::uint64_t>{"and", 0x05},
                                          {"or", 0xAF},
                                          {"xor", 0xAA},
                                          {"not", 0x5A}}) {
    all_gates.push_back(xilinx::make_gates(operation.c_str(), operation, 8));
    const auto& gates = all_gates.back();
    gates->connect(0, word);
    if (operation != "not") gates->connect(1, other);
    word = 0xA5;
    other = 0x0F;
    BOOST_TEST(gates->out.get() == result, operation);
    word = 0;
    other = 0;
  }
  const auto parity = xilinx::make_reduction("parity", "xor", 8);
  const auto all = xilinx::make_reduction("all", "and", 3);
  parity->connect(0, word);
  all->connect(0, word);
  word = 0x07;
  BOOST_TEST(parity->out.get() == 1u);
  BOOST_TEST(all->out.get() == 1u);
  word = 0x03;
  BOOST_TEST(all->out.get() == 0u);
}

BOOST_FIXTURE_TEST_CASE(a_ring_of_wires_is_refused, Wires) {
  const auto inverter = xilinx::make_gates("inverter", "not", 1);
  inverter->connect(0, inverter->out);
  BOOST_TEST(input_error([&] {
               start();
             }).find("inverter: its output leads back to its own input") != std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(an_adapter_follows_and_inverts, Wires) {
  xilinx::WireAdapter<bool> low("low", word), inverted("inverted", bit, true);
  start();
  BOOST_TEST(!low.out.get());
  BOOST_TEST(inverted.out.get());
  word = 0x11;
  bit = true;
  BOOST_TEST(low.out.get());
  BOOST_TEST(!inverted.out.get());
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(register_stub)

BOOST_FIXTURE_TEST_CASE(answers_zero_and_warns_once_an_address, Wires) {
  std::ostringstream log;
  vp::ReportRouter reports;
  reports.redirect(log);
  xilinx::RegisterStub stub("stub", clock, "me:user:own:1.0");
  kit::BusMaster master("master");
  master.socket.bind(stub.add_slave("S_AXI").socket);
  start();
  BOOST_TEST(!stub.used());
  BOOST_TEST(!stub.estimate().known);
  BOOST_TEST(master.read(0x10) == 0u);
  master.write(0x14, 7);
  BOOST_TEST(master.read(0x14) == 0u);
  BOOST_TEST(master.read(0x10) == 0u);
  BOOST_TEST(stub.used());
  BOOST_TEST(stub.reads.get() == 3u);
  BOOST_TEST_REQUIRE(reports.warnings().size() == 2u);
  BOOST_TEST(
      reports.warnings()[0].message ==
      "a read at offset 0x00000010 of S_AXI: me:user:own:1.0 has neither model nor RTL here, "
      "so reads give 0 and writes do nothing");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(fabric_clock)

BOOST_FIXTURE_TEST_CASE(makes_the_frequencies_of_the_wizard, Wires) {
  // 100 MHz / 4 · 37.125 = 928.125 MHz.
  xilinx::FabricClock mmcm("mmcm", clock, 1,
                           {false, "4", "37.125", {{"pixel", "12.500"}, {"fast", "5"}}});
  BOOST_TEST(mmcm.output("pixel")->frequency_hz() == 74'250'000u);
  BOOST_TEST(mmcm.output("fast")->frequency_hz() == 185'625'000u);
  BOOST_TEST(mmcm.output("none") == nullptr);
  clock.set_frequency(104'000'000);
  BOOST_TEST(mmcm.output("pixel")->frequency_hz() == 77'220'000u);
}

BOOST_FIXTURE_TEST_CASE(limits_of_the_speed_grade, Wires) {
  const auto refusal = [&](const xilinx::FabricClockBuild& build, unsigned grade) {
    const std::string name = sc_core::sc_gen_unique_name("mmcm");
    return input_error([&] { xilinx::FabricClock mmcm(name.c_str(), clock, grade, build); });
  };
  BOOST_TEST(refusal({false, "1", "12.000", {{"a", "10"}}}, 1) == "nothing thrown");
  BOOST_TEST(refusal({false, "1", "12.125", {{"a", "10"}}}, 1).find("would run at 1212.500 MHz") !=
             std::string::npos);
  BOOST_TEST(refusal({false, "1", "12.125", {{"a", "10"}}}, 2) == "nothing thrown");
  BOOST_TEST(refusal({false, "1", "5.875", {{"a", "10"}}}, 1).find("from 600 to 1200 MHz") !=
             std::string::npos);
  BOOST_TEST(refusal({true, "1", "12.125", {{"a", "10"}}}, 1).find("a whole number") !=
             std::string::npos);
  BOOST_TEST(refusal({false, "1", "10.000", {{"a", "1.1"}}}, 1).find("in steps of 0.125") !=
             std::string::npos);
  BOOST_TEST(
      refusal({false, "1", "10.000", {{"a", "10"}, {"b", "2.5"}}}, 1).find("b.divide = 2.5") !=
      std::string::npos);
  BOOST_TEST(refusal({false, "11", "64", {{"a", "10"}}}, 1).find("phase detector at 9.091 MHz") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(settings_near_a_wish) {
  const xilinx::ManagerLimits mmcm = xilinx::manager_limits(false, 1);
  const auto exact = xilinx::settings_near(100e6, 74.25e6, mmcm, 3);
  BOOST_TEST_REQUIRE(exact.size() == 3u);
  BOOST_TEST(exact[0].hz == 74.25e6);
  BOOST_TEST(exact[0].vco_hz <= 1200e6);
  for (std::size_t i = 1; i < exact.size(); ++i)
    BOOST_TEST(std::abs(exact[i].hz - 74.25e6) >= std::abs(exact[i - 1].hz - 74.25e6));
  // A PLL has whole numbers alone.
  for (const auto& setting :
       xilinx::settings_near(100e6, 74.25e6, xilinx::manager_limits(true, 1), 5)) {
    BOOST_TEST(setting.multiplier % xilinx::eighths == 0u);
    BOOST_TEST(setting.divider % xilinx::eighths == 0u);
  }
  BOOST_TEST(xilinx::settings_near(5e6, 74.25e6, mmcm, 3).empty());  // the detector is too slow
}

BOOST_AUTO_TEST_SUITE_END()
