#include <cli/options.h>
#include <vp/error.h>
#include <vp/text.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli_kit.h"

using namespace cli_test;

BOOST_FIXTURE_TEST_SUITE(commands, Terminal)

BOOST_AUTO_TEST_CASE(help_has_examples_and_exit_codes) {
  BOOST_TEST(run({"--help"}) == 0);
  BOOST_TEST(contains(out, "markervp run z1.0"));
  BOOST_TEST(contains(out, "Exit codes"));
  BOOST_TEST(run({"run", "--help"}) == 0);
  BOOST_TEST(contains(out, "--trace-window"));
  BOOST_TEST(contains(out, "--fit crop|scale"), out);
  BOOST_TEST(run({"scenes", "--help"}) == 0);
  BOOST_TEST(!contains(out, "markervp run"), "the help of a command is about that command");
  BOOST_TEST(err == "");
}

BOOST_AUTO_TEST_CASE(version) {
  BOOST_TEST(run({"--version"}) == 0);
  BOOST_TEST(out.rfind("markervp 0.", 0) == 0u, out);
}

BOOST_AUTO_TEST_CASE(wrong_usage_is_one_line_with_the_nearest_match) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{},
       "a command is missing: run, history, debug, faults, designs, config, map, import, report, "
       "devices, clocks, power, rtl, trace, sweep, explore, metrics, pareto, sensitivity, compare, "
       "scenes, poses, validate, compare-detectors or completion"},
      {{"rnu"}, "did you mean 'run'?"},
      {{"z1.0"}, "did you mean 'markervp run z1.0'?"},
      {{"--verison"}, "did you mean '--version'?"},
      {{"run", "--repaet=3"},
       "unknown option '--repaet': did you mean '--repeat'? 'markervp run --help'"},
      {{"config", "pl", "extra"}, "unexpected argument 'extra'"},
      {{"config", "pll"}, "no parameter or group 'pll': did you mean 'pl'?"},
      {{"config", "zzz"}, "no parameter or group 'zzz': 'markervp config' prints all"},
      {{"scenes", "rol"}, "did you mean 'roll'?"},
      {{"completion", "tcsh"}, "tcsh"},
      {{"completion"}, "SHELL"},
      {{"run", "--output"}, "--output"},
  };
  for (const auto& [arguments, problem] : cases) {
    BOOST_TEST(run(arguments) == 2);
    BOOST_TEST(is_one_line_with(err, problem), err << " lacks " << problem);
    BOOST_TEST(out == "");
  }
}

BOOST_AUTO_TEST_CASE(devices_are_listed_and_shown_with_their_sources) {
  BOOST_TEST(run({"devices"}) == 0);
  BOOST_TEST(contains(out, "xc7z020-1    53200  106400     140  220"), out);
  BOOST_TEST(contains(out, "xc7z007s-2"));
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 100u, line);

  BOOST_TEST(run({"devices", "XC7Z020-2"}) == 0);
  BOOST_TEST(contains(out, "cpu_621_mhz"), out);
  BOOST_TEST(contains(out, "766.667 MHz"), out);
  BOOST_TEST(contains(out, "DS190"), out);
  BOOST_TEST(contains(out, "assumed"), out);

  BOOST_TEST(run({"devices", "xc7z021-1"}) == 2);
  BOOST_TEST(is_one_line_with(err, "did you mean 'xc7z020-1'?"), err);
}

