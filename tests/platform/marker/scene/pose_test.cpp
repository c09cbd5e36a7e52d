#include <boost/test/unit_test.hpp>
#include <cmath>

#include <marker/scene/pose.h>

#include "scene_kit.h"

using namespace platform;
using scene_kit::check_refused;

namespace {

void check_point(const PixelPoint& point, double x, double y) {
  BOOST_TEST(std::abs(point.x - x) < 1e-9);
  BOOST_TEST(std::abs(point.y - y) < 1e-9);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(pose)

BOOST_AUTO_TEST_CASE(quarter_turns_are_exact) {
  const Eigen::Matrix3d quarter = rotation_z(90);
  BOOST_TEST((quarter == Eigen::Matrix3d{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}));
  BOOST_TEST((rotation_z(360) == Pose{}.rotation));
  BOOST_TEST((rotation_x(90) * Eigen::Vector3d{0, 1, 0} == Eigen::Vector3d{0, 0, 1}));
  BOOST_TEST((rotation_y(90) * Eigen::Vector3d{0, 0, 1} == Eigen::Vector3d{1, 0, 0}));
}

BOOST_AUTO_TEST_CASE(corners_of_a_front_view) {
  const auto corners = project_marker({}, {Pose{}.rotation, {0, 0, 1}});
  const double side = 381.36 * 0.3;  // 114.408 px
  check_point(corners[0], 320, 240);
  check_point(corners[1], 320 + side, 240);
  check_point(corners[2], 320 + side, 240 + side);
  check_point(corners[3], 320, 240 + side);
}

BOOST_AUTO_TEST_CASE(corners_after_a_quarter_roll) {
  // The marker's own right becomes the image's down.
  const auto corners = project_marker({}, {rotation_z(90), {0, 0, 1}});
  const double side = 381.36 * 0.3;
  check_point(corners[0], 320, 240);
  check_point(corners[1], 320, 240 + side);
  check_point(corners[2], 320 - side, 240 + side);
  check_point(corners[3], 320 - side, 240);
}

BOOST_AUTO_TEST_CASE(corners_after_60_degrees_of_yaw) {
  // Ry(60) moves the right edge to x = 0.15 m, z = 1 - 0.15 * sqrt(3) m.
  const auto corners = project_marker({}, {rotation_y(60), {0, 0, 1}});
  const double z = 1 - 0.15 * std::sqrt(3.0);
  check_point(corners[0], 320, 240);
  check_point(corners[1], 320 + 381.36 * 0.15 / z, 240);
  check_point(corners[2], 320 + 381.36 * 0.15 / z, 240 + 381.36 * 0.3 / z);
  check_point(corners[3], 320, 240 + 381.36 * 0.3);
}

BOOST_AUTO_TEST_CASE(corners_after_30_degrees_of_pitch) {
  // Rx(30) moves the lower edge to y = 0.15 * sqrt(3) m, z = 1.15 m.
  const auto corners = project_marker({}, {rotation_x(30), {0, 0, 1}});
  check_point(corners[1], 320 + 381.36 * 0.3, 240);
  check_point(corners[2], 320 + 381.36 * 0.3 / 1.15, 240 + 381.36 * 0.15 * std::sqrt(3.0) / 1.15);
  check_point(corners[3], 320, 240 + 381.36 * 0.15 * std::sqrt(3.0) / 1.15);
}

BOOST_AUTO_TEST_CASE(a_pose_can_be_given_by_its_centre) {
  const Pose pose = pose_from_centre(rotation_z(180), {0.1, 0.2, 2});
  const Eigen::Vector3d centre = transform(pose, {0.15, 0.15, 0});
  BOOST_TEST(std::abs(centre[0] - 0.1) < 1e-15);
  BOOST_TEST(std::abs(centre[1] - 0.2) < 1e-15);
  BOOST_TEST(std::abs(centre[2] - 2) < 1e-15);
}

BOOST_AUTO_TEST_CASE(the_camera_stands_above_a_pitched_marker) {
  const Eigen::Vector3d camera = camera_position({rotation_x(30), {0, 0, 1}});
  BOOST_TEST(std::abs(camera[0]) < 1e-15);
  BOOST_TEST(std::abs(camera[1] + 0.5) < 1e-15);
  BOOST_TEST(std::abs(camera[2] + std::sqrt(0.75)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(errors_between_poses) {
  const Pose a{rotation_x(20), {0, 0, 1}};
  const Pose b{rotation_x(20) * rotation_z(35), {0.003, 0.004, 1}};
  BOOST_TEST(std::abs(rotation_error_deg(a, b) - 35) < 1e-9);
  BOOST_TEST(std::abs(rotation_error_deg(b, a) - 35) < 1e-9);
  BOOST_TEST(std::abs(translation_error_mm(a, b) - 5) < 1e-9);
  BOOST_TEST(rotation_error_deg(a, a) < 1e-9);
  BOOST_TEST(translation_error_mm(a, a) == 0);
  const Pose opposite{rotation_x(20) * rotation_y(180), {0, 0, 1}};
  BOOST_TEST(std::abs(rotation_error_deg(a, opposite) - 180) < 1e-6);
}

BOOST_AUTO_TEST_CASE(a_small_rotation_error_keeps_its_digits) {
  const Pose a;
  const Pose b{rotation_y(1e-6), {0, 0, 1}};
  BOOST_TEST(std::abs(rotation_error_deg(a, b) - 1e-6) < 1e-13);
}

BOOST_AUTO_TEST_CASE(impossible_poses_are_refused) {
  check_refused([] { project_marker({}, {Pose{}.rotation, {0, 0, 0}}); }, "corner 0 lies at Z = 0");
  check_refused([] { project_marker({}, {Pose{}.rotation, {0, 0, -1}}); }, "behind the camera");
  check_refused([] { project_marker({}, {rotation_x(-90), {0, 0, 0.2}}); }, "corner 2 lies at");
  check_refused(
      [] {
        validate(Pose{Eigen::Matrix3d{{1, 0, 0}, {0, 1, 0}, {0, 0, 1.1}}, {0, 0, 1}});
      },
      "not orthonormal");
  check_refused(
      [] {
        validate(Pose{Eigen::Matrix3d{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {0, 0, 1}});
      },
      "mirrors");
  check_refused(
      [] {
        validate(Pose{Pose{}.rotation, {0, std::nan(""), 1}});
      },
      "translation is not a number");
}

BOOST_AUTO_TEST_SUITE_END()
