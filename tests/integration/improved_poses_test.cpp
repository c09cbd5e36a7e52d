// What the design `improved` finds, and how exact its poses are.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "improved_runs.h"

using namespace integration;
using namespace integration::improved_runs;

BOOST_AUTO_TEST_SUITE(improved)

// 8 % of the light: edges are 17 grey levels high. The first frame has no threshold of one before.
BOOST_AUTO_TEST_CASE(markers_are_found_in_dim_light) {
  const std::string dim = "front0@distance=2.5m,pitch=30deg,yaw=20deg,markers=4,light=0.08";
  const auto markers = [](const Json& frame) { return frame["markers"].size(); };
  const Json frames = run_of({dim, dim})["frames"];
  BOOST_TEST(markers(frames[0]) == 0u);
  BOOST_TEST(markers(frames[1]) == 4u);
  const Json strict = run_of(with({dim, dim}, "sw.minimum_contrast=20"))["frames"];
  BOOST_TEST(strict.size() == 2u);
  for (const Json& frame : strict) BOOST_TEST(markers(frame) == 0u);
  const Json careful = run_of({dim}, 0, "careful")["frames"][0];
  BOOST_TEST(markers(careful) == 4u, "what lies around a pixel needs no frame before");
  BOOST_TEST(!careful.contains("threshold"), "no frame has one for all its pixels");
}

BOOST_AUTO_TEST_CASE(careful_finds_what_is_hidden_in_part) {
  const Arguments hidden{"front0@distance=1.5m,roll=10deg,markers=4,hidden=0.1"};
  const auto markers = [](const Json& result) { return result["frames"][0]["markers"].size(); };
  BOOST_TEST(markers(run_of(hidden)) == 3u);
  BOOST_TEST(markers(run_of(hidden, 0, "careful")) == 4u);
}

// Issue 17, on the 41 poses of thesis 5.2.2 and 5.2.3: a millisecond from the last pixel to the
// pose in each, and 0.03 px, 1 mm and 0.15 degrees on average, whatever the blur.
BOOST_AUTO_TEST_CASE(the_poses_of_the_thesis_at_any_blur) {
  for (const char* blur : {"0px", "0.35px", "0.7px"}) {
    Arguments scenes;
    for (const platform::SceneGroup& group : platform::scene_groups()) {
      if (group.section.rfind("5.2.2", 0) != 0 && group.section.rfind("5.2.3", 0) != 0) continue;
      for (const std::string& name : group.scenes) scenes.push_back(name + "@blur=" + blur);
    }
    const Json result = run_of(scenes);
    BOOST_TEST(result["frames"].size() == 41u);
    BOOST_TEST(result["summary"]["detected"] == 41);
    BOOST_TEST(mean_error(result, "corner_px") < 0.012, "blur " << blur);
    BOOST_TEST(mean_error(result, "translation_mm") < 0.5, "blur " << blur);
    BOOST_TEST(mean_error(result, "rotation_deg") < 0.1, "blur " << blur);
    for (const Json& frame : result["frames"]) BOOST_TEST(latency_us(frame) < 1000);
  }
}

BOOST_AUTO_TEST_CASE(a_pose_says_how_well_it_is_known) {
  const Json marker = run_of({"z2.0"})["frames"][0]["markers"][0];
  const Json& covariance = marker["covariance"];
  BOOST_REQUIRE(covariance.size() == 6u);
  for (int i = 0; i < 6; ++i) {
    BOOST_TEST(double(covariance[i][i]) > 0);
    for (int k = 0; k < i; ++k) BOOST_TEST(covariance[i][k] == covariance[k][i]);
  }
  // Depth is known worst; the error is within four standard deviations.
  const double depth_mm = 1000 * std::sqrt(double(covariance[5][5]));
  BOOST_TEST(depth_mm > 1000 * std::sqrt(double(covariance[3][3])));
  BOOST_TEST(double(marker["error"]["translation_mm"]) < 4 * depth_mm);
}