BOOST_AUTO_TEST_CASE(devices_as_json_have_value_confidence_and_source) {
  BOOST_TEST(run({"devices", "--json"}) == 0);
  const auto all = nlohmann::json::parse(out);
  BOOST_TEST(all.size() == 8u);
  for (const auto& device : all) {
    BOOST_TEST(device["lut"]["value"].get<double>() > 10'000, device["name"]);
    BOOST_TEST(device["fclk_mhz"]["confidence"] == "assumed", device["name"]);
    BOOST_TEST(device["fmax_factor"]["source"].get<std::string>() != "", device["name"]);
  }
  BOOST_TEST(run({"devices", "xc7z010", "--json"}) == 0);
  const auto one = nlohmann::json::parse(out);
  BOOST_TEST(one.size() == 1u);
  BOOST_TEST(one[0]["name"] == "xc7z010-1");
  BOOST_TEST(one[0]["dsp"]["value"] == 80);
}

BOOST_AUTO_TEST_CASE(clocks_near_a_wish_are_listed) {
  BOOST_TEST(run({"clocks", "55MHz"}) == 0);
  BOOST_TEST(contains(out, "Ethernet: I/O PLL 1000.000000 MHz (x30)"), out);
  BOOST_TEST(contains(out, "the vendor's tool makes 55.555556 MHz (+1.010 %)"), out);
  BOOST_TEST(contains(out, "below 52.631579 MHz (-4.306 %), above 55.555556 MHz (+1.010 %)"));
  BOOST_TEST(contains(out, "I/O PLL 1100.000 MHz x33"), "the best over all plans");
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 110u, line);

  BOOST_TEST(run({"clocks", "55 MHz", "--no-ethernet"}) == 0);
  BOOST_TEST(contains(out, "the vendor's tool makes 55.172414 MHz"), out);
  BOOST_TEST(run({"clocks", "1 GHz", "--for", "cpu"}) == 0);
  BOOST_TEST(contains(out, "makes 800.000000 MHz (-20.000 %)"), out);
  BOOST_TEST(contains(out, "ABOVE the 667 MHz of the speed grade (published)"), out);
  BOOST_TEST(run({"clocks", "666.666 MHz", "--for", "cpu", "--device", "xc7z020-2", "--crystal",
                  "50MHz"}) == 0);
  BOOST_TEST(contains(out, "makes 675.000000 MHz"), out);
}

BOOST_AUTO_TEST_CASE(clocks_of_one_chip_share_the_pll) {
  BOOST_TEST(run({"clocks", "160 MHz", "100 MHz", "--json", "--count", "3"}) == 0);
  const auto json = nlohmann::json::parse(out);
  BOOST_TEST(json["io_feedback"] == 30);
  BOOST_TEST(json["clocks"].size() == 2u);
  const auto& first = json["clocks"][0];
  BOOST_TEST(std::abs(first["made"]["mhz"].get<double>() - 166.666667) < 1e-6);
  BOOST_TEST(first["made"]["divisors"] == nlohmann::json({6, 1}));
  BOOST_TEST(first["near"].size() == 3u);
  BOOST_TEST(first["below"]["mhz"].get<double>() < 160);
  BOOST_TEST(json["clocks"][1]["made"]["offset_percent"] == 0);
  BOOST_TEST(json["clocks"][1]["above"]["mhz"].get<double>() > 100);
}

BOOST_AUTO_TEST_CASE(clocks_that_nobody_can_ask_for_are_refused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"clocks"}, "WISH"},
      {{"clocks", "55"}, "the wish '55' has no unit: write it in Hz, kHz, MHz or GHz"},
      {{"clocks", "0 MHz"}, "give at least 1 Hz"},
      {{"clocks", "fast"}, "'fast'"},
      {{"clocks", "1MHz", "2MHz", "3MHz", "4MHz", "5MHz"}, "a chip has 4 clocks to the PL"},
      {{"clocks", "55MHz", "--device", "xc7z02-1"}, "did you mean 'xc7z020-1'?"},
      {{"clocks", "55MHz", "--crystal", "5 MHz"}, "xc7z020-1 takes 30 to 60 MHz"},
      {{"clocks", "55MHz", "--crystal", "5 px"}, "the crystal '5 px'"},
      {{"clocks", "55MHz", "--for", "gpu"}, "gpu"},
      {{"clocks", "55MHz", "--count", "0"}, "--count"},
  };
  for (const auto& [arguments, problem] : cases) {
    BOOST_TEST(run(arguments) == 2);
    BOOST_TEST(is_one_line_with(err, problem), err << " lacks " << problem);
    BOOST_TEST(out == "");
  }
}

