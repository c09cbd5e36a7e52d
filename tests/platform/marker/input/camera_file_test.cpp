#include <marker/input/camera_file.h>

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
      {"just words", "no entries in YAML, XML or JSON"},
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
  CHECK_REFUSED(read(folder, std::string("\x89PNG\0\0\x1A", 7)), "no entries in YAML, XML or JSON");
}

/// A camera file of ROS with one line in place of another.
std::string ros_with(const std::string& line, const std::string& other) {
  std::string text = ros;
  text.replace(text.find(line), line.size(), other);
  return text;
}

BOOST_AUTO_TEST_CASE(other_lens_models_are_refused_by_name) {
  const TemporaryFolder folder;
  for (const char* model : {"nonsense", "omni", "ds", "inverse_brown_conrady", "fov", "eucm",
                            "thin_prism_fisheye", "double_sphere"}) {
    const std::string text =
        ros_with("distortion_model: plumb_bob", std::string("distortion_model: ") + model);
    CHECK_REFUSED(read(folder, text), std::string("says 'distortion_model: ") + model +
                                          "': a lens model that is not supported. plumb_bob");
    kit::write_file(folder / "camera.xml",
                    "<?xml version=\"1.0\"?>\n<opencv_storage><K>500 0 320 0 500 240 0 0 1</K>"
                    "<lens_model>\"" +
                        std::string(model) + "\"</lens_model></opencv_storage>");
    CHECK_REFUSED(read_camera_file(folder / "camera.xml"), "a lens model that is not supported");
  }
  CHECK_REFUSED(read(folder, std::string(ros) + "fisheye_model: 1\n"), "has 5 coefficients");
  CHECK_REFUSED(read(folder, std::string(ros) + "fisheye_model: 2\n"), "'fisheye_model: 2'");
  CHECK_REFUSED(read(folder, std::string(ros) + "camera_model: omni\n"), "'camera_model: omni'");
  check_camera(read(folder, std::string(ros) + "fisheye_model: 0\n"));
  check_camera(read(folder, std::string(ros) + "camera_model: pinhole\n"));
  for (const char* model : {"radtan", "Plumb_Bob", "brown_conrady", "\"\""}) {
    check_camera(read(folder, ros_with("distortion_model: plumb_bob",
                                       std::string("distortion_model: ") + model)));
  }
}

BOOST_AUTO_TEST_CASE(coefficients_must_be_those_of_the_model) {
  const TemporaryFolder folder;
  const std::string k = "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n";
  const auto kept = [&](const std::string& d) { return read(folder, k + d).distortion.size(); };
  BOOST_TEST(kept("D: []\n") == 0u);
  BOOST_TEST(kept("D: [0.1, 0, 0, 0]\n") == 4u);
  BOOST_TEST(kept("D: [0.1, 0, 0, 0, 0.1, 0, 0, 0]\n") == 8u);
  const std::map<std::string, std::string> cases{
      {"D: [0.1]\n", "has 1 coefficients of lens distortion"},
      {"D: [0.1, 0.1, 0]\n", "has 3 coefficients"},
      {"D: [0.1, 0, 0, 0, 0, 0]\n", "has 6 coefficients"},
      {"D: [0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0]\n", "a tilted sensor"},
      {"distortion_model: equidistant\nD: [0.1, 0, 0, 0, 0]\n", "has 5 coefficients"},
      {"distortion_model: plumb_bob\nD: [0.1, 0, 0, 0, 0, 0, 0, 0]\n", "has 8 coefficients"},
      {"distortion_model: rational_polynomial\nD: [0.1, 0, 0, 0, 0]\n", "has 5 coefficients"},
      {"distortion_model: none\nD: [0.1, 0, 0, 0, 0]\n", "has 5 coefficients"},
      {"D: {rows: 2, cols: 2, data: [0.1, 0, 0, 0]}\n", "neither a row nor a column"},
      {"D: {rows: 1, cols: 5, data: [0.1, 0, 0, 0]}\n", "not rows times cols numbers"},
      {"D: [a, b, c, d]\n", "whose values are not numbers"},
      {"D:\n", "not a list of numbers: 'D'"},
      {"D: {k1: 0.1, k2: 0}\n", "'D.k1', which looks like lens distortion"},
      {"D: [0.1, 0, 0, 0]\nD: [0.2, 0, 0, 0]\n", "says 'D' and 'D', which differ"},
      {"D: [0.1, 0, 0, 0]\ndist_coeffs: [0, 0, 0, 0]\n", "says 'D' and 'dist_coeffs'"},
  };
  for (const auto& [d, problem] : cases) CHECK_REFUSED(read(folder, k + d), problem);
  BOOST_TEST(kept("D: [0.1, 0, 0, 0]\ndist_coeffs: [0.1, 0, 0, 0]\n") == 4u);
}