// A marker that moves steadily, a picture every 3.1 ms: what a frame says alone, and what it says
// with those before it.
BOOST_AUTO_TEST_CASE(poses_follow_a_motion) {
  Arguments moving;
  for (int i = 0; i < 60; ++i) {
    moving.push_back(
        "z3.0@velocity_x=0.3,velocity_z=-0.4,exposure=0s,time=" + std::to_string(3100 * i) + "us");
  }
  const Arguments followed = with(moving, "sw.pose_filter=1");
  const Json alone = run_of(moving), together = run_of(followed);
  const auto settled = [](const Json& result, const char* key) {
    double sum = 0;
    for (std::size_t i = 30; i < 60; ++i)
      sum += double(result["frames"][i]["markers"][0]["error"][key]);
    return sum / 30;
  };
  for (const char* key : {"translation_mm", "rotation_deg"})
    BOOST_TEST(settled(together, key) < 0.65 * settled(alone, key), key);
  BOOST_TEST(!alone["frames"][59]["markers"][0].contains("motion"));
  BOOST_TEST(together["frames"][0]["markers"][0]["pose"] ==
             alone["frames"][0]["markers"][0]["pose"]);
  const Json& motion = together["frames"][59]["markers"][0]["motion"];
  BOOST_TEST(motion["frames"] == 60);
  // Frames follow each other a little faster than the pictures say: 324 a second.
  BOOST_TEST(std::abs(double(motion["velocity_m_s"][0]) - 0.3) < 0.02);
  BOOST_TEST(std::abs(double(motion["velocity_m_s"][2]) + 0.4) < 0.02);
  // The poses are part of the time, and both fidelities agree in all of it.
  BOOST_TEST(mean_us(together, "pose") > mean_us(alone, "pose") + 20);
  BOOST_TEST(mean_us(together, "pose") < mean_us(alone, "pose") + 40);
  const Arguments few(followed.begin(), followed.begin() + 3);
  BOOST_TEST(difference(with(few, "sw.pose_filter=1")) == "");
  // Seconds are those of the CPU's clock, whatever it is.
  const Json slow = run_of(with(followed, "ps.cpu_clk.frequency=333.333333 MHz"));
  BOOST_TEST(std::abs(double(slow["frames"][59]["markers"][0]["motion"]["velocity_m_s"][0]) - 0.3) <
             0.02);
}

// One pose, of the first marker's corner.
BOOST_AUTO_TEST_CASE(a_board_has_one_pose) {
  const kit::TemporaryFolder folder;
  const Arguments board = board_in(folder);
  BOOST_TEST(difference(board) == "");
  const Json frame = run_of(board)["frames"][0];
  BOOST_TEST(frame["markers"].size() == 8u);
  for (const Json& marker : frame["markers"]) BOOST_TEST(!marker.contains("pose"));
  BOOST_TEST(frame["board"]["markers"] == 8);
  const Json& place = frame["board"]["pose"]["translation_m"];
  const double metres = 0.1 / 60, depth = 381.36 * metres;
  BOOST_TEST(std::abs(double(place[0]) - (80 - 320) * metres) < 1e-4);
  BOOST_TEST(std::abs(double(place[1]) - (120 - 240) * metres) < 1e-4);
  BOOST_TEST(std::abs(double(place[2]) - depth) < 1e-3);
  BOOST_TEST(!run_of({"demo"})["frames"][0].contains("board"));
}

BOOST_AUTO_TEST_CASE(of_two_boards_in_view_neither_is_taken_for_the_board) {
  const kit::TemporaryFolder folder;
  const Json frame = run_of(of_board({picture_in(folder, "boards", [](int x, int y) {
    return grey_of_marker(x % 320 / 80 + y / 80 % 2 * 4, x % 80 - 20, y % 80 - 20, 40);
  })}))["frames"][0];
  BOOST_TEST(!frame.contains("board"));
  BOOST_TEST(frame["warnings"].dump().find(
                 "more than one marker of ID 0, 1, 2, 3, 4, 5, 6, 7: which one is the board's") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
