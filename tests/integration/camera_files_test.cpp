// A camera calibration changes the poses as optics demands, and nothing else.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/persistence.hpp>
#include <opencv2/imgproc.hpp>

#include "executable.h"
#include "pictures.h"

using namespace integration;

namespace {

constexpr double thesis_focal_length_px = 381.36;

struct Lens {
  double focal_length = thesis_focal_length_px;
  double cx = 319.5;  ///< px; files put the centre of the first pixel at (0, 0)
  double cy = 239.5;
  std::vector<double> distortion{0, 0, 0, 0, 0};
};

void write_opencv_file(const std::string& path, const Lens& lens) {
  cv::FileStorage file(path, cv::FileStorage::WRITE);
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << lens.focal_length, 0, lens.cx, 0,
                          lens.focal_length, lens.cy, 0, 0, 1);
  file << "calibration_time"
       << "today"
       << "image_width" << 640 << "image_height" << 480 << "camera_matrix" << matrix
       << "distortion_coefficients" << cv::Mat(lens.distortion, true).t();
}

void write_ros_file(const std::string& path, const Lens& lens) {
  const std::string f = std::to_string(lens.focal_length);
  kit::write_file(path,
                  "image_width: 640\nimage_height: 480\ncamera_name: front\n"
                  "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [" +
                      f + ", 0, " + std::to_string(lens.cx) + ", 0, " + f + ", " +
                      std::to_string(lens.cy) +
                      ", 0, 0, 1]\ndistortion_model: plumb_bob\n"
                      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n");
}

/// A picture of the marker at (-0.15, -0.15, 1) m, seen from the front.
struct Picture : Workplace {
  Picture() { write_picture(*this / "front.png", scene_picture("front0")); }

  Json marker(const Arguments& camera = {}) const {
    Arguments all{"front.png", "--quiet", "--no-pictures"};
    all.insert(all.end(), camera.begin(), camera.end());
    const kit::Outcome outcome = run(all);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    err = outcome.err;
    return result()["frames"][0]["markers"][0];
  }

  mutable std::string err;  ///< of the last run
};

double translation(const Json& marker, std::size_t axis) {
  return marker["pose"]["translation_m"][axis];
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(camera_files, Picture)

BOOST_AUTO_TEST_CASE(the_thesis_camera_as_a_file_changes_nothing) {
  const Json usual = marker();
  BOOST_TEST(err.find("no --camera") != std::string::npos, err);
  write_opencv_file(*this / "camera.yaml", {});
  write_opencv_file(*this / "camera.xml", {});
  write_opencv_file(*this / "camera.json", {});
  write_ros_file(*this / "ros.yaml", {});
  for (const char* file : {"camera.yaml", "camera.xml", "camera.json", "ros.yaml"}) {
    BOOST_TEST(marker({"--camera", file}) == usual, file);
    BOOST_TEST(err == "", err);
  }
}

BOOST_AUTO_TEST_CASE(double_focal_length_doubles_the_distance) {
  const Json usual = marker();
  Lens lens;
  lens.focal_length *= 2;
  write_opencv_file(*this / "tele.yaml", lens);
  write_ros_file(*this / "tele_ros.yaml", lens);
  for (const char* file : {"tele.yaml", "tele_ros.yaml"}) {
    const Json found = marker({"--camera", file});
    BOOST_TEST(found["corners_px"] == usual["corners_px"]);
    BOOST_TEST(translation(found, 2) == 2 * translation(usual, 2),
               boost::test_tools::tolerance(0.02));
    BOOST_TEST(translation(found, 0) == translation(usual, 0), boost::test_tools::tolerance(0.02));
    BOOST_TEST(translation(found, 1) == translation(usual, 1), boost::test_tools::tolerance(0.02));
  }
}

BOOST_AUTO_TEST_CASE(another_principal_point_moves_the_marker_sideways) {
  const Json usual = marker();
  Lens lens;
  lens.cx += 40;
  lens.cy -= 20;
  write_opencv_file(*this / "off.yaml", lens);
  const Json found = marker({"--camera", "off.yaml"});
  const double metres_per_px = translation(usual, 2) / thesis_focal_length_px;
  BOOST_TEST(std::abs(translation(found, 0) - translation(usual, 0) + 40 * metres_per_px) < 0.01);
  BOOST_TEST(std::abs(translation(found, 1) - translation(usual, 1) - 20 * metres_per_px) < 0.01);
}

BOOST_AUTO_TEST_CASE(lens_distortion_is_told) {
  Lens lens;
  lens.distortion[0] = -0.2;
  write_opencv_file(*this / "bent.yaml", lens);
  marker({"--camera", "bent.yaml"});
  BOOST_TEST(err.find("lens distortion") != std::string::npos, err);
}

/// `ideal` as the lens shows it.
cv::Mat bent(const cv::Mat& ideal, const Lens& lens) {
  const cv::Matx33d camera(lens.focal_length, 0, lens.cx, 0, lens.focal_length, lens.cy, 0, 0, 1);
  std::vector<cv::Point2f> seen, from;
  for (int y = 0; y < ideal.rows; ++y) {
    for (int x = 0; x < ideal.cols; ++x)
      seen.emplace_back(static_cast<float>(x), static_cast<float>(y));
  }
  cv::undistortPoints(seen, from, camera, lens.distortion, cv::noArray(), camera);
  cv::Mat picture;
  cv::remap(ideal, picture, cv::Mat(from, true).reshape(2, ideal.rows), cv::noArray(),
            cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return picture;
}

BOOST_AUTO_TEST_CASE(a_design_that_corrects_the_lens_finds_the_same_pose_through_it) {
  const Json usual = marker({"--design", "improved"});
  Lens lens;
  lens.distortion = {-0.3, 0.1, 0.002, -0.001, 0.02};
  write_picture(*this / "front.png", bent(scene_picture("front0"), lens));
  write_opencv_file(*this / "bent.yaml", lens);
  const auto off_mm = [&](const Json& found) {
    double squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double off = translation(found, axis) - translation(usual, axis);
      squares += off * off;
    }
    return 1000 * std::sqrt(squares);
  };
  // The pixels were resampled: a hundredth of a pixel of the side is 0.1 mm.
  BOOST_TEST(off_mm(marker({"--design", "improved", "--camera", "bent.yaml"})) < 1);
  BOOST_TEST(err == "", err);
  BOOST_TEST(off_mm(marker({"--design", "improved"})) > 3);
}

/// The scene is rendered as that camera sees it, so its truth still fits.
BOOST_AUTO_TEST_CASE(scenes_are_seen_through_the_camera_of_the_file) {
  Lens lens;
  lens.focal_length = 600;
  write_opencv_file(*this / "camera.yaml", lens);
  BOOST_TEST(run({"z1.5", "--camera", "camera.yaml", "--quiet"}).exit_code == 0);
  const Json found = result()["frames"][0]["markers"][0];
  BOOST_TEST(found["truth"]["corners_px"][1][0] == 320 + 600 * 0.3 / 1.5);
  BOOST_TEST(found["error"]["corner_px"] < 3);
}

BOOST_AUTO_TEST_SUITE_END()
