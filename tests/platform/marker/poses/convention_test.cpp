// Conventions of others, against what their libraries say of the same picture.
#include <apriltag/apriltag.h>
#include <apriltag/apriltag_pose.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>

#include <marker/poses/convention.h>
#include <Eigen/Dense>

using namespace platform;

namespace {

constexpr double side_m = 0.1;
constexpr double near_px = 0.6, near_m = 0.004, near_turn = 0.01;

/// A marker from the front, 200 px wide, its own top left corner at (100, 60), and the same as
/// result.json has it.
struct Picture {
  explicit Picture(int dictionary, const std::string& family) : found{"3", family, side_m} {
    const auto words = cv::aruco::getPredefinedDictionary(dictionary);
    cv::Mat marker;
    cv::aruco::drawMarker(words, 3, 200, marker, 1);
    marker.copyTo(pixels(cv::Rect(100, 60, 200, 200)));
    found.corners_px = {{{100, 60}, {300, 60}, {300, 260}, {100, 260}}};
    found.pose = Pose{};
    found.pose->translation =
        Eigen::Vector3d((100 - camera.cx) / 200, (60 - camera.cy) / 200, camera.fx / 200) * side_m;
  }

  Camera camera;
  cv::Mat pixels{480, 640, CV_8UC1, cv::Scalar(255)};
  poses::FoundPose found;
};

const poses::Convention& convention(const std::string& name) {
  const auto& all = poses::conventions();
  return *std::find_if(all.begin(), all.end(), [&](const auto& one) { return name == one.name; });
}

void check_corner(const PixelPoint& ours, double x, double y) {
  BOOST_TEST(std::abs(ours.x - x) < near_px, ours.x << " for " << x);
  BOOST_TEST(std::abs(ours.y - y) < near_px, ours.y << " for " << y);
}

void check_pose(const Pose& ours, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& middle) {
  BOOST_TEST((ours.rotation - rotation).norm() < near_turn, ours.rotation << "\nfor\n" << rotation);
  BOOST_TEST((ours.translation - middle).norm() < near_m, ours.translation << "\nfor\n" << middle);
}

/// AprilTag's own family, and its own pose.
struct AprilTag {
  explicit AprilTag(Picture& picture) {
    apriltag_detector_add_family(detector, family);
    image_u8_t image{640, 480, 640, picture.pixels.data};
    all = apriltag_detector_detect(detector, &image);
    BOOST_TEST_REQUIRE(zarray_size(all) == 1);
    zarray_get(all, 0, static_cast<void*>(&tag));
    const Camera& camera = picture.camera;
    apriltag_detection_info_t view{tag, side_m, camera.fx, camera.fy, camera.cx, camera.cy};
    apriltag_pose_t pose{};
    estimate_tag_pose(&view, &pose);
    for (unsigned row = 0; row < 3; ++row) {
      for (unsigned column = 0; column < 3; ++column)
        rotation(row, column) = MATD_EL(pose.R, row, column);
      middle[row] = MATD_EL(pose.t, row, 0);
    }
    std::free(pose.R);
    std::free(pose.t);
  }
  ~AprilTag() {
    apriltag_detections_destroy(all);
    apriltag_detector_destroy(detector);
    tag36h11_destroy(family);
  }
  AprilTag(const AprilTag&) = delete;
  AprilTag& operator=(const AprilTag&) = delete;

  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  zarray_t* all = nullptr;
  apriltag_detection_t* tag = nullptr;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d middle;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(convention_names)

BOOST_AUTO_TEST_CASE(opencv_is_what_opencv_says_of_the_same_picture) {
  const Picture picture(cv::aruco::DICT_4X4_250, "4x4_250");
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(
      picture.pixels, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_250), corners, ids);
  BOOST_TEST_REQUIRE(ids.size() == 1u);
  const Camera& camera = picture.camera;
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Vec3d> turns, shifts;
  cv::aruco::estimatePoseSingleMarkers(corners, side_m, matrix, cv::noArray(), turns, shifts);
  const poses::FoundPose ours = poses::in_convention(convention("opencv"), picture.found);
  for (std::size_t i = 0; i < 4; ++i)
    check_corner(ours.corners_px[i], corners[0][i].x, corners[0][i].y);
  cv::Matx33d rotation;
  cv::Rodrigues(turns[0], rotation);
  const Eigen::Matrix3d theirs = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(rotation.val);
  check_pose(*ours.pose, theirs, {shifts[0][0], shifts[0][1], shifts[0][2]});
}

BOOST_AUTO_TEST_CASE(apriltag_is_what_apriltag_says_of_the_same_picture) {
  Picture picture(cv::aruco::DICT_APRILTAG_36h11, "apriltag_36h11");
  const AprilTag theirs(picture);
  const poses::FoundPose ours = poses::in_convention(convention("apriltag"), picture.found);
  for (std::size_t i = 0; i < 4; ++i)
    check_corner(ours.corners_px[i], theirs.tag->p[i][0], theirs.tag->p[i][1]);
  check_pose(*ours.pose, theirs.rotation, theirs.middle);
}

BOOST_AUTO_TEST_CASE(ros_is_what_its_node_makes_of_apriltags_corners) {
  Picture picture(cv::aruco::DICT_APRILTAG_36h11, "apriltag_36h11");
  const AprilTag theirs(picture);
  const poses::FoundPose ours = poses::in_convention(convention("ros"), picture.found);
  // apriltag_ros, pose_estimation.cpp: the corners are (-, -), (+, -), (+, +), (-, +).
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> points;
  constexpr double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    check_corner(ours.corners_px[i], theirs.tag->p[i][0], theirs.tag->p[i][1]);
    places.emplace_back(signs[i][0] * side_m / 2, signs[i][1] * side_m / 2, 0);
    points.emplace_back(theirs.tag->p[i][0], theirs.tag->p[i][1]);
  }
  const Camera& camera = picture.camera;
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Vec3d turn, shift;
  cv::Matx33d rotation;
  cv::solvePnP(places, points, matrix, cv::noArray(), turn, shift);
  cv::Rodrigues(turn, rotation);
  check_pose(*ours.pose, Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(rotation.val),
             {shift[0], shift[1], shift[2]});
}

