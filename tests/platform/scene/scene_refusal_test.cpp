#include <boost/test/unit_test.hpp>
#include <cmath>

#include <scene/catalogue.h>
#include <scene/renderer.h>

#include "scene_kit.h"

using namespace platform;

namespace {

/// Changes the scene x0.0 and checks that it can no longer be rendered, nor its truth told.
template <typename Change>
void check_change_refused(Change change, const std::string& part) {
  Scene scene = make_scene("x0.0");
  validate(scene);
  change(scene);
  scene_kit::check_refused([&] { render(scene); }, part);
  scene_kit::check_refused([&] { ground_truth(scene); }, part);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scene_refusals)

BOOST_AUTO_TEST_CASE(camera_and_pose) {
  check_change_refused([](Scene& s) { s.camera.width = 0; }, "camera width");
  check_change_refused([](Scene& s) { s.pose.translation = {0, 0, 0}; }, "Z = 0");
  check_change_refused([](Scene& s) { s.pose.translation = {0, 0, -2}; }, "behind the camera");
  check_change_refused([](Scene& s) { s.pose.rotation = rotation_y(180); }, "marker's back");
  check_change_refused([](Scene& s) { s.pose.rotation.setZero(); }, "not orthonormal");
  check_change_refused([](Scene& s) { s.pose.translation = {0, -2, 2}; }, "outside the room");
  check_change_refused([](Scene& s) { s.pose.translation = {5, 0, 2}; }, "outside the room");
}

BOOST_AUTO_TEST_CASE(marker_and_squares) {
  check_change_refused([](Scene& s) { s.marker_id = 250; }, "marker ID 250");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{0.5, 0, 0.3, plain_square_word}};
      },
      "square 1 overlaps the marker");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{0.62, 0, 0.3, plain_square_word}, {1.0, 0, 0.3, plain_square_word}};
      },
      "square 2 overlaps square 1");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{1, 0, 0, plain_square_word}};
      },
      "no place or size");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{1, std::nan(""), 0.3, plain_square_word}};
      },
      "no place or size");
}

BOOST_AUTO_TEST_CASE(light_and_noise) {
  check_change_refused([](Scene& s) { s.brightness.wall = 1.5; }, "brightness of the wall is 1.5");
  check_change_refused([](Scene& s) { s.brightness.black = -0.1; }, "brightness of black");
  check_change_refused([](Scene& s) { s.noise_sigma = -0.1; }, "noise is -0.1");
  check_change_refused([](Scene& s) { s.noise_sigma = std::nan(""); }, "noise is");
  check_change_refused([](Scene& s) { s.blur_sigma_px = 101; }, "blur is 101");
  check_change_refused([](Scene& s) { s.room.wall_w = -1; }, "inside out");
}

BOOST_AUTO_TEST_SUITE_END()
