#include <marker/report/marker_metrics.h>
#include <result/result_json.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <vp/error.h>

#include "report_kit.h"
#include "temporary_files.h"

using namespace platform;
using namespace report_test;
using Json = nlohmann::ordered_json;

namespace {

Json written(const std::vector<facts::UnitReport>& frames,
             const std::vector<std::string>& warnings = {},
             const std::optional<std::string>& incomplete = std::nullopt) {
  const kit::TemporaryFolder folder;
  host::OutputFolder output(folder.path());
  result::ResultWriter writer(output);
  for (const facts::UnitReport& frame : frames) writer.add(judged(frame));
  BOOST_TEST(!std::filesystem::exists(folder / "result.json"), "not before it is complete");
  facts::RunFacts facts = report_test::run_facts();
  facts.incomplete = incomplete;
  writer.finish(facts, provenance(), warnings);
  BOOST_TEST(folder.entries() == (std::vector<std::string>{".markervp", "result.json"}));
  return Json::parse(kit::read_file(folder / "result.json"));
}

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> result;
  for (const auto& [key, value] : json.items()) result.push_back(key);
  return result;
}

using Keys = std::vector<std::string>;

}  // namespace

// What the application declares, designs need not.
const bool is_registered = platform::register_marker_metrics();

BOOST_AUTO_TEST_SUITE(result_writer)

BOOST_AUTO_TEST_CASE(the_keys_of_schema_1_stand_in_order) {
  const Json json = written({found_frame("z1.0", 0, 5)});
  BOOST_TEST(keys(json) ==
             (Keys{"schema", "provenance", "fidelity", "system", "design", "profile",
                   "configuration", "frames", "stages", "summary", "limit", "verdict"}));
  BOOST_TEST(json["schema"] == 1);
  BOOST_TEST(json["configuration"]["pl.clk"] == "50 MHz");
  const Json& frame = json["frames"][0];
  BOOST_TEST(keys(frame) ==
             (Keys{"input", "index", "threshold", "scene_marker", "counts", "markers", "time_us"}));
  BOOST_TEST(keys(frame["counts"]) ==
             (Keys{"corners", "blobs", "feature_words", "candidates", "feature_overflow"}));
  BOOST_TEST(frame["counts"]["feature_overflow"] == 5);
  BOOST_TEST(keys(frame["markers"][0]) ==
             (Keys{"id", "rotation", "side_m", "corners_px", "pose", "reprojection_px",
                   "iterations", "truth", "error"}));
  BOOST_TEST(keys(json["summary"]) ==
             (Keys{"frames", "delivered", "detected", "fps", "latency_us"}));
}

// Where the program tells them.
BOOST_AUTO_TEST_CASE(covariance_and_board) {
  platform::facts::UnitReport frame = found_frame("z1.0");
  platform::PoseCovariance covariance{};
  covariance[1] = -1.23456789e-9;
  covariance[35] = 0.25;
  marker_frame(frame).markers[0].covariance = covariance;
  marker_frame(frame).markers[0].motion = platform::PoseMotion{12, {0.123456789, 0, -1}, {0, 2, 0}};
  marker_frame(frame).board = {7, marker_frame(frame).markers[0].pose, covariance};
  const Json written_frame = written({frame})["frames"][0];
  const Json& rows = written_frame["markers"][0]["covariance"];
  BOOST_REQUIRE(rows.size() == 6u);
  BOOST_TEST(rows[0] == Json({0.0, -1.23457e-9, 0.0, 0.0, 0.0, 0.0}));
  BOOST_TEST(rows[5][5] == 0.25);
  BOOST_TEST(written_frame["board"]["markers"] == 7);
  BOOST_TEST(written_frame["board"]["pose"] == written_frame["markers"][0]["pose"]);
  BOOST_TEST(written_frame["board"]["covariance"] == rows);
  const Json motion = {{"frames", 12},
                       {"velocity_m_s", {0.123457, 0.0, -1.0}},
                       {"turn_rate_rad_s", {0.0, 2.0, 0.0}}};
  BOOST_TEST(written_frame["markers"][0]["motion"] == motion);
  BOOST_TEST(!written_frame["board"].contains("motion"));  // no filter: none
}

BOOST_AUTO_TEST_CASE(values_and_errors) {
  const Json json = written({found_frame("z1.0")});
  const Json& marker = json["frames"][0]["markers"][0];
  BOOST_TEST(marker["error"]["corner_px"] == 0.5, "one of four corners is 2 px off");
  BOOST_TEST(marker["error"]["translation_mm"] == 12.0);
  BOOST_TEST(marker["error"]["rotation_deg"] == 0.0);
  BOOST_TEST(marker["pose"]["translation_m"] == Json({0.0, 0.0, 1.012}));
  BOOST_TEST(marker["pose"]["rotation"][1] == Json({0.0, 1.0, 0.0}));
  BOOST_TEST(marker["truth"]["pose"]["translation_m"][2] == 1.0);
  BOOST_TEST(marker["corners_px"][0] == Json({322.0, 240.0}));
  BOOST_TEST(json["frames"][0]["time_us"]["pose"] == 0.123456, "a picosecond is not lost");
}

BOOST_AUTO_TEST_CASE(numbers_are_rounded_to_stated_places) {
  BOOST_TEST(result::rounded(0.1234567, 6) == 0.123457);
  BOOST_TEST(result::rounded(-0.0000001, 6) == 0.0);
  BOOST_TEST(!std::signbit(result::rounded(-0.0000001, 6)));
  BOOST_TEST(result::rounded(6144.5, 6) == 6144.5);
}

