#include <input/camera_file.h>

#include <map>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform::input;
using namespace input_test;
using kit::TemporaryFolder;

namespace {

const char* const ros = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [600.5, 0, 319.5, 0, 601.25, 239.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0, 0, 0]
)";

CalibratedCamera read(const TemporaryFolder& folder, const std::string& text) {
  kit::write_file(folder / "camera.yaml", text);
  return read_camera_file(folder / "camera.yaml");
}

void check_camera(const CalibratedCamera& calibrated) {
  BOOST_TEST(calibrated.has_size);
  BOOST_TEST(calibrated.camera.width == 640);
  BOOST_TEST(calibrated.camera.height == 480);
  BOOST_TEST(calibrated.camera.fx == 600.5);
  BOOST_TEST(calibrated.camera.fy == 601.25);
  BOOST_TEST(calibrated.camera.cx == 320.0,
             "half a pixel is added: the file counts from a pixel's centre");
  BOOST_TEST(calibrated.camera.cy == 240.0);
  BOOST_TEST(has_distortion(calibrated));
}

/// What OpenCV's calibration sample writes.
void write_opencv(const std::string& path) {
  cv::FileStorage storage(path, cv::FileStorage::WRITE);
  storage << "calibration_time"
          << "Sat 21 Nov 2026"
          << "image_width" << 640 << "image_height" << 480;
  storage << "camera_matrix"
          << (cv::Mat_<double>(3, 3) << 600.5, 0, 319.5, 0, 601.25, 239.5, 0, 0, 1);
  storage << "distortion_coefficients" << (cv::Mat_<double>(5, 1) << 0.1, -0.2, 0, 0, 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_file)

BOOST_AUTO_TEST_CASE(opencv_files_of_each_kind) {
  const TemporaryFolder folder;
  for (const char* name : {"camera.yml", "camera.xml", "camera.json"}) {
    write_opencv(folder / name);
    check_camera(read_camera_file(folder / name));
  }
}

BOOST_AUTO_TEST_CASE(ros_files) {
  const TemporaryFolder folder;
  check_camera(read(folder, ros));
}

BOOST_AUTO_TEST_CASE(other_spellings) {
  const TemporaryFolder folder;
  const CalibratedCamera calibrated =
      read(folder, "K: [[500, 0, 320], [0, 510, 240], [0, 0, 1]]\nD: [0, 0, 0, 0]\n");
  BOOST_TEST(calibrated.camera.fy == 510.0);
  BOOST_TEST(!calibrated.has_size);
  BOOST_TEST(!has_distortion(calibrated));
  write_opencv(folder / "camera.yml");
  std::string text = kit::read_file(folder / "camera.yml");
  text.replace(text.find("camera_matrix"), 13, "Camera_Matrix");
  kit::write_file(folder / "old.yml", text);
  check_camera(read_camera_file(folder / "old.yml"));
}

BOOST_AUTO_TEST_CASE(the_size_must_be_the_images) {
  const TemporaryFolder folder;
  const CalibratedCamera calibrated = read(folder, ros);
  BOOST_TEST(camera_for(calibrated, {640, 480}).fx == 600.5);
  CHECK_REFUSED(camera_for(calibrated, {1280, 960}), "is for images of 640x480 px, not 1280x960");
  const CalibratedCamera any = read(folder, "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n");
  BOOST_TEST(camera_for(any, {320, 200}).width == 320);
}

BOOST_AUTO_TEST_CASE(bad_files_are_refused) {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> cases{
      {"", "is empty"},
      {"just words", "is malformed"},
      {"a: [1, 2", "is malformed: line 1"},
      {"%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n",
       "camera file"},
      {"%YAML:1.0\n---\n[[[\n", "is malformed"},
      {"<?xml version=\"1.0\"?>\n<opencv_storage>\n<camera_matrix", "is malformed"},
      {"{\"camera_matrix\": ", "is malformed"},
      {"fx: 500\n", "has no camera_matrix"},
      {"camera_matrix: {rows: 2, cols: 2, data: [1, 2, 3, 4]}\n", "not 3x3"},
      {"K: [0, 0, 320, 0, 510, 240, 0, 0, 1]\n", "fx, fy > 0"},
      {"K: [-5, 0, 320, 0, 510, 240, 0, 0, 1]\n", "fx, fy > 0"},
      {"K: [.nan, 0, 320, 0, 510, 240, 0, 0, 1]\n", "fx, fy > 0"},
      {"K: [500, 0, 320, 0, 510, 240, 0, 0, 2]\n", "is not [fx 0 cx"},
      {"K: [500, 3, 320, 0, 510, 240, 0, 0, 1]\n", "skew"},
      {"K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nimage_width: 640\n", "only one of"},
      {"K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nimage_width: 0\nimage_height: 480\n", "1 to 16384"},
      {"K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nimage_width: 640.5\nimage_height: 480\n",
       "1 to 16384"},
  };
  for (const auto& [text, problem] : cases) CHECK_REFUSED(read(folder, text), problem);
  CHECK_REFUSED(read_camera_file(folder / "missing.yaml"), "No such file");
  CHECK_REFUSED(read(folder, std::string("\x89PNG\0\0\x1A", 7)), "is malformed");
}

BOOST_AUTO_TEST_SUITE_END()