BOOST_AUTO_TEST_CASE(scenes_are_listed_by_group) {
  BOOST_TEST(run({"scenes"}) == 0);
  BOOST_TEST(contains(out, "5.2.2.1"), out);
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 100u, line);
  BOOST_TEST(run({"scenes", "yaw"}) == 0);
  BOOST_TEST(contains(out, "yaw45"));
  BOOST_TEST(contains(out, "pitch 0.0 yaw 45.0 roll 0.0 deg"));
  BOOST_TEST(run({"scenes", "--names"}) == 0);
  BOOST_TEST(contains(out, "\nroll330\n"));
  BOOST_TEST(contains(out, "\ndemo\n"));
}

BOOST_AUTO_TEST_CASE(designs_are_listed) {
  BOOST_TEST(run({"designs"}) == 0);
  BOOST_TEST(contains(out, "thesis       hybrid"), out);
  BOOST_TEST(contains(out, "ps-only      ps-only"), out);
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 120u, line);
  BOOST_TEST(run({"designs", "--json"}) == 0);
  const auto list = nlohmann::json::parse(out);
  std::vector<std::string> names;
  for (const auto& design : list) names.push_back(design["name"]);
  BOOST_TEST(
      names == (std::vector<std::string>{"thesis", "ps-only", "improved", "hd", "eco", "careful"}),
      boost::test_tools::per_element());
  BOOST_TEST(list[1]["programs"][0] == "ps-only");
}

BOOST_AUTO_TEST_CASE(designs_are_shown_with_their_figures) {
  BOOST_TEST(run({"designs", "z1.0", "--figures", "--json"}) == 0, err);
  const nlohmann::json designs = nlohmann::json::parse(out);
  BOOST_TEST(designs.size() == 6u);
  const auto figure = [&](std::size_t i, const char* key) {
    return designs[i].at(key).get<double>();
  };
  BOOST_TEST(designs[2]["name"] == "improved");
  BOOST_TEST(figure(2, "fps") > figure(0, "fps"));
  BOOST_TEST(figure(2, "corner_px") < figure(0, "corner_px"));
  BOOST_TEST(figure(2, "bram36") < figure(0, "bram36"));
  BOOST_TEST(figure(1, "lut") == 0.0, "ps-only leaves the PL empty");

  BOOST_TEST(run({"designs", "z1.0", "--changes"}) == 0, err);
  BOOST_TEST(contains(out, "\n+ overlap "), out);
  BOOST_TEST(run({"designs", "z1.0"}) == 2);
  BOOST_TEST(is_one_line_with(err, "--figures"));
  BOOST_TEST(run({"designs", "--figures", "nowhere"}) == 2);
  BOOST_TEST(is_one_line_with(err, "nowhere"));
}

BOOST_AUTO_TEST_CASE(power_prints_the_coefficients_and_checks_others) {
  BOOST_TEST(run({"power"}) == 0);
  BOOST_TEST(contains(out, "ps.core_cycle"), out);
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 100u, line);
  BOOST_TEST(run({"power", "--markdown"}) == 0);
  BOOST_TEST(contains(out, "| `ps.core_cycle` |"));
  BOOST_TEST(run({"power", "none.json"}) == 2);
  BOOST_TEST(is_one_line_with(err, "none.json"), err);
}

BOOST_AUTO_TEST_CASE(config_prints_the_effective_tree_that_reads_back) {
  BOOST_TEST(run({"config", "--set", "ps.cpu.timeout=42 s"}) == 0);
  BOOST_TEST(contains(out, "timeout: 42 s "), out);
  BOOST_TEST(contains(out, "the run ends if the program neither ends nor asks for an input"));
  kit::write_file(folder / "p.yaml", out);
  const std::string printed = out;
  BOOST_TEST(run({"config", "--config", "p.yaml"}) == 0);
  BOOST_TEST(out == printed);
}

