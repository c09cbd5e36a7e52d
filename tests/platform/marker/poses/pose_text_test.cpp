// Poses as texts, from result.json to the last digit, and what is refused.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <marker/poses/pose_file.h>

#include "child_process.h"
#include "temporary_files.h"

namespace {

using Json = nlohmann::ordered_json;

Json marker(int id, double x) {
  return {{"id", id},
          {"rotation", 0},
          {"side_m", 0.2},
          {"corrected", 1},
          {"corners_px", {{100, 60}, {300, 60}, {300, 260}, {100, 260}}},
          {"pose",
           {{"rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"translation_m", {x, 0.25, 1.5}}}},
          {"reprojection_px", 0.125}};
}

struct Place {
  Place() {
    result["configuration"]["sw.dictionary"] = "5x5_50";
    result["frames"] = {{{"input", "a,b.png"}, {"index", 0}, {"taken_us", 2500000.25}}};
    markers() = Json::array({marker(7, 0.5)});
  }
  Json& markers() { return result["frames"][0]["markers"]; }
  int poses(std::vector<std::string> arguments) {
    kit::write_file(folder / "result.json", result.dump());
    arguments.insert(arguments.begin(), {"poses", "."});
    const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, arguments, folder.path());
    out = outcome.out;
    err = outcome.err;
    return outcome.exit_code;
  }
  bool refused(const std::vector<std::string>& arguments, const std::string& why) {
    return poses(arguments) == 2 && err.rfind("markervp: ", 0) == 0 &&
           err.find(why) != std::string::npos && out.empty();
  }

  kit::TemporaryFolder folder;
  Json result;
  std::string out, err;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(pose_texts, Place)

BOOST_AUTO_TEST_CASE(csv_has_a_line_for_each_marker) {
  BOOST_TEST(poses({"--frame", "opencv"}) == 0, err);
  const std::string line =
      "0,\"a,b.png\",2.50000025,opencv,5x5_50,7,0.2,0.6,0.35,1.5,1,0,0,0,,,,,,,1,0.125,"
      "99.5,59.5,299.5,59.5,299.5,259.5,99.5,259.5\n";
  BOOST_TEST(out.substr(out.find('\n') + 1) == line);
  const std::string head = out.substr(0, out.find('\n'));
  BOOST_TEST(std::count(head.begin(), head.end(), ',') ==
             std::count(line.begin(), line.end(), ',') - 1);
}

BOOST_AUTO_TEST_CASE(json_has_a_line_for_each_frame) {
  result["frames"].push_back({{"input", "b.png"}, {"index", 1}, {"markers", Json::array()}});
  BOOST_TEST(poses({"--format", "json", "--frame", "apriltag"}) == 0, err);
  const std::size_t end = out.find('\n');
  const Json first = Json::parse(out.substr(0, end)), second = Json::parse(out.substr(end + 1));
  BOOST_TEST(first["convention"] == "apriltag");
  BOOST_TEST(first["markers"][0]["id"] == 7);
  BOOST_TEST(first["markers"][0]["position_m"] == Json({0.6, 0.35, 1.5}));
  BOOST_TEST(first["markers"][0]["orientation_xyzw"] == Json({0.0, 0.0, 0.0, 1.0}));
  BOOST_TEST(first["markers"][0]["corners_px"][0] == Json({100.0, 260.0}));
  BOOST_TEST(second["markers"].empty());
}

BOOST_AUTO_TEST_CASE(a_trajectory_is_of_one_marker) {
  BOOST_TEST(poses({"--format", "tum"}) == 0, err);
  const std::string line =
      "2.500000250 0.500000000 0.250000000 1.500000000 0.000000000 0.000000000 0.000000000 "
      "1.000000000\n";
  BOOST_TEST(out == "# timestamp tx ty tz qx qy qz qw (top-left)\n" + line);
  markers().push_back(marker(8, 0));
  BOOST_TEST(refused({"--format", "tum"}, "there are 7, 8"), err);
  BOOST_TEST(poses({"--format", "tum", "--id", "7"}) == 0, err);
  BOOST_TEST(out.substr(out.find('\n') + 1) == line);
}

BOOST_AUTO_TEST_CASE(transforms_have_the_names_of_apriltag_ros) {
  BOOST_TEST(poses({"--format", "transforms", "--frame", "ros", "--camera-frame", "it's"}) == 0,
             err);
  BOOST_TEST(out ==
             "transforms:\n"
             "- header:\n    stamp:\n      sec: 2\n      nanosec: 500000250\n"
             "    frame_id: 'it''s'\n"
             "  child_frame_id: '5x5_50:7'\n"
             "  transform:\n"
             "    translation:\n      x: 0.600000000\n      y: 0.350000000\n      z: 1.500000000\n"
             "    rotation:\n      x: 1.000000000\n      y: 0.000000000\n      z: 0.000000000\n"
             "      w: 0.000000000\n"
             "---\n");
}

BOOST_AUTO_TEST_CASE(a_marker_that_is_seen_twice_has_no_transform) {
  markers().push_back(marker(7, 0));
  markers().push_back(marker(8, 0));
  BOOST_TEST(poses({"--format", "transforms"}) == 0, err);
  BOOST_TEST(err.find("frame 0 has marker 7 2 times") != std::string::npos, err);
  BOOST_TEST(out.find("5x5_50:7") == std::string::npos);
  BOOST_TEST(out.find("5x5_50:8") != std::string::npos);
  BOOST_TEST(poses({"--format", "detections"}) == 0, err);
  BOOST_TEST(err.empty());
}

BOOST_AUTO_TEST_CASE(a_detection_says_how_sure_it_is_and_where_its_middle_is) {
  BOOST_TEST(poses({"--format", "detections", "--frame", "top-left"}) == 0, err);
  BOOST_TEST(out.find("      class_id: '5x5_50:7'\n      score: 0.960000\n") != std::string::npos,
             out);
  BOOST_TEST(
      out.find("    center:\n      position:\n        x: 0.600000000\n") != std::string::npos, out);
  const std::vector<std::pair<const char*, const char*>> scores = {
      {"aruco_original", "0.960000"}, {"aruco_mip_36h12", "0.972222"}, {"4x4_1000", "0.937500"}};
  for (const auto& [family, score] : scores) {
    result["configuration"]["sw.dictionary"] = family;
    BOOST_TEST(poses({"--format", "detections"}) == 0, err);
    BOOST_TEST(out.find(std::string("      score: ") + score + "\n") != std::string::npos, out);
  }
  result["configuration"]["sw.dictionary_file"] = "tags/rover_2.yml";
  for (auto& marker : markers()) marker["code_cells"] = 9;
  BOOST_TEST(poses({"--format", "detections"}) == 0, err);
  BOOST_TEST(out.find("class_id: 'rover_2:7'\n      score: 0.888889\n") != std::string::npos, out);
  markers().clear();
  BOOST_TEST(poses({"--format", "detections"}) == 0, err);
  BOOST_TEST(out.find("detections: []\n---\n") != std::string::npos, out);
  result["frames"][0].erase("taken_us");
  BOOST_TEST(poses({"--format", "detections"}) == 0, err);
  BOOST_TEST(out.empty());
  BOOST_TEST(err.find("frame 0 is left out") != std::string::npos, err);
}

BOOST_AUTO_TEST_CASE(a_pose_has_its_covariance_translation_first) {
  Json covariance = Json::array();
  for (int row = 0; row < 6; ++row) {
    covariance.push_back(Json::array({0, 0, 0, 0, 0, 0}));
    covariance[row][row] = row < 3 ? 0.25 : 4;
  }
  markers()[0]["covariance"] = covariance;
  BOOST_TEST(poses({"--format", "pose"}) == 0, err);
  BOOST_TEST(out.find("  covariance:\n  - 4.00000e+00\n") != std::string::npos, out);
}

BOOST_AUTO_TEST_CASE(the_board_is_one_of_them) {
  result["frames"][0]["board"] = {{"markers", 2}, {"pose", markers()[0]["pose"]}};
  markers()[0].erase("pose");
  BOOST_TEST(poses({"--format", "tum"}) == 0, err);
  BOOST_TEST(out.find("2.500000250 0.500000000") != std::string::npos, out);
  BOOST_TEST(poses({"--id", "board"}) == 0, err);
  BOOST_TEST(out.find(",,board,,0.5,0.25,1.5,") != std::string::npos, out);
}

BOOST_AUTO_TEST_CASE(markers_may_be_of_several_sizes) {
  Json covariance = Json::array();
  for (int row = 0; row < 6; ++row) covariance.push_back(Json::array({1, 1, 1, 1, 1, 1}));
  markers()[0]["covariance"] = covariance;
  markers().push_back(marker(8, 0.5));
  BOOST_TEST(poses({"--format", "json", "--side", "0.1m", "--side", "7-7=400 mm"}) == 0, err);
  const Json found = Json::parse(out)["markers"];
  BOOST_TEST(found[0]["side_m"] == 0.4);
  BOOST_TEST(found[0]["position_m"] == Json({1.0, 0.5, 3.0}));
  BOOST_TEST(found[0]["covariance"][0] == Json({4.0, 4.0, 4.0, 2.0, 2.0, 2.0}));
  BOOST_TEST(found[1]["position_m"] == Json({0.25, 0.125, 0.75}));
  for (const char* wrong : {"7=", "x=1m", "9-7=1m", "7-=1m", "-1=1m", "7=0m", "7=1px", "7=-1m"})
    BOOST_TEST(refused({"--side", wrong}, "--side '"), wrong << ": " << err);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_said_is_refused) {
  BOOST_TEST(refused({"--id", "9"}, "there is no '9' in it: there are 7"), err);
  BOOST_TEST(refused({"--frame", "opengl"}, "opengl"), err);
  result["frames"][0].erase("taken_us");
  BOOST_TEST(poses({}) == 0, err);
  BOOST_TEST(refused({"--format", "transforms"}, "does not say when"), err);
  markers()[0].erase("side_m");
  BOOST_TEST(refused({}, "of an earlier version"), err);
  markers()[0]["side_m"] = 0.2;
  markers()[0]["pose"]["rotation"][0][0] = 2;
  BOOST_TEST(refused({}, "rotation"), err);
  result = {{"summary", 1}};
  BOOST_TEST(refused({}, "is no result.json"), err);
}

BOOST_AUTO_TEST_SUITE_END()
