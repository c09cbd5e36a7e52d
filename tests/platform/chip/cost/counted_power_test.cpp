// Energy of RTL by the changes of its signals.
#include <chip/cost/zynq_power.h>
#include <chip/system/designs.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>
#include <string>

#include <vp/configuration.h>
#include <vp/ip.h>

#include "simulation.h"

using namespace platform;

namespace {

constexpr std::uint64_t ms = 1'000'000'000;
const auto near = boost::test_tools::tolerance(1e-9);

/// RTL whose signals are counted, here by the test.
struct Counted final : sc_core::sc_module, vp::Ip {
  Counted(sc_core::sc_module_name name, const vp::Clock& clock) : sc_module(name), Ip(&clock) {
    vp::IpEstimate::Foreign foreign;
    foreign.toggles = {1000, [this] { begun = true; }, [this] { return changes; },
                       [this] { return busy_clocks; }};
    set_foreign(foreign);
  }
  vp::IpEstimate own_estimate() const override {
    vp::IpEstimate e;
    e.lut = 2000;
    e.ff = 1000;
    e.dsp = 4;
    e.bram36 = 2;
    return e;
  }
  bool begun = false;
  double changes = 0, busy_clocks = 0;
};

/// What a frame of 1 ms at 100 MHz takes, in which so many of its 1000 bits change in each clock.
facts::PowerReport counted(double bits_a_clock, const std::string& mode = "activity") {
  const kit::Simulation simulation;
  vp::Configuration configuration;
  configuration.set("power.mode", mode);
  const vp::Configuration::Scope scope(configuration);
  Zynq zynq(*builtin_designs().front());
  std::unique_ptr<Counted> rtl;
  {
    const vp::HierarchyScope inside(zynq.pl());
    rtl = std::make_unique<Counted>("cipher", zynq.ps.fclk_clk0.clk);
  }
  ZynqPower power("power", zynq, true);
  constexpr double clocks = 100'000;
  power.frame_begins();
  sc_core::sc_start(vp::from_ps(ms));
  rtl->changes = bits_a_clock * clocks;
  rtl->busy_clocks = std::min(1.0, bits_a_clock / 125) * clocks;
  facts::UnitReport frame;
  frame.end_ps = ms;
  power.frame_ends(frame);
  BOOST_TEST(rtl->begun == (mode == "activity"));
  return power.power_report(ms);
}

double rail_w(const facts::PowerReport& report, const std::string& coefficient) {
  double sum = 0;
  for (const auto& module : report.modules)
    if (module.name == "pl.cipher" && module.source.rfind(coefficient + " ", 0) == 0)
      sum += module.w;
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(counted_power)

BOOST_AUTO_TEST_CASE(of_rtl_alone_each_change_of_a_signal_takes_power) {
  const facts::PowerReport cipher = counted(500), usual = counted(125), idle = counted(0);
  BOOST_TEST(rail_w(usual, "pl.logic_simulated") == 0.072 * 2 * 100 * 1e-3, near);
  BOOST_TEST(rail_w(cipher, "pl.logic_simulated") == 4 * rail_w(usual, "pl.logic_simulated"), near);
  BOOST_TEST(rail_w(idle, "pl.logic_simulated") == 0.0);
  // A multiplier or a memory works in each clock, at most.
  BOOST_TEST(rail_w(usual, "pl.dsp_busy") == 10e-6 * 4 * 100, near);
  BOOST_TEST(rail_w(cipher, "pl.dsp_busy") == rail_w(usual, "pl.dsp_busy"), near);
  BOOST_TEST(rail_w(cipher, "pl.bram") == rail_w(usual, "pl.bram"), near);
  BOOST_TEST(rail_w(idle, "pl.dsp_busy") + rail_w(idle, "pl.bram") == 0.0);
  BOOST_TEST(rail_w(idle, "pl.clock") == rail_w(cipher, "pl.clock"), near);
  BOOST_REQUIRE(cipher.activity.size() == 1u);
  BOOST_TEST(cipher.activity[0].name == "pl.cipher");
  BOOST_TEST(cipher.activity[0].toggle_rate == 0.5, near);
  BOOST_TEST(cipher.activity[0].bits == 1000u);
  BOOST_TEST(idle.activity.at(0).toggle_rate == 0.0);
}

BOOST_AUTO_TEST_CASE(the_vendors_default_asks_for_no_changes) {
  const facts::PowerReport report = counted(500, "vivado-default");
  BOOST_TEST(report.activity.empty());
  BOOST_TEST(rail_w(report, "pl.logic_simulated") == 0.0);
  BOOST_TEST(rail_w(report, "pl.logic") > 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