BOOST_AUTO_TEST_CASE(only_apriltags_families_are_turned) {
  Picture picture(cv::aruco::DICT_4X4_250, "4x4_250");
  const poses::FoundPose upright = poses::in_convention(convention("apriltag"), picture.found);
  check_corner(upright.corners_px[0], 100, 260);
  picture.found.family = "apriltag_36h11";
  const poses::FoundPose turned = poses::in_convention(convention("apriltag"), picture.found);
  check_corner(turned.corners_px[0], 300, 60);
}

BOOST_AUTO_TEST_CASE(a_covariance_follows_to_the_middle) {
  Picture picture(cv::aruco::DICT_4X4_250, "4x4_250");
  const double turn[3] = {0.01, -0.02, 0.03}, shift[3] = {0.1, 0.2, -0.3};
  const double both[6] = {turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]};
  picture.found.covariance.emplace();
  for (std::size_t i = 0; i < 36; ++i) (*picture.found.covariance)[i] = both[i / 6] * both[i % 6];
  const poses::FoundPose ours = poses::in_convention(convention("opencv"), picture.found);
  // The middle is half a side right and below: the camera's axes are the marker's.
  const Eigen::Vector3d moved =
      Eigen::Vector3d(shift[0], shift[1], shift[2]) +
      Eigen::Vector3d(turn[0], turn[1], turn[2]).cross(Eigen::Vector3d(side_m / 2, side_m / 2, 0));
  const double expected[6] = {moved.x(), moved.y(), moved.z(), turn[0], turn[1], turn[2]};
  for (std::size_t i = 0; i < 36; ++i)
    BOOST_TEST(std::abs((*ours.covariance)[i] - expected[i / 6] * expected[i % 6]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_board_keeps_its_frame) {
  Picture picture(cv::aruco::DICT_4X4_250, "");
  const poses::FoundPose ours = poses::in_convention(convention("ros"), picture.found);
  BOOST_TEST((ours.pose->rotation == picture.found.pose->rotation));
  BOOST_TEST((ours.pose->translation == picture.found.pose->translation));
}

BOOST_AUTO_TEST_SUITE_END()
