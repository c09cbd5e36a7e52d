#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include <result/page/report_page.h>

#include "cli_kit.h"

using namespace cli_test;
using Json = nlohmann::ordered_json;

namespace {

using Names = std::vector<std::string>;

struct Run : Terminal {
  /// `markervp run`, with the results in `results`.
  int run_inputs(Names arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--output", "results"});
    return run(arguments);
  }
  Json result() const { return Json::parse(kit::read_file(folder / "results/result.json")); }
  /// A trace of 100 ns, or of `window`.
  std::string trace(const Names& more, const std::string& window = "1us: 1.1 us") {
    Names arguments{"z1.0", "--no-pictures", "--no-report", "--trace", "a.vcd"};
    if (!window.empty()) arguments.insert(arguments.end(), {"--trace-window", window});
    arguments.insert(arguments.end(), more.begin(), more.end());
    BOOST_TEST_REQUIRE(run_inputs(arguments) == 0, err);
    return kit::read_file(folder / "a.vcd");
  }
  bool has_page() const { return std::filesystem::exists(folder / "results/report.html"); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(run_command, Run)

BOOST_AUTO_TEST_CASE(a_run_reports_and_writes_result_and_pictures) {
  BOOST_TEST(run_inputs({"z1.0", "roll30"}) == 0);
  BOOST_TEST(err == "");
  BOOST_TEST(contains(out, "[1/2] z1.0: marker 0, upright"), out);
  BOOST_TEST(contains(out, "FPS      mean 1"), out);
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "results")) {
    // A build without Node.js makes no page.
    if (entry.path().filename() != "report.html") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  BOOST_TEST(names == (Names{".markervp", "0000_z1.0.png", "0001_roll30.png", "result.json"}));
  const Json json = result();
  BOOST_TEST(json["frames"].size() == 2u);
  BOOST_TEST(json["frames"][1]["markers"][0]["error"]["corner_px"] < 2.0);
  BOOST_TEST(json["configuration"]["pl.width"] == "640 px");
  BOOST_TEST(json["provenance"]["command_line"][1] == "z1.0");
}

BOOST_AUTO_TEST_CASE(quiet_and_no_pictures) {
  BOOST_TEST(run_inputs({"z1.0", "--quiet", "--no-pictures"}) == 0);
  BOOST_TEST(!contains(out, "corners px"));
  BOOST_TEST(contains(out, "FPS"));
  BOOST_TEST(!std::filesystem::exists(folder / "results/0000_z1.0.png"));
}

BOOST_AUTO_TEST_CASE(frames_and_repeat) {
  BOOST_TEST(run_inputs({"z1.0", "z2.0", "--repeat", "3", "--frames", "5", "--no-pictures"}) == 0);
  const Json frames = result()["frames"];
  BOOST_TEST_REQUIRE(frames.size() == 5u);
  BOOST_TEST(frames[4]["input"] == "z1.0");
  BOOST_TEST(frames[4]["index"] == 4);
}

BOOST_AUTO_TEST_CASE(set_wins_over_files) {
  kit::write_file(folder / "p.yaml", "ps:\n  cpu:\n    timeout: 7 s\n");
  const auto timeout = [&] { return result()["configuration"]["ps.cpu.timeout"]; };
  BOOST_TEST(run_inputs({"z1.0", "--config", "p.yaml"}) == 0);
  BOOST_TEST(timeout() == "7 s");
  BOOST_TEST(run_inputs({"z1.0", "--set", "ps.cpu.timeout=9 s", "--config", "p.yaml"}) == 0);
  BOOST_TEST(timeout() == "9 s");
}

BOOST_AUTO_TEST_CASE(options_choose_what_a_trace_holds) {
  const std::string ports = trace({"--trace-filter", "pl.corner_detection.**"});
  BOOST_TEST(contains(ports, "$scope module corner_detection"));
  BOOST_TEST(!contains(ports, "$scope module blob_detection"));
  BOOST_TEST(contains(ports, "\n#1000000\n"), "it begins there");
  BOOST_TEST(contains(ports, "\n#1100000\n"));
  BOOST_TEST(!contains(ports, "centre_strength"));
  BOOST_TEST(!contains(ports, " clk $end"));
  BOOST_TEST(
      contains(trace({"--trace-filter", "pl.corner_detection.**", "--trace-level", "registers"}),
               "$var reg 12 % centre_strength [11:0] $end"));
  BOOST_TEST(contains(trace({"--trace-filter", "ps.**", "--trace-clocks"}), " clk $end"));
}

BOOST_AUTO_TEST_CASE(a_trigger_keeps_its_frame_and_those_before) {
  const Names third{"--repeat",         "4", "--trace-filter", "ps.cpu.frame", "--trace-trigger",
                    "ps.cpu.frame == 3"};
  const auto frames = [&](Names more) {
    more.insert(more.begin(), third.begin(), third.end());
    std::istringstream lines(trace(more, ""));
    std::string values;
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == 'b') values += line.substr(1, line.find(' '));
    }
    return values;
  };
  BOOST_TEST(frames({}) == "10 11 ");
  BOOST_TEST(frames({"--trace-before", "1", "--trace-frame", "ps.cpu.frame"}) == "1 10 11 ");
  BOOST_TEST(run_inputs({"z1.0", "--trace", "a.vcd", "--trace-trigger", "ps.cpu.frame == 1",
                         "--trace-frame", "nowhere"}) == 2);
  BOOST_TEST(is_one_line_with(err, "'nowhere'"), err);
}

BOOST_AUTO_TEST_CASE(a_page_to_look_at_unless_it_is_not_wanted) {
  BOOST_TEST(run_inputs({"z1.0", "--no-report"}) == 0);
  BOOST_TEST(!has_page());
  BOOST_TEST(run({"report", "nowhere"}) == 2);
  if (platform::page::page_template().empty()) return;  // a build without Node.js
  BOOST_TEST(run({"report", "results"}) == 0);
  BOOST_TEST(has_page());
  BOOST_TEST(run({"report", "results", "results", "-o", "both.html"}) == 0);
  BOOST_TEST(std::filesystem::exists(folder / "both.html"));
  BOOST_TEST(run({"report", "results", "-o", "one.html"}) == 2);
  std::filesystem::remove(folder / "results/report.html");
  BOOST_TEST(run_inputs({"z1.0"}) == 0);
  BOOST_TEST(has_page());
}

BOOST_AUTO_TEST_SUITE_END()
