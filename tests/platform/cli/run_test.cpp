#include <boost/test/unit_test.hpp>
#include <csignal>
#include <nlohmann/json.hpp>

#include <page/page_file.h>

#include "cli_kit.h"

using namespace cli_test;
using Json = nlohmann::ordered_json;

namespace {

using Names = std::vector<std::string>;

std::string grey_pgm(int width, int height) {
  return "P5 " + std::to_string(width) + " " + std::to_string(height) + " 255\n" +
         std::string(static_cast<std::size_t>(width * height), '\x40');
}

/// result.json without what may differ between equal runs.
std::string comparable(const std::string& text) {
  Json json = Json::parse(text);
  json.erase("provenance");
  return json.dump();
}

struct Files : kit::TemporaryFolder {
  Files() { kit::write_file(*this / "grey.pgm", grey_pgm(64, 32)); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(run_command, Terminal)

BOOST_AUTO_TEST_CASE(a_run_reports_and_writes_result_and_pictures) {
  BOOST_TEST(run_inputs({"z1.0", "roll30"}) == 0);
  BOOST_TEST(err.str() == "");
  BOOST_TEST(contains(out.str(), "[1/2] z1.0: marker 0, upright"), out.str());
  BOOST_TEST(contains(out.str(), "FPS      mean 125.0"), out.str());
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "results")) {
    // A build without Node.js makes no page.
    if (entry.path().filename() != "report.html") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  BOOST_TEST(names == (Names{".markervp", "0000_z1.0.png", "0001_roll30.png", "result.json"}));
  const Json json = Json::parse(result());
  BOOST_TEST(json["frames"].size() == 2u);
  BOOST_TEST(json["frames"][1]["markers"][0]["error"]["corner_px"] == 0.0);
  BOOST_TEST(json["configuration"]["depth"] == "100");
  BOOST_TEST(json["provenance"]["command_line"][1] == "z1.0");
}

BOOST_AUTO_TEST_CASE(quiet_and_no_pictures) {
  BOOST_TEST(run_inputs({"z1.0", "--quiet", "--no-pictures"}) == 0);
  BOOST_TEST(!contains(out.str(), "corners px"));
  BOOST_TEST(contains(out.str(), "FPS"));
  BOOST_TEST(!std::filesystem::exists(folder / "results/0000_z1.0.png"));
}

BOOST_AUTO_TEST_CASE(no_marker_is_a_result) {
  const Files files;
  BOOST_TEST(run_inputs({files / "grey.pgm"}) == 0);
  BOOST_TEST(contains(out.str(), "grey.pgm: no marker"));
}

BOOST_AUTO_TEST_CASE(a_required_marker_that_is_missing_is_exit_code_1) {
  const Files files;
  BOOST_TEST(run_inputs({"z1.0", files / "grey.pgm", "--require-marker"}) == 1);
  BOOST_TEST(contains(err.str(), "markervp: no marker in 1 of 2 frames, first in grey.pgm\n"),
             err.str());
  BOOST_TEST(Json::parse(result())["frames"].size() == 2u, "the results are there all the same");
  BOOST_TEST(Terminal().run_inputs({"z1.0", "--require-marker"}) == 0);
}

BOOST_AUTO_TEST_CASE(a_program_without_images) {
  behaviour.takes_images = false;
  behaviour.exit_code = 0;
  BOOST_TEST(run_inputs({}) == 0);
  BOOST_TEST(err.str() == "");
  BOOST_TEST(contains(out.str(), "no frames: the program ended at 1.5 us with exit code 0"),
             out.str());
  BOOST_TEST(!contains(out.str(), "picture"), out.str());
  BOOST_TEST(!contains(out.str(), "marker,"), out.str());
  BOOST_TEST(Json::parse(result())["program_end"]["time_us"] == 1.5);
}

BOOST_AUTO_TEST_CASE(a_program_that_fails_is_exit_code_1) {
  behaviour.exit_code = 4;
  BOOST_TEST(run_inputs({"z1.0"}) == 1);
  BOOST_TEST(err.str() == "markervp: program 'hybrid' ended with exit code 4\n");
  BOOST_TEST(Json::parse(result())["program_end"]["exit_code"] == 4);
  BOOST_TEST(Json::parse(result())["frames"].size() == 1u, "its results are kept");
}

BOOST_AUTO_TEST_CASE(a_program_that_is_stopped_has_no_exit_code) {
  behaviour.break_at = 0;
  BOOST_TEST(run_inputs({"z1.0"}) == 3);
  BOOST_TEST(contains(out.str(), "no frames: the program was stopped"), out.str());
  BOOST_TEST(Json::parse(result()).count("program_end") == 0u);
}

BOOST_AUTO_TEST_CASE(frames_and_repeat) {
  BOOST_TEST(run_inputs({"z1.0", "z2.0", "--repeat", "3", "--frames", "5", "--no-pictures"}) == 0);
  const Json frames = Json::parse(result())["frames"];
  BOOST_TEST_REQUIRE(frames.size() == 5u);
  BOOST_TEST(frames[4]["input"] == "z1.0");
  BOOST_TEST(frames[4]["index"] == 4);
}

BOOST_AUTO_TEST_CASE(settings_reach_the_platform) {
  kit::write_file(folder / "p.yaml", "depth: 7\n");
  BOOST_TEST(run_inputs({"z1.0", "--config", folder / "p.yaml", "--fidelity", "clocked"}) == 0);
  BOOST_TEST(Json::parse(result())["configuration"]["depth"] == "7");
  Terminal other;
  BOOST_TEST(other.run_inputs({"z1.0", "--config", folder / "p.yaml", "--set", "depth=9"}) == 0);
  BOOST_TEST(Json::parse(other.result())["configuration"]["depth"] == "9");
}

BOOST_AUTO_TEST_CASE(trace_options_reach_the_platform) {
  BOOST_TEST(
      run_inputs({"z1.0", "--trace", folder / "a.vcd", "--trace-window", "6ms: 7.5 ms",
                  "--trace-filter", "pl.**", "--trace-level", "registers", "--trace-clocks"}) == 0);
  BOOST_TEST_REQUIRE(asked.trace.has_value());
  BOOST_TEST(asked.trace->from_ps == 6'000'000'000u);
  BOOST_TEST(asked.trace->to_ps == 7'500'000'000u);
  BOOST_TEST(asked.trace->filter.selects("pl.sensor_input.x"));
  BOOST_TEST(!asked.trace->filter.selects("ps.gic"));
  BOOST_TEST((asked.trace->level == vp::TraceLevel::registers));
  BOOST_TEST(asked.trace->clocks);
}

BOOST_AUTO_TEST_CASE(a_trigger_reaches_the_platform) {
  BOOST_TEST(run_inputs({"z1.0", "--trace", folder / "a.vcd", "--trace-trigger", "x rises",
                         "--trace-before", "2", "--trace-buffer", "3", "--trace-frame", "y",
                         "--trace-level", "everything"}) == 0);
  BOOST_TEST_REQUIRE(asked.trace.has_value());
  BOOST_TEST_REQUIRE(asked.trace->trigger.has_value());
  BOOST_TEST(asked.trace->trigger->condition.text() == "x rises");
  BOOST_TEST(asked.trace->trigger->frame == "y");
  BOOST_TEST(asked.trace->trigger->frames_before == 2u);
  BOOST_TEST(asked.trace->trigger->buffer == 3u << 20);
  BOOST_TEST((asked.trace->level == vp::TraceLevel::everything));
}

BOOST_AUTO_TEST_CASE(equal_runs_have_equal_results) {
  Terminal other;
  BOOST_TEST(run_inputs({"z1.0", "yaw30"}) == 0);
  BOOST_TEST(other.run_inputs({"z1.0", "yaw30"}) == 0);
  BOOST_TEST(comparable(result()) == comparable(other.result()));
  BOOST_TEST((kit::read_file(folder / "results/0001_yaw30.png") ==
              kit::read_file(other.folder / "results/0001_yaw30.png")));
}

BOOST_AUTO_TEST_CASE(paths_stand_in_the_provenance_only) {
  const Files files;
  BOOST_TEST(run_inputs({files / "grey.pgm"}) == 0);
  BOOST_TEST(!contains(comparable(result()), folder.path()));
  BOOST_TEST(!contains(comparable(result()), files.path()));
  BOOST_TEST(contains(comparable(result()), "no --camera"), "the warning is in the result too");
  BOOST_TEST(contains(err.str(), "markervp: warning: no --camera"));
}

BOOST_AUTO_TEST_CASE(what_the_user_got_wrong_is_one_line_exit_code_2_and_no_files) {
  const Files files;
  kit::write_part(files / "grey.pgm", files / "half.pgm", 500);
  kit::write_file(files / "big.pgm", grey_pgm(128, 64));
  kit::write_file(files / "bad.yaml", "depth: [1\n");
  kit::write_file(files / "camera.yaml", "nothing: here\n");
  const std::vector<std::pair<Names, std::string>> cases{
      {{"z1.0", "rolll30"}, "did you mean the scene 'roll30'?"},
      {{"z1.0", files / "half.pgm"}, "is truncated"},
      {{files / "big.pgm"}, "--fit crop or --fit scale"},
      {{files / "missing.pgm"}, "no scene, image, folder or video named"},
      {{"z1.0", "--camera", files / "camera.yaml"}, "has no camera_matrix"},
      {{"z1.0", "--set", "dpeth=9"}, "depth"},
      {{"z1.0", "--set", "depth"}, "depth"},
      {{"z1.0", "--set", "depth=100000"}, "depth"},
      {{"z1.0", "--set", "depth=7 MHz"}, "depth"},
      {{"z1.0", "--config", files / "bad.yaml"}, "bad.yaml"},
      {{"z1.0", "--config", files / "missing.yaml"}, "missing.yaml"},
      {{"z1.0", "--fidelity", "quick"}, "clocked"},
      {{"z1.0", "--fit", "stretch"}, "--fit"},
      {{"z1.0", "--frames", "0"}, "--frames"},
      {{"z1.0", "--repeat", "many"}, "--repeat"},
      {{"z1.0", "--trace", files / "a.txt"}, "must end in .vcd"},
      {{"z1.0", "--trace", files / "no/folder/a.vcd"}, "No such file or directory"},
      {{"z1.0", "--trace", "a.vcd", "--trace-window", "7ms:6ms"}, "ends before it begins"},
      {{"z1.0", "--trace", "a.vcd", "--trace-window", "7:8"}, "--trace-window"},
      {{"z1.0", "--trace-window", "6ms:7ms"}, "--trace"},
      {{"z1.0", "--outptu", "x"}, "did you mean '--output'?"},
  };
  for (const auto& [arguments, problem] : cases) {
    Terminal terminal;
    BOOST_TEST(terminal.run_inputs(arguments) == 2, arguments.back());
    BOOST_TEST(is_one_line_with(terminal.err.str(), problem), terminal.err.str()
                                                                  << " lacks " << problem);
    BOOST_TEST(terminal.out.str() == "");
    BOOST_TEST(!terminal.has_results(), arguments.back());
    BOOST_TEST(terminal.behaviour.runs == 0u, "the simulation did not start");
  }
}

BOOST_AUTO_TEST_CASE(an_output_folder_that_cannot_be_written_is_refused_before_the_simulation) {
  kit::write_file(folder / "file", "x");
  for (const std::string& output : {folder / "file", std::string("/proc/markervp")}) {
    BOOST_TEST(run({"run", "z1.0", "--output", output}) == 2);
    BOOST_TEST(is_one_line_with(err.str(), "choose another with --output"), err.str());
    BOOST_TEST(behaviour.runs == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_protocol_error_keeps_the_results_so_far) {
  behaviour.break_at = 2;
  BOOST_TEST(run_inputs({"z1.0", "z2.0", "z3.0", "z4.0"}) == 3);
  BOOST_TEST(is_one_line_with(err.str(), "the DMA was not armed"), err.str());
  const Json json = Json::parse(result());
  BOOST_TEST(json["frames"].size() == 2u);
  BOOST_TEST(json.contains("incomplete"));
  BOOST_TEST(json["provenance"]["error"] == "the DMA was not armed");
}

BOOST_AUTO_TEST_CASE(a_simulation_that_refuses_to_start_leaves_nothing) {
  behaviour.refuses = true;
  BOOST_TEST(run_inputs({"z1.0"}) == 2);
  BOOST_TEST(is_one_line_with(err.str(), "the trace filter matches no signal"), err.str());
  BOOST_TEST(!has_results());
}

BOOST_AUTO_TEST_CASE(an_input_that_goes_bad_during_the_run_keeps_the_results_so_far) {
  const Files files;
  behaviour.after = [&](std::uint32_t) {
    kit::write_file(files / "grey.pgm", "P5 64 32 255\n...");
  };
  BOOST_TEST(run_inputs({"z1.0", files / "grey.pgm", "--no-pictures"}) == 2);
  BOOST_TEST(contains(err.str(), "is truncated"), err.str());
  BOOST_TEST(Json::parse(result())["frames"].size() == 1u);
}

BOOST_AUTO_TEST_CASE(ctrl_c_ends_after_the_frame_and_keeps_the_results) {
  behaviour.after = [](std::uint32_t index) {
    if (index == 1) std::raise(SIGINT);
  };
  BOOST_TEST(run_inputs({"z1.0", "--repeat", "1000", "--no-pictures"}) == 130);
  BOOST_TEST(contains(err.str(), "interrupted"));
  const Json json = Json::parse(result());
  BOOST_TEST(json["frames"].size() == 2u);
  BOOST_TEST(json["incomplete"] == "interrupted");
}

BOOST_AUTO_TEST_CASE(a_page_to_look_at_unless_it_is_not_wanted) {
  const auto has_page = [&] { return std::filesystem::exists(folder / "results/report.html"); };
  BOOST_TEST(run_inputs({"z1.0", "--no-report"}) == 0);
  BOOST_TEST(!has_page());
  BOOST_TEST(run({"report", folder / "nowhere"}) == 2);
  if (platform::page::page_template().empty()) return;  // a build without Node.js
  BOOST_TEST(run({"report", folder / "results"}) == 0);
  BOOST_TEST(has_page());
  BOOST_TEST(run({"report", folder / "results", folder / "results", "-o", folder / "both.html"}) ==
             0);
  BOOST_TEST(std::filesystem::exists(folder / "both.html"));
  BOOST_TEST(run({"report", folder / "results", "-o", folder / "one.html"}) == 2);
  std::filesystem::remove(folder / "results/report.html");
  BOOST_TEST(run_inputs({"z1.0"}) == 0);
  BOOST_TEST(has_page());
}

BOOST_AUTO_TEST_SUITE_END()