BOOST_AUTO_TEST_CASE(config_prints_a_part_of_the_tree) {
  BOOST_TEST(run({"config", "pl"}) == 0);
  BOOST_TEST(out.rfind("pl:\n", 0) == 0u, out);
  BOOST_TEST(contains(out, "    mm2s_introut_id: 61 "), out);
  BOOST_TEST(!contains(out, "\nps:"), out);
  BOOST_TEST(run({"config", "pl.axi_dma_0", "--set", "pl.axi_dma_0.mm2s_burst_beats=16"}) == 0);
  BOOST_TEST(contains(out, "    mm2s_burst_beats: 16 "), out);
  BOOST_TEST(!contains(out, "axi_dma_1"), out);
  BOOST_TEST(run({"config", "ps.cpu_clk.frequency"}) == 0);
  BOOST_TEST(out.rfind("ps:\n  cpu_clk:\n    frequency: 666.666667 MHz ", 0) == 0u, out);
  BOOST_TEST(std::count(out.begin(), out.end(), '\n') == 3);
}

// They only say what there is; a run needs what each piece of work costs.
BOOST_AUTO_TEST_CASE(config_and_map_need_no_costs) {
  BOOST_TEST(run({"config", "profile"}) == 0);
  const std::string profile = kit::read_file(MARKERVP_PROFILES "/a9-O2.json");
  const std::string unit = "\"posit_iterations\"";
  const std::size_t at = profile.find(unit);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  kit::write_file(folder / "less.json",
                  std::string(profile).replace(at, unit.size(), "\"posit_repetitions\""));
  BOOST_TEST(run({"run", "--set", "profile=less.json"}) == 2);
  BOOST_TEST(contains(err, "posit_"), err);
  for (const char* command : {"config", "map"})
    BOOST_TEST(run({command, "--set", "profile=less.json"}) == 0, err);
  BOOST_TEST(run({"config", "--set", "profile=less.json", "--set", "sw.opt=O0"}) == 2);
  BOOST_TEST(contains(err, "it is for code compiled with -O2, and sw.opt asks for O0"), err);
  BOOST_TEST(run({"map", "--set", "profile=none.json"}) == 2);
}

BOOST_AUTO_TEST_CASE(config_takes_the_options_of_run) {
  BOOST_TEST(run({"config", "--design", "ps-only", "--fidelity", "clocked"}) == 0);
  BOOST_TEST(contains(out, "design: ps-only "), out);
  BOOST_TEST(contains(out, "fidelity: clocked "));
  const std::string tree = out;
  // A program chooses its design, which is the usual one then.
  BOOST_TEST(run({"config", "--program", "ps-only", "--fidelity", "clocked"}) == 0);
  BOOST_TEST(contains(out, "design: ps-only "), out);
  BOOST_TEST(out.substr(out.find('\n')) == tree.substr(tree.find('\n')));
}

BOOST_AUTO_TEST_CASE(trace_windows) {
  using platform::cli::parse_trace_window;
  BOOST_TEST(parse_trace_window("6ms:7ms").from_ps == 6'000'000'000u);
  BOOST_TEST(parse_trace_window(":100us").from_ps == 0u);
  BOOST_TEST(parse_trace_window(":100us").to_ps == 100'000'000u);
  BOOST_TEST(parse_trace_window("2 s:").to_ps == UINT64_MAX);
  for (const char* wrong : {"", "6ms", "a:b", "1ms:2ms:3ms", "-1ms:2ms", "5:6", "2ms:2ms"}) {
    BOOST_CHECK_THROW(parse_trace_window(wrong), vp::InputError);
  }
}

BOOST_AUTO_TEST_SUITE_END()
