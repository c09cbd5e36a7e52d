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
void write_opencv(const std::string& path, int flags = 0) {
  cv::FileStorage storage(path, cv::FileStorage::WRITE | flags);
  storage << "calibration_time"
          << "Sat 21 Nov 2026"
          << "image_width" << 640 << "image_height" << 480;
  storage << "camera_matrix"
          << (cv::Mat_<double>(3, 3) << 600.5, 0, 319.5, 0, 601.25, 239.5, 0, 0, 1);
  storage << "distortion_coefficients" << (cv::Mat_<double>(5, 1) << 0.1, -0.2, 0, 0, 0);
  storage.writeComment("flags: +fix_aspect_ratio \"quoted\"");
  storage << "avg_reprojection_error" << 0.25 << "views" << std::vector<cv::Point2f>{{1, 2}, {3, 4}}
          << "grid"
          << "{"
          << "rows" << 6 << "}"
          << "nothing" << cv::Mat();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_file)

BOOST_AUTO_TEST_CASE(opencv_files_of_each_kind) {
  const TemporaryFolder folder;
  for (const char* name : {"camera.yml", "camera.xml", "camera.json"}) {
    write_opencv(folder / name);
    check_camera(read_camera_file(folder / name));
    write_opencv(folder / name, cv::FileStorage::WRITE_BASE64);
    check_camera(read_camera_file(folder / name));
  }
}

/// As OpenCV reads them: each number as the type that the matrix has.
BOOST_AUTO_TEST_CASE(matrices_have_types) {
  const TemporaryFolder folder;
  for (const char* name : {"camera.yml", "camera.xml", "camera.json"}) {
    for (const int flags : {0, int(cv::FileStorage::WRITE_BASE64)}) {
      cv::FileStorage storage(folder / name, cv::FileStorage::WRITE | flags);
      storage << "K" << (cv::Mat_<float>(3, 3) << 600.1f, 0, 320, 0, 600.7f, 240, 0, 0, 1);
      storage << "D" << (cv::Mat_<int>(1, 4) << 1, -2, 0, 0);
      storage.release();
      const CalibratedCamera camera = read_camera_file(folder / name);
      BOOST_TEST(camera.camera.fx == double(600.1f));
      BOOST_TEST(camera.camera.fy == double(600.7f));
      BOOST_TEST((camera.distortion == std::vector<double>{1, -2, 0, 0}));
    }
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

BOOST_AUTO_TEST_CASE(distortion_must_be_numbers) {
  const TemporaryFolder folder;
  CHECK_REFUSED(read(folder, "K: [[500, 0, 320], [0, 510, 240], [0, 0, 1]]\nD: [0, .nan, 0, 0]\n"),
                "lens distortion that is not a number");
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
      {"just words", "no calibration in YAML, XML or JSON"},
      {"a: [1, 2", "camera.yaml':1:1: this is not YAML"},
      {"%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n",
       "camera file"},
      {"%YAML:1.0\n---\n[[[\n", "is not YAML"},
      {"%YAML:1.0\n---\nK: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [1, 2]\n",
       "'K': its data are not rows times cols numbers"},
      {"<?xml version=\"1.0\"?>\n<opencv_storage>\n<camera_matrix",
       "camera.yaml':3:1: this is not"},
      {"<?xml version=\"1.0\"?>\n<html/>", "no <opencv_storage>"},
      {"{\"camera_matrix\": ", "is not YAML"},
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
  CHECK_REFUSED(read(folder, std::string("\x89PNG\0\0\x1A", 7)),
                "no calibration in YAML, XML or JSON");
}

/// OpenCV's own parser overran the stack on the first, and readers of its trees on the others.
BOOST_AUTO_TEST_CASE(hostile_files_are_refused) {
  const auto repeated = [](const std::string& part, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
  };
  const std::string xml = "<?xml version=\"1.0\"?>\n";
  const TemporaryFolder folder;
  const std::map<std::string, std::string> cases{
      {"<?xml version=", "is not whole XML"},
      {"camera_matrix: &a [*a]", "an alias inside what it stands for"},
      {"K: " + repeated("[", 100'000), "nested more than 32 levels"},
      {"{\"K\": " + repeated("[", 100'000), "nested more than 32 levels"},
      {"%YAML:1.0\n---\nK: " + repeated("[", 100'000), "nested more than 32 levels"},
      {xml + "<opencv_storage>" + repeated("<_>", 100'000), "nested more than 32 levels"},
      {xml + "<!DOCTYPE a [<!ENTITY b \"b\">]>\n<opencv_storage/>", "has no DOCTYPE"},
      {"K: " + repeated("1", 1 << 20), "larger than 1 MiB"},
  };
  for (const auto& [text, problem] : cases) CHECK_REFUSED(read(folder, text), problem);
  CHECK_REFUSED(read_camera_file("/dev/zero"), "it is a device");
}

/// Each byte cut off or changed: read as another camera, or refused.
BOOST_AUTO_TEST_CASE(damaged_files_of_each_kind_end) {
  const TemporaryFolder folder;
  for (const char* name : {"camera.yml", "camera.xml", "camera.json"}) {
    for (const int flags : {0, int(cv::FileStorage::WRITE_BASE64)}) {
      write_opencv(folder / name, flags);
      const std::string good = kit::read_file(folder / name);
      std::size_t refused = 0;
      for (std::size_t i = 0; i < good.size(); ++i) {
        std::string damaged = good;
        damaged[i] = "<[{&*\"!-x\0"[i % 10];
        for (const std::string& text : {good.substr(0, i), damaged}) {
          try {
            read(folder, text);
          } catch (const vp::InputError&) {
            ++refused;
          }
        }
      }
      BOOST_TEST(refused > good.size() / 2, name);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