BOOST_AUTO_TEST_CASE(distortion_under_another_name_is_refused) {
  const TemporaryFolder folder;
  const std::string k = "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n";
  for (const char* entry :
       {"distortion_vec: [-0.3, 0, 0, 0, 0]", "dist_coeff: [-0.3, 0, 0, 0]", "dist: [-0.3]",
        "camera_dist: {rows: 1, cols: 5, data: [-0.3, 0.1, 0, 0, 0]}", "k1: -0.3", "kc: [-0.3, 0]",
        "lens: {distortion: [-0.3, 0, 0, 0]}", "lens: [-0.3, 0, 0, 0]", "radial: [-0.3]",
        "extra: [{k1: -0.3}]", "thin_prism: [0.1, 0.1]", "coeffs: [-0.3, 0, 0, 0]"}) {
    CHECK_REFUSED(read(folder, k + entry + "\n"), "looks like lens distortion and is not read");
  }
  BOOST_TEST(read(folder, k + "working_distance: 0.5\n").oddities.size() == 1u);
}

BOOST_AUTO_TEST_CASE(entries_that_are_not_read_are_named) {
  const TemporaryFolder folder;
  BOOST_TEST(read(folder, ros).oddities.empty());
  const auto odd = read(folder, std::string(ros) + "focus: 3\nowner: {who: me}\n").oddities;
  BOOST_TEST_REQUIRE(odd.size() == 1u);
  BOOST_TEST(odd[0] == "has entries that are not read: focus, owner.who");
}

/// R and P are of rectified images; binning and a region move the pixels.
BOOST_AUTO_TEST_CASE(entries_of_ros_are_heeded) {
  const TemporaryFolder folder;
  const std::string same_p =
      "projection_matrix: {rows: 3, cols: 4, data: [600.5, 0, 319.5, 0, 0, 601.25, 239.5, 0, 0, 0, "
      "1, 0]}\n";
  const std::string unit_r = "rectification_matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  const std::string whole =
      "binning_x: 0\nbinning_y: 1\nroi: {x_offset: 0, y_offset: 0, height: 0, width: 0, "
      "do_rectify: false}\n";
  BOOST_TEST(read(folder, ros + same_p + unit_r + whole).oddities.empty());
  const auto odd = read(folder, std::string(ros) +
                                    "P: [590, 0, 319.5, 0, 0, 601.25, 239.5, 0, 0, "
                                    "0, 1, 0]\n")
                       .oddities;
  BOOST_TEST_REQUIRE(odd.size() == 1u);
  BOOST_TEST(odd[0].find("has a 'P' other than its camera_matrix") == 0u);
  const std::map<std::string, std::string> cases{
      {"R: [0.99, 0.1, 0, -0.1, 0.99, 0, 0, 0, 1]\n", "rectifies the images by a turn"},
      {"R: [1, 0, 0]\n", "'R' that is not 3x3 numbers"},
      {"P: [.nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n", "'P' with values that are no numbers"},
      {"binning_x: 2\n", "binned images"},
      {"roi: {x_offset: 10, y_offset: 0, height: 0, width: 0}\n", "a part of the images"},
      {"roi: {x_offset: 0, y_offset: 0, height: 240, width: 320}\n", "a part of the images"},
      {"skew: 0.5\n", "has skew"},
      {"camera_resolution: [1280, 960]\n", "two image sizes"},
      {"width: 1280\n", "says 'image_width' and 'width'"},
  };
  for (const auto& [more, problem] : cases)
    CHECK_REFUSED(read(folder, std::string(ros) + more), problem);
}

BOOST_AUTO_TEST_CASE(a_size_may_be_one_entry) {
  const TemporaryFolder folder;
  const CalibratedCamera camera =
      read(folder, "cameraResolution: [640, 480]\nK: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n");
  BOOST_TEST(camera.has_size);
  BOOST_TEST(camera.camera.width == 640);
}

BOOST_AUTO_TEST_CASE(files_of_other_programs_are_refused_by_name) {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> cases{
      {"distortion_coeffs: [0, 0, 0, 0]\n", "looks like a camchain of Kalibr"},
      {"model_type: PINHOLE\nprojection_parameters: {fx: 500}\n",
       "looks like a camera file of VINS"},
      {"RadialDistortion: [0, 0]\n", "looks like MATLAB's cameraParameters"},
      {"M1: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nD1: [0, 0, 0, 0]\n", "a stereo calibration"},
      {"left: {camera_matrix: [500, 0, 320, 0, 510, 240, 0, 0, 1]}\n",
       "inside another entry ('left.camera_matrix')"},
      {"K: [500, 0, 0, 0, 510, 0, 320, 240, 1]\n", "a transposed camera_matrix"},
      {"K: [0.6, 0, 0.5, 0, 0.8, 0.5, 0, 0, 1]\n", "focal length below 10 px"},
      {"K: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n", "not calibrated"},
      {"K: {rows: 9, cols: 1, data: [500, 0, 320, 0, 510, 240, 0, 0, 1]}\n", "not 3x3"},
  };
  for (const auto& [text, problem] : cases) CHECK_REFUSED(read(folder, text), problem);
  CHECK_REFUSED(read(folder, std::string("MATLAB 5.0 MAT-file\0", 20)), "is a MAT-file of MATLAB");
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
      {"camera_matrix: &a [*a]", "an alias inside its own anchor"},
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
