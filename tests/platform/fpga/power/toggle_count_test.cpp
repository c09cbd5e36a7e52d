// Toggles counted in a trace, and what an estimate makes of them.
#include <fpga/power/design_estimate.h>
#include <fpga/power/toggle_count.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <string>

#include "temporary_files.h"

using namespace platform::power;

namespace {

/// Eight clocks of 10 ns. `top.busy.word` changes all of its bits in each, `top.idle.word` never;
/// `top.busy.copy` is another name of its net, `top.busy.wide` changes one bit beyond the 64th.
std::string trace() {
  std::string text =
      "$timescale 1ns $end\n$scope module top $end\n$var wire 1 c clk $end\n"
      "$scope module busy $end\n$var wire 1 c clk $end\n$var wire 4 w word $end\n"
      "$var wire 4 w copy $end\n$var wire 66 z wide $end\n$var real 64 r level $end\n$upscope "
      "$end\n"
      "$scope module idle $end\n$var wire 4 i word $end\n$upscope $end\n$upscope $end\n"
      "$enddefinitions $end\n#0\nbx w\nb0 z\nb101 i\nr0 r\n0c\n";
  for (int clock = 0; clock < 8; ++clock) {
    text += "#" + std::to_string(10 * clock + 5) + "\n1c\n";
    text += clock % 2 == 0 ? "b1010 w\n" : "b101 w\n";
    text += clock == 3 ? "b1" + std::string(65, '0') + " z\n" : "";
    text += "r" + std::to_string(clock) + " r\n#" + std::to_string(10 * clock + 10) + "\n0c\n";
  }
  return text;
}

/// The same as what a simulator counted, with a clock that has two names.
std::string saif(const std::string& change = "", const std::string& to = "") {
  std::string text =
      "(SAIFILE\n(SAIFVERSION \"2.0\") // of 8 clocks\n(DIRECTION \"backward\")\n(DESIGN )\n"
      "(DIVIDER / )\n(TIMESCALE 10 ps)\n(DURATION 8000)\n(INSTANCE top\n(NET\n"
      "(clk (T0 4000) (T1 4000) (TX 0) (TC 16) (IG 0))\n)\n"
      "(INSTANCE \"kind\" busy (PORT\n(c (T0 4000) (T1 4000) (TX 0) (TC 16)))\n(NET\n"
      "(word\\[1\\] (T0 4500) (T1 3500) (TC 7))\n(word\\[0\\] (T0 3500) (T1 4500) (TC 5))))\n"
      "/* nothing\nhappens here */\n(INSTANCE idle (NET (word\\[0\\] (T0 8000) (TC 0))))))\n";
  if (!change.empty()) text.replace(text.find(change), change.size(), to);
  return text;
}

struct Fixture {
  const kit::TemporaryFolder folder;
  Fixture() { kit::write_file(folder / "run.vcd", trace()); }