BOOST_AUTO_TEST_CASE(the_summary_excludes_the_upload) {
  const Json json = written({found_frame("z1.0", 0), found_frame("z1.0", 1)});
  BOOST_TEST(json["summary"]["frames"] == 2);
  BOOST_TEST(json["summary"]["detected"] == 2);
  BOOST_TEST(json["summary"]["fps"]["mean"] == 125.0);
  BOOST_TEST(json["summary"]["fps"]["max"] == 125.0);
  BOOST_TEST(json["summary"]["latency_us"]["max"] == 8000.0);
}

BOOST_AUTO_TEST_CASE(what_is_not_known_is_absent) {
  facts::UnitReport frame = found_frame("z1.0");
  marker_frame(frame).truth.reset();
  marker_frame(frame).markers[0].has_pose = false;
  const Json marker = written({frame})["frames"][0]["markers"][0];
  BOOST_TEST(keys(marker) == (Keys{"id", "rotation", "side_m", "corners_px"}));
  const Json nothing = written({});
  BOOST_TEST(nothing["frames"].empty());
  BOOST_TEST(keys(nothing["summary"]) == (Keys{"frames", "delivered", "detected"}));
}

BOOST_AUTO_TEST_CASE(stages_say_what_they_are_parts_of) {
  const Json json = written({found_frame("z1.0")});
  BOOST_TEST(json["stages"] == Json::parse(R"([{"name": "upload"},
      {"name": "feature_extraction", "part_of": "frame", "clock": "ps.fclk_clk1",
       "why": "one pixel a clock"},
      {"name": "pose", "part_of": "frame"}, {"name": "frame"}])"));
}

BOOST_AUTO_TEST_CASE(the_limit_has_its_stages_shares_and_levers) {
  facts::UnitReport frame = found_frame("z1.0");
  frame.times[1].levers = {"a.b=2"};
  frame.times[2].waits = true;
  const Json json = written({frame});
  BOOST_TEST(json["limit"] == Json::parse(R"({"kind": "sequence", "stages": ["feature_extraction"],
      "stages_us": 6144.5, "period_us": 8000.0,
      "percent": {"feature_extraction": 100.0, "camera": 0.0}, "clock": "ps.fclk_clk1",
      "why": "one pixel a clock", "levers": ["a.b=2"],
      "text": "feature extraction sets the frame rate: 6144.5 of 8000.0 us, one stage follows the other",
      "faster_with": "a.b=2, or a higher ps.fclk_clk1.frequency"})"));
  BOOST_TEST(!written({given_up_frame("z1.0")}).contains("limit"));
}

BOOST_AUTO_TEST_CASE(a_frame_given_up_says_so_and_makes_no_figures) {
  const Json json = written({given_up_frame("z1.0")});
  BOOST_TEST(json["frames"][0]["gave_up"] == "binary image timed out");
  BOOST_TEST(json["summary"] == Json::parse(R"({"frames": 1, "delivered": 0, "detected": 0})"));
  BOOST_TEST(!json.contains("stages"));
  BOOST_TEST(!written({found_frame("z1.0")})["frames"][0].contains("gave_up"));
}

BOOST_AUTO_TEST_CASE(another_marker_than_the_scenes_has_no_error) {
  facts::UnitReport frame = found_frame("z1.0");
  marker_frame(frame).markers[0].id = 77;
  const Json marker = written({frame})["frames"][0]["markers"][0];
  BOOST_TEST(!marker.contains("error"));
  BOOST_TEST(!marker.contains("truth"));
}

BOOST_AUTO_TEST_CASE(warnings_and_an_early_end_are_told) {
  facts::UnitReport frame = found_frame("z1.0");
  frame.warnings = {"a word was lost"};
  const Json json = written({frame}, {"no camera"}, "interrupted");
  BOOST_TEST(json["frames"][0]["warnings"][0] == "a word was lost");
  BOOST_TEST(json["warnings"][0] == "no camera");
  BOOST_TEST(json["incomplete"] == "interrupted");
}

BOOST_AUTO_TEST_CASE(equal_runs_give_equal_bytes_and_bad_utf8_does_no_harm) {
  facts::UnitReport frame = found_frame("z1.0");
  frame.input = "caf\xE9.png";
  BOOST_TEST(written({frame}).dump() == written({frame}).dump());
}

BOOST_AUTO_TEST_CASE(in_memory_it_is_the_same_without_provenance_and_configuration) {
  facts::UnitReport frame = found_frame("z1.0");
  frame.input = "caf\xE9.png";
  for (const std::vector<facts::UnitReport>& frames :
       {std::vector<facts::UnitReport>{}, {frame}, {frame, found_frame("z4.0")}}) {
    Json file = written(frames, {"no camera"}, "interrupted");
    file.erase("provenance");
    file.erase("configuration");
    result::ResultDocument document;
    for (const facts::UnitReport& one : frames) document.add(judged(one));
    BOOST_TEST(document.json().is_null());
    facts::RunFacts stopped = run_facts();
    stopped.incomplete = "interrupted";
    document.finish(stopped, provenance(), {"no camera"});
    BOOST_TEST(document.summary().frames() == frames.size());
    BOOST_TEST(document.take().dump(-1, ' ', false, Json::error_handler_t::replace) == file.dump());
  }
}

BOOST_AUTO_TEST_CASE(without_finish_nothing_is_left) {
  const kit::TemporaryFolder folder;
  {
    host::OutputFolder output(folder.path());
    result::ResultWriter writer(output);
  }
  BOOST_TEST(folder.entries().empty());
}

BOOST_AUTO_TEST_SUITE_END()
