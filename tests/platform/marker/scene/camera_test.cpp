#include <boost/test/unit_test.hpp>
#include <limits>

#include <marker/scene/pose.h>

#include "scene_kit.h"

using platform::Camera;
using scene_kit::check_refused;

BOOST_AUTO_TEST_SUITE(camera)

BOOST_AUTO_TEST_CASE(the_default_is_the_thesis_camera) {
  const Camera camera;
  BOOST_TEST(camera.width == 640);
  BOOST_TEST(camera.height == 480);
  BOOST_TEST(camera.fx == 381.36);
  BOOST_TEST(camera.fy == 381.36);
  BOOST_TEST(camera.cx == 320.0);
  BOOST_TEST(camera.cy == 240.0);
}

BOOST_AUTO_TEST_CASE(another_resolution_keeps_the_field_of_view) {
  const Camera camera = Camera::for_resolution(1280, 720);
  BOOST_TEST(camera.width == 1280);
  BOOST_TEST(camera.height == 720);
  BOOST_TEST(camera.fx == 2 * 381.36);
  BOOST_TEST(camera.fy == 2 * 381.36);
  BOOST_TEST(camera.cx == 640.0);
  BOOST_TEST(camera.cy == 360.0);
}

BOOST_AUTO_TEST_CASE(impossible_cameras_are_refused) {
  check_refused([] { Camera::for_resolution(0, 480); }, "camera width is 0 px");
  check_refused([] { Camera::for_resolution(640, -1); }, "camera height is -1 px");
  check_refused([] { Camera::for_resolution(640, 16385); }, "camera height is 16385 px");
  Camera camera;
  camera.fx = 0;
  check_refused([&] { validate(camera); }, "focal length fx");
  camera = Camera{};
  camera.fy = -381.36;
  check_refused([&] { validate(camera); }, "focal length fy");
  camera.fy = std::numeric_limits<double>::infinity();
  check_refused([&] { validate(camera); }, "focal length fy");
  camera = Camera{};
  camera.cx = std::numeric_limits<double>::quiet_NaN();
  check_refused([&] { validate(camera); }, "principal point");
}

BOOST_AUTO_TEST_SUITE_END()
