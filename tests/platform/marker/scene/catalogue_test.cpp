#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <stdexcept>

#include <marker/scene/scene.h>

#include "scene_kit.h"

using namespace platform;
using scene_kit::check_refused;

namespace {

const SceneGroup& group(const std::string& name) {
  for (const SceneGroup& candidate : scene_groups()) {
    if (candidate.name == name) return candidate;
  }
  throw std::out_of_range("no scene group " + name);
}

std::uint16_t turned(std::uint16_t word) {
  std::uint16_t result = 0;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      result = static_cast<std::uint16_t>(2 * result + (is_black(word, 3 - column, row) ? 1 : 0));
    }
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(catalogue)

BOOST_AUTO_TEST_CASE(counts_of_chapter_5) {
  BOOST_TEST(group("x").scenes.size() == 5u);
  BOOST_TEST(group("y").scenes.size() == 5u);
  BOOST_TEST(group("z").scenes.size() == 9u);
  BOOST_TEST(group("pitch").scenes.size() == 5u);
  BOOST_TEST(group("yaw").scenes.size() == 5u);
  BOOST_TEST(group("roll").scenes.size() == 12u);
  std::size_t poses = 0;
  for (const SceneGroup& candidate : scene_groups()) {
    const std::string section = candidate.section.substr(0, 5);
    if (section == "5.2.2" || section == "5.2.3") poses += candidate.scenes.size();
    BOOST_TEST(!candidate.description.empty());
  }
  BOOST_TEST(poses == 41u);
  BOOST_TEST(group("squares").scenes.size() == 15u);
  BOOST_TEST(group("id").scenes.size() == 10u);
  BOOST_TEST(group("front").scenes.size() == 250u);
  BOOST_TEST(group("demo").scenes.size() == 1u);
  BOOST_TEST(scene_names().size() == 41u + 15u + 10u + 250u + 1u);
}

BOOST_AUTO_TEST_CASE(names) {
  const std::vector<std::string> x{"x-1.0", "x-0.5", "x0.0", "x0.5", "x1.0"};
  BOOST_TEST(group("x").scenes == x);
  const std::vector<std::string> y{"y-0.8", "y-0.4", "y0.0", "y0.4", "y0.8"};
  BOOST_TEST(group("y").scenes == y);
  BOOST_TEST(group("z").scenes.front() == "z0.5");
  BOOST_TEST(group("z").scenes.back() == "z4.5");
  BOOST_TEST(group("roll").scenes.back() == "roll330");
  BOOST_TEST(group("front").scenes.back() == "front249");
  for (const char* name : {"id0", "id7", "id15", "id21", "id36", "id43", "id52", "id76", "id88",
                           "id99", "demo", "squares15", "pitch60", "yaw0"}) {
    BOOST_TEST(is_scene(name), name);
  }
  const std::vector<std::string> names = scene_names();
  BOOST_TEST(std::set<std::string>(names.begin(), names.end()).size() == names.size());
}

BOOST_AUTO_TEST_CASE(every_scene_is_valid_and_shows_its_marker) {
  std::set<std::uint64_t> seeds;
  for (const std::string& name : scene_names()) {
    BOOST_TEST_CONTEXT(name) {
      const Scene scene = make_scene(name);
      BOOST_TEST(scene.name == name);
      BOOST_TEST(scene.noise_sigma == 0.007);
      seeds.insert(scene.seed);
      for (const PixelPoint& corner : ground_truth(scene).corners_px) {
        BOOST_TEST((corner.x > 4 && corner.x < 636 && corner.y > 4 && corner.y < 476));
      }
    }
  }
  BOOST_TEST(seeds.size() == scene_names().size());
}

BOOST_AUTO_TEST_CASE(poses_of_the_tests) {
  BOOST_TEST((make_scene("x-1.0").pose.translation == Eigen::Vector3d{1, 0, 2}));
  BOOST_TEST((make_scene("y0.4").pose.translation == Eigen::Vector3d{0, -0.4, 2}));
  BOOST_TEST((make_scene("z4.5").pose.translation == Eigen::Vector3d{0, 0, 4.5}));
  BOOST_TEST((make_scene("pitch15").pose.rotation == rotation_x(15)));
  BOOST_TEST((make_scene("yaw45").pose.rotation == rotation_y(45)));
  BOOST_TEST((make_scene("roll330").pose.rotation == rotation_z(330)));
  BOOST_TEST((make_scene("roll330").pose.translation == Eigen::Vector3d{0, 0, 1}));
  BOOST_TEST(make_scene("roll330").marker_id == 0);
}

BOOST_AUTO_TEST_CASE(squares_come_one_by_one) {
  for (int count = 1; count <= 15; ++count) {
    const Scene scene = make_scene("squares" + std::to_string(count));
    BOOST_TEST(scene.squares.size() == static_cast<std::size_t>(count - 1));
    BOOST_TEST((scene.pose.translation == Eigen::Vector3d{-0.15, -0.15, 2.5}));
  }
  const Scene scene = make_scene("squares15");
  BOOST_TEST(scene.squares[0].u == -0.62);
  BOOST_TEST(scene.squares[0].v == 0);
  BOOST_TEST(scene.squares[13].u == 1.24);
  BOOST_TEST(scene.squares[13].v == 0.62);
}

BOOST_AUTO_TEST_CASE(markers_of_the_identification_tests) {
  BOOST_TEST(make_scene("id52").marker_id == 52);
  BOOST_TEST(make_scene("front249").marker_id == 249);
  BOOST_TEST((make_scene("front7").pose.translation == Eigen::Vector3d{-0.15, -0.15, 1}));
}

BOOST_AUTO_TEST_CASE(the_demo_has_one_marker_of_the_dictionary) {
  const Scene scene = make_scene("demo");
  for (const Square& square : scene.squares) {
    std::uint16_t word = square.word;
    for (int turn = 0; turn < 4; ++turn) {
      BOOST_TEST(std::count(dictionary().begin(), dictionary().end(), word) == 0);
      word = turned(word);
    }
    BOOST_TEST(word == square.word);
  }
}

BOOST_AUTO_TEST_CASE(a_camera_can_be_given) {
  const Scene scene = make_scene("z1.0", Camera::for_resolution(1280, 960));
  BOOST_TEST(scene.camera.width == 1280);
  const auto corners = ground_truth(scene).corners_px;
  BOOST_TEST(std::abs(corners[1].x - corners[0].x - 2 * 381.36 * 0.3) < 1e-9);
}

BOOST_AUTO_TEST_CASE(conditions_change_a_scene) {
  const Scene noisy = make_scene("demo@noise=0.02, blur=1.5px,light=0.5");
  BOOST_TEST(noisy.name == "demo@noise=0.02, blur=1.5px,light=0.5");
  BOOST_TEST(noisy.noise_sigma == 0.02);
  BOOST_TEST(noisy.blur_sigma_px == 1.5);
  BOOST_TEST(noisy.brightness.wall == 0.349);
  BOOST_TEST((noisy.pose.translation == make_scene("demo").pose.translation));
  BOOST_TEST(noisy.squares.size() == make_scene("demo").squares.size());
  const Scene placed = make_scene("z4.5@distance=2m,yaw=30 deg,roll=90deg,id=7,squares=5");
  BOOST_TEST((placed.pose.rotation == rotation_y(30) * rotation_z(90)));
  BOOST_TEST((placed.pose.translation ==
              pose_from_centre(rotation_y(30) * rotation_z(90), {0, 0, 2}).translation));
  BOOST_TEST(placed.marker_id == 7);
  BOOST_TEST(placed.squares.size() == 4u);
  // Ten markers, whichever comes first.
  for (const char* name : {"z2.0@markers=10,id=245", "z2.0@id=245,markers=10"}) {
    const Scene markers = make_scene(name);
    BOOST_REQUIRE(markers.squares.size() == 9u);
    BOOST_TEST(markers.squares[0].word == marker_word(246));
    BOOST_TEST(markers.squares[8].word == marker_word(4));
  }
  BOOST_TEST(make_scene("z2.0@markers=10,squares=2").squares[0].word == plain_square_word);
  // The middle of the marker lies in the middle of the picture.
  const auto corners = ground_truth(make_scene("front3@distance=1500mm")).corners_px;
  const Camera camera;
  BOOST_TEST(std::abs((corners[0].x + corners[2].x) / 2 - camera.cx) < 1e-9);
  BOOST_TEST(std::abs((corners[0].y + corners[2].y) / 2 - camera.cy) < 1e-9);
  // Each has noise of its own.
  BOOST_TEST(make_scene("z1.0@noise=0.02").seed != make_scene("z1.0@noise=0.03").seed);
}

BOOST_AUTO_TEST_CASE(wrong_conditions_are_refused) {
  check_refused([] { make_scene("demo@nose=0.02"); }, "did you mean 'noise'?");
  check_refused([] { make_scene("demo@"); }, "is no condition: there are blur, distance");
  check_refused([] { make_scene("demo@noise"); }, "as in 'demo@distance=2m,noise=0.02'");
  check_refused([] { make_scene("demo@distance=2"); }, "distance: '2' has no unit");
  check_refused([] { make_scene("demo@noise=much"); }, "noise: 'much'");
  check_refused([] { make_scene("demo@markers=16"); }, "no whole number from 1 to 15");
  check_refused([] { make_scene("demo@squares=16"); }, "no whole number from 1 to 15");
  check_refused([] { make_scene("demo@id=1.5"); }, "no whole number from 0 to 249");
  check_refused([] { make_scene("demo@light=2"); }, "brightness");
  check_refused([] { make_scene("demo@noise=-1"); }, "noise is");
  check_refused([] { make_scene("demo@distance=-1m"); }, "");
  check_refused([] { make_scene("demo@yaw=120deg"); }, "back");
  check_refused([] { make_scene("dmo@noise=0.1"); }, "did you mean 'demo'");
}

BOOST_AUTO_TEST_CASE(unknown_names_are_refused_with_the_nearest) {
  check_refused([] { make_scene("squres15"); }, "did you mean 'squares15'");
  check_refused([] { make_scene("squares16"); }, "unknown scene 'squares16'");
  check_refused([] { make_scene(""); }, "unknown scene ''");
  check_refused([] { make_scene("a picture of my cat"); }, "'markervp scenes' lists all");
  BOOST_TEST(!is_scene("front250"));
  BOOST_TEST(!is_scene("x"));
}

BOOST_AUTO_TEST_SUITE_END()
