// The power of a design of which there are only figures.
#include <fpga/power/design_estimate.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "temporary_files.h"

using namespace platform::power;

namespace {

const PowerTable& table() {
  static const PowerTable read =
      PowerTable::load(std::string(MARKERVP_DATA) + "/power/zynq7020.json");
  return read;
}

DesignFigures read(const std::string& text) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "design.yaml", text);
  return read_design_figures(folder / "design.yaml");
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

double watts(const std::string& text) {
  return estimate_power(read(text), table()).ledger.total().nominal;
}

double of_rail(const PowerEstimate& estimate, const std::string& rail) {
  return estimate.ledger.by_rail().at(rail).nominal;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(design_estimate)

// agustinsilva447/QMARL_FPGA @6fbcb507d6 says 1.697 W: 1.529 W of PS, 0.142 W static, 44.6 C.
BOOST_AUTO_TEST_CASE(a_design_of_a_public_report) {
  const DesignFigures design =
      read("clocks:\n  fclk: {frequency: 100 MHz, lut: 1804, ff: 3146, bram36: 2.5, dsp: 2}\n");
  const PowerEstimate estimate = estimate_power(design, table());
  const vp::Band total = estimate.ledger.total();
  BOOST_TEST(total.nominal == 1.697, boost::test_tools::tolerance(0.01));
  BOOST_TEST(total.low < 1.697);
  BOOST_TEST(total.high > 1.697);
  BOOST_TEST(std::abs(estimate.junction_c - 44.6) < 0.5);
  BOOST_TEST(estimate.ledger.by_group().at("PS").nominal == 1.529,
             boost::test_tools::tolerance(0.005));
}

// Of ZedBoard's preset at 16 bit and 525 MHz, 650 MHz: 1.256 W.
BOOST_AUTO_TEST_CASE(the_settings_of_the_ps_count) {
  const PowerEstimate estimate = estimate_power(
      read("ps: {cpu_clock: 650 MHz, ddr: {width: 16, frequency: 525 MHz}}\n"), table());
  BOOST_TEST(estimate.ledger.by_group().at("PS").nominal == 1.256,
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(watts("ps: {load: 0 %}\n") < watts("ps: {load: 100 %}\n") - 0.5);
  BOOST_TEST(watts("ps: none\n") == 0.105, boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_CASE(every_figure_takes_power) {
  const std::string before = "ps: none\nclocks:\n  c: {frequency: 100 MHz, ";
  const double nothing = watts(before + "lut: 0, ff: 0}\n");
  for (const char* more :
       {"lut: 10000, ff: 0}", "lut: 0, ff: 10000}", "lut: 0, ff: 0, bram36: 20}",
        "lut: 0, ff: 0, dsp: 50}", "lut: 0, ff: 0}\nmmcm: 1", "lut: 0, ff: 0}\npll: 1",
        "lut: 0, ff: 0}\nio: {pins: 36, frequency: 25 MHz}"})
    BOOST_TEST(watts(before + more + "\n") > nothing + 0.01, more);
  BOOST_TEST(watts(before + "lut: 9000, ff: 9000, toggle_rate: 25 %}\n") >
             watts(before + "lut: 9000, ff: 9000}\n") + 0.05);
}

BOOST_AUTO_TEST_CASE(logic_between_few_registers_takes_more) {
  const auto logic = [](double lut, double ff) { return logic_energy(table(), lut, ff).nominal; };
  BOOST_TEST(
      logic(2000, 1000) / logic(2000, 2000) == std::pow(2, table().value("pl.logic_depth").nominal),
      boost::test_tools::tolerance(1e-9));
  // Beyond what the reports have it rests.
  BOOST_TEST(logic(2000, 10) == logic(2000, 1));
  BOOST_TEST(logic(2000, 0) == logic(2000, 1));
  BOOST_TEST(logic(100, 1000) == logic(100, 2000));
}

BOOST_AUTO_TEST_CASE(what_is_declared_takes_its_coefficient_and_has_a_narrower_band) {
  const auto estimate = [](const std::string& said) {
    return estimate_power(read("ps: none\nclocks:\n  c: {frequency: 100 MHz, lut: 8000, ff: 8000, "
                               "bram36: 20, dsp: 50" +
                               said + "}\n"),
                          table());
  };
  const auto width = [](const vp::Band& band) { return band.high - band.low; };
  const vp::Band undeclared = estimate("").ledger.total();
  double before = 0;
  for (const char* activity : {"rest", "control", "arithmetic", "cipher"}) {
    const auto groups = estimate(std::string(", activity: ") + activity).ledger.by_group();
    const double rate = table().value(std::string("pl.logic_") + activity).nominal;
    BOOST_TEST(groups.at("logic and signals").nominal == rate * 8 * 100 * 1e-3,
               boost::test_tools::tolerance(1e-9));
    BOOST_TEST(rate > before);
    before = rate;
  }
  const auto all = estimate(", activity: control, bram_activity: buffer, dsp_activity: rest");
  BOOST_TEST(width(all.ledger.total()) < width(undeclared) / 2);
  BOOST_TEST(all.ledger.by_group().at("block RAM").nominal == 4e-6 * 20 * 100,
             boost::test_tools::tolerance(1e-9));
  // Multipliers do what the logic around them does.
  BOOST_TEST(
      estimate(", activity: arithmetic").ledger.by_group().at("DSP").nominal == 10e-6 * 50 * 100,
      boost::test_tools::tolerance(1e-9));
  BOOST_TEST(estimate(", activity: rest").ledger.by_group().at("DSP").nominal < 2e-3);
}

BOOST_AUTO_TEST_CASE(an_oscillator_takes_power_by_its_frequency) {
  const auto managers = [](const std::string& text) {
    return estimate_power(read("ps: none\n" + text), table()).ledger.by_group();
  };
  const auto mmcm = [&](const std::string& list) {
    return managers("mmcm: [" + list + "]\n").at("MMCM");
  };
  const vp::Band unknown = managers("mmcm: 1\n").at("MMCM");
  BOOST_TEST(unknown.nominal == mmcm("1000 MHz").nominal);
  BOOST_TEST(unknown.low == mmcm("600 MHz").low);
  BOOST_TEST(unknown.high == mmcm("{oscillator: 1200 MHz, fractional: yes}").high);
  const auto tolerance = boost::test_tools::tolerance(1e-9);
  const double base = table().value("pl.mmcm").nominal,
               ghz = table().value("pl.mmcm_oscillator").nominal,
               fractional = table().value("pl.mmcm_fractional").nominal;
  BOOST_TEST(mmcm("1000 MHz, 800 MHz").nominal == 2 * base + 1.8 * ghz, tolerance);
  BOOST_TEST(
      mmcm("{oscillator: 800 MHz, fractional: yes}").nominal == base + 0.8 * (ghz + fractional),
      tolerance);
  BOOST_TEST(mmcm("{oscillator: 800 MHz, fractional: no}").nominal == mmcm("800 MHz").nominal);
  BOOST_TEST(managers("pll: [1000 MHz]\n").at("PLL").nominal ==
             managers("pll: 1\n").at("PLL").nominal);
}

BOOST_AUTO_TEST_CASE(known_watts_take_the_place_of_an_estimate) {
  const PowerEstimate estimate =
      estimate_power(read("ps: {power: 1.256 W}\nio: {power: 40 mW}\n"), table());
  BOOST_TEST(estimate.ledger.by_group().at("PS").nominal == 1.256);
  BOOST_TEST(estimate.ledger.by_group().at("PS").high == 1.256);
  BOOST_TEST(estimate.ledger.by_group().at("I/O").nominal == 0.04);
  BOOST_TEST(
      estimate_power(read("io: {tmds_pairs: 4}\n"), table()).ledger.by_group().at("I/O").nominal ==
          0.136,
      boost::test_tools::tolerance(1e-9));
}

// Reports of two such designs say numA9Cores={2}, and 1.253 W of PS.
BOOST_AUTO_TEST_CASE(a_device_with_one_core_is_billed_as_the_vendor_does) {
  const auto ps_w = [](const std::string& settings) {
    return estimate_power(read("device: xc7z007s\nps: {cpu_clock: 650 MHz" + settings +
                               ", ddr: {width: 16, frequency: 525 MHz}}\n"),
                          table())
        .ledger.by_group()
        .at("PS")
        .nominal;
  };
  BOOST_TEST(ps_w("") == 1.253, boost::test_tools::tolerance(0.01));
  BOOST_TEST(ps_w(", cores: 1") < ps_w("") - 0.1);
}

BOOST_AUTO_TEST_CASE(memories_leak_and_so_do_older_tools) {
  const auto static_w = [](const std::string& text) {
    return estimate_power(read(text), table()).ledger.by_group().at("static").nominal;
  };
  const double bare = static_w("ps: {power: 1.6 W}\n");
  const double with =
      static_w("ps: {power: 1.6 W}\nclocks:\n  c: {frequency: 0 MHz, lut: 0, ff: 0, bram36: 80}\n");
  BOOST_TEST(with - bare > 0.006);
  BOOST_TEST(with - bare < 0.012);
  for (const char* newer :
       {"tool: 2017.3\n", "tool: 2025.1\n", "tool: 2018\n", "tool: v2019.1.1\n"})
    BOOST_TEST(static_w(std::string("ps: none\n") + newer) == static_w("ps: none\n"), newer);
  for (const char* older : {"tool: 2017.2\n", "tool: 2014\n"}) {
    BOOST_TEST(static_w(std::string("ps: none\n") + older) > static_w("ps: none\n") + 0.015, older);
    BOOST_TEST(static_w(std::string("device: xc7z010\nps: none\n") + older) <
               static_w("device: xc7z010\nps: none\n") + 0.01);
  }
}

BOOST_AUTO_TEST_CASE(a_smaller_device_leaks_less_and_a_hot_one_more) {
  BOOST_TEST(watts("device: xc7z010-1\nps: none\n") < watts("device: xc7z020-1\nps: none\n"));
  BOOST_TEST(watts("ambient: 60 C\n") > watts("ambient: 25 C\n") + 0.02);
  const PowerEstimate estimate = estimate_power(read("device: xc7z020\n"), table());
  double sum = 0;
  for (const auto& [rail, band] : estimate.ledger.by_rail()) sum += of_rail(estimate, rail);
  BOOST_TEST(sum == estimate.ledger.total().nominal, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_told_with_the_nearest_that_can) {
  const auto told = [](const std::string& text, const std::string& part) {
    const std::string problem = complaint(text);
    BOOST_TEST(problem.find(part) != std::string::npos, "'" << part << "' is not in: " << problem);
    BOOST_TEST(problem.find("design.yaml") != std::string::npos, problem);
  };
  const std::string clock = "clocks:\n  c: ";
  told(clock + "{frequency: 100 MHz, ff: 0}\n", "'lut' is missing");
  told(clock + "{lut: 1, ff: 0}\n", "'frequency' is missing");
  told(clock + "{frequency: 100 MHz, lut: -5, ff: 0}\n", "the nearest that is, is 0");
  told(clock + "{frequency: 100 MHz, lut: 60000, ff: 0}\n", "the nearest that is, is 53200");
  told(clock + "{frequency: 100, lut: 1, ff: 0}\n", "has no unit");
  told(clock + "{frequency: 100 MHz, lut: 1, ff: 0, brams: 2}\n", "did you mean 'bram36'");
  told(
      clock + "{frequency: 1 MHz, lut: 30000, ff: 0}\n  d: {frequency: 1 MHz, lut: 30000, ff: 0}\n",
      "60000 lut together, xc7z020-1 has 53200");
  told(clock + "{frequency: 1 MHz, lut: 1, ff: 1, activity: busy}\n", "rest, control, arithmetic");
  told(clock + "{frequency: 1 MHz, lut: 1, ff: 1, bram_activity: [a]}\n", "not one value");
  told(clock + "{frequency: 1 MHz, lut: 1, ff: 1, dsp_activity: cipher}\n", "busy, shared");
  told("mmcm: 1.5\n", "whole number");
  told("mmcm: 9\n", "is 8");
  told("mmcm: [2 GHz]\n", "is 1.6 GHz");
  told("pll: [100 MHz]\n", "is 600 MHz");
  told("pll: [{oscillator: 1 GHz, fractional: yes}]\n", "has no 'fractional'");
  told("mmcm: [{fractional: yes}]\n", "'oscillator' of one of 'mmcm' is missing");
  told("mmcm: [{oscillator: 1 GHz, fractional: maybe}]\n", "neither yes nor no");
  told("pll: {a: 1}\n", "not one value");
  told("tool: old\n", "no version of Vivado");
  told("ps: {power: 1 W, load: 50 %}\n", "'power' takes the place of 'load'");
  told("ps: {power: -1 W}\n", "the nearest that is, is 0");
  told("ps: {cores: 3}\n", "is 2");
  told("ps: {cores: 1.5}\n", "whole number");
  told("tool: 2018.3333333333333\n", "no version of Vivado");
  told("io: {power: 1 mW, pins: 3}\n", "remove one");
  told("device: xc7z030-1\n", "xc7z020-1");
  told("ps: {cpu_clock: 1 GHz}\n", "is 667 MHz");
  told("ps: {ddr: {width: 24}}\n", "16 or 32");
  told("clocks: 5\n", "'clocks' is");
  told("clock: 5\n", "did you mean 'clocks'");
  told("device: xc7z020\ndevice: xc7z010\n", "twice");
  told("7\n", "expected 'key: value' lines");
  BOOST_CHECK_THROW(read_design_figures("none.yaml"), vp::InputError);
  BOOST_CHECK_THROW(estimate_power(read("theta_ja: 100\nambient: 125 C\n"), table()),
                    vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
