#include <marker/posit.h>
#include <marker/work.h>

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "fake_hal.h"
#include "views.h"

using marker::Camera;
using marker::Pose;
using marker::PositOptions;
using marker::Quad;
using views::angle_between;
using views::rotation_of;
using views::translation_of;
using views::turn;

namespace {

const Camera camera{381.36, 381.36, 320, 240};

/// Corners that a pinhole camera sees, clockwise from the marker's top left.
Quad project(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
             const Camera& with = camera, double side = 0.30) {
  const double model[4][2] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  Quad quad{};
  for (unsigned i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = rotation * Eigen::Vector3d(model[i][0], model[i][1], 0) + translation;
    quad[i] = {with.fx * p.x() / p.z() + with.cx, with.fy * p.y() / p.z() + with.cy};
  }
  return quad;
}

/// To pixel centres, as the corner detector would at best.
Quad rounded(Quad quad) {
  for (auto& p : quad) p = {std::floor(p.x) + 0.5, std::floor(p.y) + 0.5};
  return quad;
}

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(posit, Fixture)

BOOST_AUTO_TEST_CASE(exact_corners_of_many_poses_converge) {
  const PositOptions precise{0.30, 1e-9, 2000};
  for (const double z : {0.8, 1.5, 3.0}) {
    for (const double pitch : {-50.0, -25.0, 20.0, 45.0}) {
      for (const double yaw : {-45.0, -15.0, 30.0}) {
        for (const double roll : {0.0, 30.0, 100.0, 200.0}) {
          const Eigen::Matrix3d rotation = turn(pitch, yaw, roll);
          const Eigen::Vector3d translation(0.1, -0.05, z);
          const Pose pose = marker::estimate_pose(project(rotation, translation), camera, precise);
          BOOST_REQUIRE(pose.valid);
          BOOST_CHECK_SMALL(pose.reprojection_px, 1e-6);
          BOOST_CHECK_SMALL((translation_of(pose) - translation).norm(), 1e-6);
          BOOST_CHECK_SMALL(angle_between(rotation_of(pose), rotation), 1e-4);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(front_view_is_exact_in_one_step) {
  const Pose pose = marker::estimate_pose(
      project(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-0.15, -0.15, 2)), camera, {});
  BOOST_REQUIRE(pose.valid);
  BOOST_TEST(pose.iterations == 1u);
  BOOST_CHECK_SMALL((translation_of(pose) - Eigen::Vector3d(-0.15, -0.15, 2)).norm(), 1e-6);
  BOOST_CHECK_SMALL(angle_between(rotation_of(pose), Eigen::Matrix3d::Identity()), 0.01);
}

BOOST_AUTO_TEST_CASE(rotations_are_proper) {
  for (int n = 0; n < 100; ++n) {
    const Eigen::Matrix3d rotation = turn(n % 7 * 9 - 27, n % 5 * 12 - 24, n * 3.7);
    const Pose pose = marker::estimate_pose(
        rounded(project(rotation, Eigen::Vector3d(0.01 * (n % 9), 0.02, 1 + 0.03 * n))), camera,
        {});
    BOOST_REQUIRE(pose.valid);
    const Eigen::Matrix3d r = rotation_of(pose);
    BOOST_CHECK_SMALL((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    BOOST_CHECK_CLOSE(r.determinant(), 1.0, 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(rounded_corners_give_the_accuracy_of_the_thesis) {
  double translation_error = 0;
  double worst_px = 0;
  int count = 0;
  for (double z = 1; z <= 4; z += 0.25) {
    for (const double roll : {0.0, 15.0, 30.0}) {
      const Eigen::Vector3d translation(-0.12, -0.1, z);
      const Eigen::Matrix3d rotation = turn(20, 10, roll);
      const Pose pose = marker::estimate_pose(rounded(project(rotation, translation)), camera, {});
      BOOST_REQUIRE(pose.valid);
      worst_px = std::max(worst_px, pose.reprojection_px);
      translation_error += (translation_of(pose) - translation).norm();
      ++count;
    }
  }
  BOOST_TEST(worst_px < 2.0);
  BOOST_TEST(translation_error / count < 0.1);
}

BOOST_AUTO_TEST_CASE(focal_lengths_may_differ) {
  const Camera wide{500, 400, 300, 260};
  const Eigen::Matrix3d rotation = turn(30, -20, 10);
  const Eigen::Vector3d translation(0.05, 0.1, 1.2);
  const Pose pose =
      marker::estimate_pose(project(rotation, translation, wide), wide, {0.30, 1e-9, 2000});
  BOOST_CHECK_SMALL((translation_of(pose) - translation).norm(), 1e-6);
}

BOOST_AUTO_TEST_CASE(translation_scales_with_the_side) {
  const Quad quad = project(turn(20, 10, 5), Eigen::Vector3d(0, 0, 1));
  const Pose one = marker::estimate_pose(quad, camera, {0.30, 2, 100});
  const Pose two = marker::estimate_pose(quad, camera, {0.60, 2, 100});
  BOOST_CHECK_CLOSE(two.translation[2], 2 * one.translation[2], 1e-9);
  BOOST_CHECK_CLOSE(two.reprojection_mm, 2 * one.reprojection_mm, 1e-6);
}

BOOST_AUTO_TEST_CASE(errors_in_pixels_and_millimetres_agree) {
  // Fronto-parallel at 2 m: one pixel is 2000 / 381.36 mm.
  Quad quad = project(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-0.15, -0.15, 2));
  quad[2].x += 3;
  const Pose pose = marker::estimate_pose(quad, camera, {});
  BOOST_REQUIRE(pose.valid);
  BOOST_TEST(pose.reprojection_px > 0.1);
  BOOST_CHECK_CLOSE(pose.reprojection_mm, pose.reprojection_px * 2000 / 381.36, 10);
}

BOOST_AUTO_TEST_CASE(limit_ends_the_iteration) {
  const Quad quad = project(turn(40, 30, 5), Eigen::Vector3d(0, 0, 0.6));
  const Pose pose = marker::estimate_pose(quad, camera, {0.30, 0, 7});
  BOOST_REQUIRE(pose.valid);
  BOOST_TEST(pose.iterations == 7u);
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::posit_iterations)] <=
             15u);
}

/// A marker rolled by 30 degrees at 1 m, as FAST finds its corners: the error starts at 2.1 px and
/// converges at 2.8 px.
BOOST_AUTO_TEST_CASE(corners_that_never_get_good_do_not_take_all_iterations) {
  const Quad found{{{320.5, 241.5}, {417.5, 298.5}, {361.5, 395.5}, {264.5, 338.5}}};
  const Pose pose = marker::estimate_pose(found, camera, {});
  BOOST_REQUIRE(pose.valid);
  BOOST_TEST(pose.iterations < 10u);
  BOOST_TEST(pose.reprojection_px < 2.2, "the best on the way is kept");
  BOOST_TEST(pose.reprojection_px > 2.0);
}

BOOST_AUTO_TEST_CASE(good_enough_corners_take_the_first_step_only) {
  const Pose pose =
      marker::estimate_pose(project(turn(10, 0, 0), Eigen::Vector3d(-0.15, -0.15, 2)), camera, {});
  BOOST_TEST(pose.iterations == 1u);
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::posit_iterations)] ==
             1u);
}

BOOST_AUTO_TEST_CASE(impossible_corners_give_no_pose_and_no_nan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Quad impossible[] = {
      {{{100, 100}, {100, 100}, {100, 100}, {100, 100}}},
      {{{nan, 100}, {200, 100}, {200, 200}, {100, 200}}},
      {{{100, 100}, {infinity, 100}, {200, 200}, {100, 200}}},
  };
  for (const Quad& quad : impossible) {
    const Pose pose = marker::estimate_pose(quad, camera, {});
    BOOST_TEST(!pose.valid);
    for (const double r : pose.rotation) BOOST_TEST(r == 0);
    for (const double t : pose.translation) BOOST_TEST(t == 0);
    BOOST_TEST(pose.reprojection_px == 0);
  }
}

BOOST_AUTO_TEST_CASE(odd_corners_never_give_nan) {
  const Quad odd[] = {
      {{{100, 100}, {200, 100}, {300, 100}, {400, 100}}},  // on a line
      {{{100, 100}, {200, 200}, {200, 100}, {100, 200}}},  // crossed
      {{{100, 200}, {200, 200}, {200, 100}, {100, 100}}},  // mirrored
      {{{100, 100}, {200, 100}, {120, 110}, {100, 200}}},  // concave
      {{{100, 100}, {100, 100}, {200, 200}, {100, 200}}},  // two coincide
      {{{0, 0}, {1e9, 0}, {1e9, 1e-9}, {0, 1e9}}},
  };
  for (const Quad& quad : odd) {
    const Pose pose = marker::estimate_pose(quad, camera, {});
    for (const double r : pose.rotation) BOOST_TEST(std::isfinite(r));
    for (const double t : pose.translation) BOOST_TEST(std::isfinite(t));
    BOOST_TEST(std::isfinite(pose.reprojection_px));
    BOOST_TEST(std::isfinite(pose.reprojection_mm));
    if (pose.valid) BOOST_TEST(pose.translation[2] > 0);
  }
}

BOOST_AUTO_TEST_CASE(camera_without_focal_length_gives_no_pose) {
  const Quad quad = project(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 1));
  BOOST_TEST(!marker::estimate_pose(quad, {0, 381, 320, 240}, {}).valid);
  BOOST_TEST(!marker::estimate_pose(quad, {381, 0, 320, 240}, {}).valid);
  BOOST_TEST(!marker::estimate_pose(quad, camera, {0, 2, 100}).valid);
}

BOOST_AUTO_TEST_SUITE_END()