  ToggleCount count(const std::string& below, const std::string& clock = "top.clk") const {
    return count_toggles({folder / "run.vcd", below, clock, 0});
  }
  std::string problem(const std::string& below, const std::string& clock = "top.clk") const {
    try {
      count(below, clock);
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }
  PowerEstimate estimate(const std::string& more) const {
    kit::write_file(
        folder / "design.yaml",
        "ps: none\nclocks:\n  c: {frequency: 100 MHz, lut: 4000, ff: 8, " + more + "}\n");
    static const PowerTable table =
        PowerTable::load(std::string(MARKERVP_DATA) + "/power/zynq7020.json");
    return estimate_power(read_design_figures(folder / "design.yaml"), table);
  }
  double logic_w(const std::string& scope) const {
    return estimate("trace: {file: run.vcd, below: " + scope + ", clock: top.clk}")
        .ledger.by_group()
        .at("logic and signals")
        .nominal;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(toggle_count, Fixture)

BOOST_AUTO_TEST_CASE(each_change_of_a_bit_counts_and_each_net_once) {
  const ToggleCount busy = count("top.busy");
  BOOST_TEST(busy.clocks == 8u);
  BOOST_TEST(busy.bits == 4u + 66u);         // not the clock, the copy, or the real number
  BOOST_TEST(busy.toggles == 7u * 4u + 1u);  // nothing is known before the first word
  BOOST_TEST(busy.nets.at(0).path == "top.busy.word");
  BOOST_TEST(busy.nets.at(0).toggles == 28u);
  BOOST_TEST(busy.nets.at(1).toggles == 1u);
  BOOST_TEST(busy.rate() == 29.0 / (70 * 8), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(count("top.idle").toggles == 0u);
  BOOST_TEST(count("top").bits == 74u);
}

// The trace lasts 80 ns.
BOOST_AUTO_TEST_CASE(a_trace_without_a_clock_is_counted_by_its_time) {
  const ToggleCount by_time = count_toggles({folder / "run.vcd", "top.busy", "", 50});
  BOOST_TEST(by_time.clocks == 4u);
  BOOST_TEST(by_time.bits == 1u + 4u + 66u);  // no clock is left out
  BOOST_CHECK_THROW(count_toggles({folder / "run.vcd", "top.busy", "", 1}), vp::InputError);
  BOOST_TEST(
      estimate("trace: {file: run.vcd, below: top.idle, clock: 50 MHz}").ledger.total().nominal >
      0);
}

BOOST_AUTO_TEST_CASE(a_simulators_own_count_is_taken_bits_as_vectors_and_without_the_clocks_names) {
  kit::write_file(folder / "run.saif", saif());
  const ToggleCount busy = count_toggles({folder / "run.saif", "top.busy", "top.clk", 0});
  BOOST_TEST(busy.clocks == 8u);
  BOOST_TEST(busy.bits == 2u);
  BOOST_TEST(busy.toggles == 12u);
  BOOST_TEST(busy.nets.size() == 1u);
  BOOST_TEST(busy.nets.at(0).path == "top.busy.word");
  BOOST_TEST(busy.nets.at(0).width == 2u);
  BOOST_TEST(count_toggles({folder / "run.saif", "top.idle", "top.clk", 0}).toggles == 0u);
  const ToggleCount by_time = count_toggles({folder / "run.saif", "top.busy", "", 50});
  BOOST_TEST(by_time.clocks == 4u);  // in 80 ns
  BOOST_TEST(by_time.bits == 3u);
}

BOOST_AUTO_TEST_CASE(a_count_that_is_odd_is_refused_with_its_line) {
  const auto told = [&](const std::string& text, const std::string& part,
                        const std::string& below = "top.busy",
                        const std::string& clock = "top.clk") {
    kit::write_file(folder / "run.saif", text);
    try {
      count_toggles({folder / "run.saif", below, clock, 0});
      BOOST_ERROR("accepted: " << text);
    } catch (const vp::InputError& error) {
      const std::string message = error.what();
      BOOST_TEST(message.find(part) != std::string::npos, message);
    }
  };
  told(saif("(TC 7)", "(TC 7.5)"), "line 15: TC takes a whole number");
  told(saif("(TC 7)", "(TC 99999999999999999999)"), "TC takes a whole number");
  told(saif("(TC 7)"), "line 15: 'word[1]' has no TC");
  told(saif("10 ps", "ten ps"), "'tenps' is no TIMESCALE");
  told(saif("(DURATION 8000)"), "has no DURATION");
  told(saif().substr(0, 300), "it is cut off");
  told(saif() + ")", "closes nothing");
  told(saif("*/"), "a comment does not end");
  told("(NETLIST)", "is no SAIF");
  told("", "is no SAIF");
  told("SAIF", "is no SAIF");
  told(saif("(TC 16)", "(TC 0)"), "never rises");
  told(saif(), "did you mean 'top.busy'", "top.bsy");
  told(saif(), "did you mean 'top.clk'", "top.busy", "top.clck");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_counted_is_refused) {
  BOOST_TEST(problem("top.bsy").find("did you mean 'top.busy'") != std::string::npos);
  BOOST_TEST(problem("top.bus").find("no signal below 'top.bus'") != std::string::npos);
  BOOST_TEST(problem("top.busy", "top.clck").find("did you mean 'top.clk'") != std::string::npos);
  BOOST_TEST(problem("top.busy", "top.busy.word").find("not one bit") != std::string::npos);
  kit::write_file(folder / "run.vcd", "no trace");
  BOOST_TEST(problem("top").find("run.vcd") != std::string::npos);
  kit::write_file(
      folder / "run.vcd",
      "$timescale 1ns $end\n$scope module top $end\n$var wire 1 c clk $end\n"
      "$var wire 1 d data $end\n$upscope $end\n$enddefinitions $end\n#0\n1c\n0d\n#5\n1d\n");
  BOOST_TEST(problem("top").find("never rises") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(busy_logic_takes_more_than_idle_logic_of_the_same_size) {
  BOOST_TEST(logic_w("top.idle") == 0.0);
  // A toggle in eight is the default.
  BOOST_TEST(logic_w("top.busy") == 0.072 * 4 * 100 * 1e-3 * (29.0 / (70 * 8)) / 0.125,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(estimate("dsp: 20, trace: {file: run.vcd, below: top.busy, clock: top.clk}")
                 .ledger.by_group()
                 .at("DSP")
                 .nominal < 20 * 10e-6 * 100);
}

BOOST_AUTO_TEST_CASE(a_description_names_file_scope_and_clock) {
  const auto told = [&](const std::string& more, const std::string& part) {
    try {
      estimate(more);
      BOOST_ERROR("accepted: " << more);
    } catch (const vp::InputError& error) {
      const std::string text = error.what();
      BOOST_TEST(text.find("design.yaml:") != std::string::npos, text);
      BOOST_TEST(text.find(part) != std::string::npos, text);
    }
  };
  // A model's ports say nothing of the logic behind them.
  told(
      "bram36: 0}\n  d: {frequency: 50 MHz, lut: 1, ff: 9, trace: {file: run.vcd, below: top.idle, "
      "clock: top.clk}",
      "shows 4 bits below 'top.idle', too few for 9 flip-flops");
  told("trace: run.vcd", "'trace' is");
  told("trace: {file: run.vcd, below: top}", "'clock' of 'trace' is missing");
  told("trace: {file: none.vcd, below: top, clock: top.clk}", "none.vcd");
  told("trace: {file: run.vcd, below: top, clock: 50}", "has no unit");
  told("trace: {file: run.vcd, below: tp, clock: top.clk}", "did you mean 'top'");
  told("activity: rest, trace: {file: run.vcd, below: top, clock: top.clk}", "remove one");
  told("toggle_rate: 10 %, trace: {file: run.vcd, below: top, clock: top.clk}", "remove one");
}

BOOST_AUTO_TEST_SUITE_END()
