#include <marker/board_pose.h>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "fake_hal.h"
#include "views.h"

using marker::BoardPose;
using marker::BoardPoses;
using marker::Camera;
using marker::CharucoBoard;
using marker::GridBoard;
using marker::Places;
using marker::SeenMarker;
using views::angle_between;
using views::rotation_of;
using views::turn;

namespace {

const Camera camera{381.36, 380, 320, 240};

marker::CornerWeights weights_of(double sigma) {
  return marker::weights_of(marker::independent_corners(sigma));
}

SeenMarker seen(const Places& places, const Eigen::Matrix3d& rotation,
                const Eigen::Vector3d& translation, double sigma = 0.02) {
  SeenMarker marker{places, {}, weights_of(sigma), {}};
  for (unsigned i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = rotation * Eigen::Vector3d(places[i].data()) + translation;
    marker.corners[i] = {camera.fx * p.x() / p.z() + camera.cx,
                         camera.fy * p.y() / p.z() + camera.cy};
  }
  return marker;
}

double distance(const BoardPose& pose, const Eigen::Vector3d& translation) {
  return (views::translation_of(pose) - translation).norm();
}

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(board_pose, Fixture)

BOOST_AUTO_TEST_CASE(exact_corners_give_the_exact_pose) {
  for (int pitch = -60; pitch <= 60; pitch += 20) {
    for (int yaw = -60; yaw <= 60; yaw += 20) {
      for (int roll = 0; roll < 360; roll += 45) {
        const Eigen::Matrix3d rotation = turn(pitch, yaw, roll);
        const Eigen::Vector3d translation(0.2, -0.1, 1.5);
        const SeenMarker marker = seen(marker::single_marker(0.3), rotation, translation);
        const BoardPoses poses = marker::estimate_board_pose(&marker, 1, camera);
        BOOST_REQUIRE(poses.valid);
        BOOST_TEST(angle_between(rotation_of(poses.best), rotation) < 1e-4);
        BOOST_TEST(distance(poses.best, translation) < 1e-6);
        BOOST_TEST(poses.best.chi_squared < 1e-6);
        BOOST_TEST(poses.other.chi_squared >= poses.best.chi_squared);
      }
    }
  }
}

// Seen exactly from the front both solutions are one, and the tilt is what is known least.
BOOST_AUTO_TEST_CASE(from_the_front) {
  const SeenMarker marker = seen(marker::single_marker(0.3), turn(0, 0, 0), {-0.15, -0.15, 2});
  const BoardPoses poses = marker::estimate_board_pose(&marker, 1, camera);
  BOOST_REQUIRE(poses.valid);
  BOOST_TEST(angle_between(rotation_of(poses.best), turn(0, 0, 0)) < 1e-3);
  BOOST_TEST(distance(poses.best, {-0.15, -0.15, 2}) < 1e-6);
  BOOST_TEST(poses.best.covariance[0] > 20 * poses.best.covariance[14]);
  BOOST_TEST(poses.best.covariance[35] > 20 * poses.best.covariance[21]);
}

// A small marker that is tilted a little: both solutions explain the corners, and this is reported.
BOOST_AUTO_TEST_CASE(the_other_solution) {
  const SeenMarker marker =
      seen(marker::single_marker(0.3), turn(0, 12, 0), {-0.15, -0.15, 4}, 0.5);
  const BoardPoses poses = marker::estimate_board_pose(&marker, 1, camera);
  BOOST_REQUIRE(poses.valid);
  BOOST_TEST(angle_between(rotation_of(poses.best), turn(0, 12, 0)) < 1e-3);
  BOOST_TEST(angle_between(rotation_of(poses.other), turn(0, 12, 0)) > 10);
  BOOST_TEST(poses.other.chi_squared < 2);
  // Near and tilted more, only one does.
  const SeenMarker near = seen(marker::single_marker(0.3), turn(0, 40, 0), {-0.15, -0.15, 1}, 0.5);
  const BoardPoses clear = marker::estimate_board_pose(&near, 1, camera);
  BOOST_TEST(clear.other.chi_squared > 100);
}

// σ of the corners scales the covariance, and nothing else.
BOOST_AUTO_TEST_CASE(covariance_follows_that_of_the_corners) {
  const SeenMarker fine = seen(marker::single_marker(0.3), turn(20, 30, 10), {0, 0, 1}, 0.01);
  SeenMarker coarse = fine;
  coarse.weights = weights_of(0.03);
  const BoardPoses a = marker::estimate_board_pose(&fine, 1, camera);
  const BoardPoses b = marker::estimate_board_pose(&coarse, 1, camera);
  for (unsigned i = 0; i < 36; ++i) {
    BOOST_TEST(b.best.covariance[i] == 9 * a.best.covariance[i],
               boost::test_tools::tolerance(1e-6));
  }
}

// A corner that is known badly may be wrong without harm.
BOOST_AUTO_TEST_CASE(corners_count_as_far_as_they_are_known) {
  const Eigen::Matrix3d rotation = turn(25, -20, 5);
  SeenMarker marker = seen(marker::single_marker(0.3), rotation, {0, 0, 1}, 0.01);
  marker.corners[2].x += 1;
  const BoardPoses trusting = marker::estimate_board_pose(&marker, 1, camera);
  std::array<double, 64> covariance = marker::independent_corners(0.01);
  covariance[4 * 9] = 100;
  marker.weights = marker::weights_of(covariance);
  const BoardPoses wary = marker::estimate_board_pose(&marker, 1, camera);
  BOOST_TEST(angle_between(rotation_of(trusting.best), rotation) > 0.2);
  BOOST_TEST(angle_between(rotation_of(wary.best), rotation) < 0.01);
}

BOOST_AUTO_TEST_CASE(a_grid_board_as_a_whole) {
  const GridBoard board{3, 2, 0.06, 0.02, 10};
  Places places{};
  BOOST_TEST(!board.find(9, places));
  BOOST_TEST(!board.find(16, places));
  BOOST_REQUIRE(board.find(14, places));
  BOOST_TEST(places[0][0] == 0.08);
  BOOST_TEST(places[0][1] == 0.08);
  BOOST_TEST(places[2][0] == 0.14);
  BOOST_TEST(places[2][1] == 0.14);

  const Eigen::Matrix3d rotation = turn(-10, 25, 70);
  const Eigen::Vector3d translation(0.05, -0.02, 0.6);
  std::vector<SeenMarker> markers;
  for (std::uint32_t id = 10; id < 16; ++id) {
    board.find(id, places);
    markers.push_back(seen(places, rotation, translation));
  }
  const BoardPoses one = marker::estimate_board_pose(&markers[0], 1, camera);
  const BoardPoses all = marker::estimate_board_pose(markers.data(), 6, camera);
  BOOST_REQUIRE(all.valid);
  BOOST_TEST(angle_between(rotation_of(all.best), rotation) < 1e-4);
  BOOST_TEST(distance(all.best, translation) < 1e-6);
  // Six markers over three times the width: better than the square root of six.
  BOOST_TEST(all.best.covariance[0] * 6 < one.best.covariance[0]);
  BOOST_TEST(all.best.covariance[35] * 6 < one.best.covariance[35]);
}

/// Over many draws of corners, as they are known: the squared error of the pose in deviations of
/// its covariance, and chi_squared, both means.
struct Agreement {
  double pose = 0, corners = 0;
};

/// `told`: the covariance knows that all corners may move outwards together.
Agreement agreement(const std::vector<Places>& board, double common, bool told) {
  constexpr int draws = 300;
  constexpr double sigma = 0.02;
  const Eigen::Matrix3d rotation = turn(-20, 35, 70);
  const Eigen::Vector3d translation(0.05, -0.02, 0.6);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Agreement sum;
  for (int draw = 0; draw < draws; ++draw) {
    const double shift = common * normal(random);
    std::vector<SeenMarker> markers;
    for (const Places& places : board) {
      SeenMarker marker = seen(places, rotation, translation, sigma);
      const marker::Quad corners = marker.corners;
      const marker::Point middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
      for (unsigned i = 0; i < 4; ++i) {
        const marker::Point out = corners[i] - middle;
        const marker::Point way = 1 / std::sqrt(marker::dot(out, out)) * out;
        marker.corners[i].x += shift * way.x + sigma * normal(random);
        marker.corners[i].y += shift * way.y + sigma * normal(random);
        if (told) {
          marker.common[2 * i] = common * way.x;
          marker.common[2 * i + 1] = common * way.y;
        }
      }
      markers.push_back(marker);
    }
    const BoardPoses poses = marker::estimate_board_pose(
        markers.data(), static_cast<std::uint32_t>(markers.size()), camera);
    BOOST_REQUIRE(poses.valid);
    const Eigen::AngleAxisd turned(rotation_of(poses.best) * rotation.transpose());
    Eigen::Matrix<double, 6, 1> error;
    error << turned.angle() * turned.axis(), views::translation_of(poses.best) - translation;
    const Eigen::Map<const Eigen::Matrix<double, 6, 6>> covariance(poses.best.covariance.data());
    sum.pose += error.dot(covariance.ldlt().solve(error)) / draws;
    sum.corners += poses.best.chi_squared / draws;
  }
  return sum;
}

// A camera's curve shifts the edges of all markers alike: more of them do not average it away.
BOOST_AUTO_TEST_CASE(what_all_markers_share_is_in_the_covariance) {
  const GridBoard grid{3, 2, 0.06, 0.02, 0};
  std::vector<Places> board(6);
  for (std::uint32_t id = 0; id < 6; ++id) BOOST_REQUIRE(grid.find(id, board[id]));
  const std::vector<Places> single = {marker::single_marker(0.06)};
  for (const double common : {0.0, 0.02, 0.3}) {
    BOOST_TEST_CONTEXT(common << " px") {
      const Agreement of_one = agreement(single, common, true);
      const Agreement of_all = agreement(board, common, true);
      BOOST_TEST(of_one.pose == 6, boost::test_tools::tolerance(0.15));
      BOOST_TEST(of_all.pose == 6, boost::test_tools::tolerance(0.15));
      BOOST_TEST(of_one.corners == 8 - 6, boost::test_tools::tolerance(0.2));
      BOOST_TEST(of_all.corners == 48 - 6, boost::test_tools::tolerance(0.05));
    }
  }
  const Agreement untold = agreement(board, 0.3, false);
  BOOST_TEST(untold.pose > 60);
  BOOST_TEST(untold.corners > 420);
}

// OpenCV's layout of 7 × 5 squares with markers 0 to 16: three in the first row, four in the next.
BOOST_AUTO_TEST_CASE(places_on_a_charuco_board) {
  const CharucoBoard board{7, 5, 0.03, 0.022, false};
  Places places{};
  const auto at = [&](std::uint32_t id, double u, double v) {
    BOOST_REQUIRE(board.find(id, places));
    BOOST_TEST(places[0][0] == u * 0.03 + 0.004, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(places[0][1] == v * 0.03 + 0.004, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(places[2][0] == u * 0.03 + 0.026, boost::test_tools::tolerance(1e-12));
  };
  at(0, 1, 0);
  at(2, 5, 0);
  at(3, 0, 1);
  at(6, 6, 1);
  at(7, 1, 2);
  at(16, 5, 4);
  BOOST_TEST(!board.find(17, places));
  const CharucoBoard even{7, 4, 0.03, 0.022, true};
  BOOST_REQUIRE(even.find(0, places));
  BOOST_TEST(places[0][0] == 0.004);
  BOOST_REQUIRE(even.find(4, places));
  BOOST_TEST(places[0][0] == 0.034);
  BOOST_TEST(places[0][1] == 0.034);
  BOOST_REQUIRE(even.find(13, places));
  BOOST_TEST(!even.find(14, places));
  BOOST_TEST((!CharucoBoard{0, 5, 0.03, 0.02, false}.find(0, places)));
}

BOOST_AUTO_TEST_CASE(markers_need_not_lie_in_one_plane) {
  Places upright = marker::single_marker(0.1);
  for (auto& place : upright) place = {0.2, place[1], place[0]};
  const Eigen::Matrix3d rotation = turn(10, 50, 0);
  const std::vector<SeenMarker> markers = {seen(marker::single_marker(0.1), rotation, {0, 0, 0.8}),
                                           seen(upright, rotation, {0, 0, 0.8})};
  const BoardPoses poses = marker::estimate_board_pose(markers.data(), 2, camera);
  BOOST_REQUIRE(poses.valid);
  BOOST_TEST(angle_between(rotation_of(poses.best), rotation) < 1e-4);
}

BOOST_AUTO_TEST_CASE(what_admits_no_pose) {
  SeenMarker marker = seen(marker::single_marker(0.3), turn(0, 20, 0), {0, 0, 1});
  BOOST_TEST(!marker::estimate_board_pose(&marker, 0, camera).valid);
  BOOST_TEST(!marker::estimate_board_pose(&marker, 1, {0, 1, 0, 0}).valid);
  SeenMarker point = marker;
  point.corners.fill({100, 100});
  BOOST_TEST(!marker::estimate_board_pose(&point, 1, camera).valid);
  SeenMarker nowhere = marker;
  nowhere.places.fill({0, 0, 0});
  BOOST_TEST(!marker::estimate_board_pose(&nowhere, 1, camera).valid);
  SeenMarker unknown = marker;
  unknown.corners[1].x = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!marker::estimate_board_pose(&unknown, 1, camera).valid);
  SeenMarker certain = marker;
  certain.weights = weights_of(0);
  BOOST_TEST(!marker::estimate_board_pose(&certain, 1, camera).valid);
}

BOOST_AUTO_TEST_SUITE_END()
