#include <marker/input/camera_file.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform::input;
using namespace input_test;
using kit::TemporaryFolder;
using marker::LensModel;

namespace {

CalibratedCamera read(const std::string& text) {
  const TemporaryFolder folder;
  kit::write_file(folder / "camera.yaml", text);
  return read_camera_file(folder / "camera.yaml");
}

/// What all files here say: 600.5, 601.25, (319.5, 239.5), 640x480.
void check_camera(const CalibratedCamera& calibrated, LensModel model,
                  const std::vector<double>& distortion) {
  BOOST_TEST(calibrated.camera.fx == 600.5);
  BOOST_TEST(calibrated.camera.fy == 601.25);
  BOOST_TEST(calibrated.camera.cx == 320.0);
  BOOST_TEST(calibrated.camera.cy == 240.0);
  BOOST_TEST(calibrated.camera.width == 640);
  BOOST_TEST(calibrated.camera.height == 480);
  BOOST_TEST((calibrated.lens_model == model));
  BOOST_TEST(calibrated.distortion == distortion, boost::test_tools::per_element());
  BOOST_TEST(calibrated.oddities.empty());
}

const std::string k = "K: [600.5, 0, 319.5, 0, 601.25, 239.5, 0, 0, 1]\n";
const std::string size = "image_width: 640\nimage_height: 480\n";

const std::string kalibr =
    "cam0:\n  cam_overlaps: []\n  camera_model: pinhole\n  distortion_coeffs: [0.1, -0.2, 0.01, "
    "0.02]\n  distortion_model: radtan\n  intrinsics: [600.5, 601.25, 319.5, 239.5]\n  resolution: "
    "[640, 480]\n  rostopic: /camera/image_raw\n";

const std::string ost =
    "# oST version 5.0 parameters\n\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n[narrow_stereo]\n\n"
    "camera matrix\n600.5 0.0 319.5\n0.0 601.25 239.5\n0.0 0.0 1.0\n\ndistortion\n0.1 -0.2 0.01 "
    "0.02 0.3\n\nrectification\n1 0 0\n0 1 0\n0 0 1\n\nprojection\n600.5 0 319.5 0\n0 601.25 239.5 "
    "0\n0 0 1 0\n";

const std::string caltech =
    "% Intrinsic and Extrinsic Camera Parameters\n\n%-- Focal length:\nfc = [ 600.5 ; 601.25 ];\n\n"
    "%-- Principal point:\ncc = [ 319.5 ; 239.5 ];\n\nalpha_c = 0.0;\n\nkc = [ 0.1 ; -0.2 ; 0.01 ; "
    "0.02 ; 0.3 ];\n\nfc_error = [ 1 ; 1 ];\n\nnx = 640;\nny = 480;\n";

const std::string matlab =
    "IntrinsicMatrix: [[600.5, 0, 0], [0, 601.25, 0], [320.5, 240.5, 1]]\nRadialDistortion: [0.1, "
    "-0.2]\nTangentialDistortion: [0.01, 0.02]\nImageSize: [480, 640]\nFocalLength: [600.5, "
    "601.25]\nPrincipalPoint: [320.5, 240.5]\n";

const std::string orb_slam =
    "%YAML:1.0\n---\nCamera.type: \"KannalaBrandt8\"\nCamera.fx: 600.5\nCamera.fy: "
    "601.25\nCamera.cx: "
    "319.5\nCamera.cy: 239.5\nCamera.k1: 0.1\nCamera.k2: -0.2\nCamera.k3: 0.01\nCamera.k4: 0.02\n"
    "Camera.width: 640\nCamera.height: 480\nCamera.fps: 20\n";

const std::string sensor =
    "%YAML:1.0\n# General sensor definitions.\nsensor_type: camera\ncomment: cam0\nT_BS:\n  cols: "
    "4\n  rows: 4\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: "
    "20\nresolution: [640, 480]\ncamera_model: pinhole\nintrinsics: [600.5, 601.25, 319.5, 239.5] "
    "#fu, fv, cu, cv\ndistortion_model: radial-tangential\ndistortion_coefficients: [0.1, -0.2, "
    "0.01, 0.02]\n";

/// A text with one part in place of another.
std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), other);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_dialects)

BOOST_AUTO_TEST_CASE(lens_models_by_name) {
  for (const char* name : {"equidistant", "fisheye", "kannala_brandt", "KannalaBrandt8"}) {
    check_camera(read(k + size + "distortion_model: " + name + "\nD: [-0.05, 0.02, -0.03, 0.01]\n"),
                 LensModel::equidistant, {-0.05, 0.02, -0.03, 0.01});
  }
  check_camera(read(k + size + "fisheye_model: 1\nD: [-0.05, 0.02, -0.03, 0.01]\n"),
               LensModel::equidistant, {-0.05, 0.02, -0.03, 0.01});
  const std::vector<double> rational{0.1, 0, 0, 0, 0, 0.2, 0.01, 0.02};
  check_camera(read(k + size +
                    "distortion_model: rational_polynomial\nD: [0.1, 0, 0, 0, 0, 0.2, "
                    "0.01, 0.02]\n"),
               LensModel::rational, rational);
  check_camera(read(k + size + "D: [0.1, 0, 0, 0, 0, 0.2, 0.01, 0.02]\n"), LensModel::rational,
               rational);
  const CalibratedCamera plain = read(k + size + "D: [0.1, 0, 0, 0, 0, 0, 0, 0]\n");
  BOOST_TEST((plain.lens_model == LensModel::brown_conrady), "what follows k3 is 0");
  const CalibratedCamera bare = read(k + size + "distortion_model: equidistant\nD: []\n");
  BOOST_TEST(has_distortion(bare), "an equidistant lens bends by itself");
  BOOST_TEST((camera_for(bare, {640, 480}).lens_model == LensModel::equidistant));
}

// cv::fisheye's four coefficients look like Brown and Conrady's, but for their size.
BOOST_AUTO_TEST_CASE(four_coefficients_that_may_be_those_of_a_fisheye_lens) {
  const std::string fisheye = k + size + "D: [-0.045, 0.077, -0.248, 0.238]\n";
  CHECK_REFUSED(read(fisheye), "too large for p1 and p2");
  CHECK_REFUSED(read(k + size + "D: [-0.045, 0.077, 0.001, -0.03]\n"), "too large for p1 and p2");
  check_camera(read("fisheye_model: 1\n" + fisheye), LensModel::equidistant,
               {-0.045, 0.077, -0.248, 0.238});
  check_camera(read("distortion_model: plumb_bob\n" + fisheye), LensModel::brown_conrady,
               {-0.045, 0.077, -0.248, 0.238});
  check_camera(read(k + size + "D: [-0.3, 0.1, 0.02, -0.02]\n"), LensModel::brown_conrady,
               {-0.3, 0.1, 0.02, -0.02});
  BOOST_TEST(read(k + size + "D: [-0.3, 0.1, 0.05, 0, 0]\n").distortion.size() == 5u);
}

BOOST_AUTO_TEST_CASE(files_of_other_programs) {
  const std::vector<double> four{0.1, -0.2, 0.01, 0.02}, five{0.1, -0.2, 0.01, 0.02, 0.3};
  check_camera(read(kalibr), LensModel::brown_conrady, four);
  check_camera(read(with(kalibr, "radtan", "equidistant")), LensModel::equidistant, four);
  check_camera(read(sensor), LensModel::brown_conrady, four);
  check_camera(read(with(sensor, "radial-tangential", "equidistant")), LensModel::equidistant,
               four);
  check_camera(read(ost), LensModel::brown_conrady, five);
  check_camera(read(caltech), LensModel::brown_conrady, five);
  check_camera(read(matlab), LensModel::brown_conrady, {0.1, -0.2, 0.01, 0.02, 0});
  check_camera(read(orb_slam), LensModel::equidistant, four);
  std::string newer = with(orb_slam, "---\n", "---\nFile.version: \"1.0\"\n");
  for (const char* name : {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"})
    newer = with(newer, std::string("Camera.") + name, std::string("Camera1.") + name);
  check_camera(read(newer), LensModel::equidistant, four);
  const std::string pinhole =
      with(with(orb_slam, "KannalaBrandt8", "PinHole"), "Camera.k3: 0.01\nCamera.k4: 0.02\n",
           "Camera.p1: 0.01\nCamera.p2: 0.02\n");
  check_camera(read(pinhole), LensModel::brown_conrady, {0.1, -0.2, 0.01, 0.02, 0});
}

BOOST_AUTO_TEST_CASE(what_they_say_that_is_not_supported) {
  const std::map<std::string, std::string> cases{
      {with(kalibr, "radtan", "fov"),
       "'distortion_model: fov': a lens model that is not supported"},
      {with(kalibr, "radtan", "none"), "has 4 coefficients"},
      {with(kalibr, "pinhole", "omni"), "says 'cam0.camera_model: omni'"},
      {with(kalibr, "pinhole", "ds"), "says 'cam0.camera_model: ds'"},
      {kalibr + with(kalibr, "cam0", "cam1"), "has several cameras ('cam0' and 'cam1')"},
      {with(kalibr, "[600.5, 601.25, 319.5, 239.5]", "[1.1, 600.5, 601.25, 319.5, 239.5]"),
       "that is not 4 numbers"},
      {with(sensor, "pinhole", "omni"), "says 'camera_model: omni'"},
      {with(sensor, "radial-tangential", "fov"), "'distortion_model: fov': a lens model that is"},
      {"MappingCoefficients: [200, -0.001, 0, 0]\nImageSize: [480, 640]\n",
       "looks like MATLAB's fisheyeIntrinsics"},
      {with(ost, "0.1 -0.2 0.01 0.02 0.3", "0.1 -0.2 0.01 0.02 0.3 1 1 1"), "has 8 coefficients"},
      {with(ost, "600.5 0.0 319.5", "600.5 0.0"), "'camera_matrix' that is not 9 numbers"},
      {ost + ost.substr(ost.find("[narrow")), "has several cameras"},
      {with(ost, "1 0 0", "0 1 0"), "rectifies the images by a turn"},
      {with(caltech, "alpha_c = 0.0", "alpha_c = 0.1"), "has skew"},
      {with(caltech, " ; 0.3 ]", " ]"), "'kc' of 4 numbers"},
      {with(caltech, "fc = [ 600.5 ; 601.25 ]", "fc = [ 600.5 ]"), "has no 'fc' of 2 numbers"},
      {with(matlab, "[0, 601.25, 0]", "[3, 601.25, 0]"), "skewed"},
      {with(matlab, "RadialDistortion: [0.1, -0.2]", "RadialDistortion: [0.1]"),
       "that is not 2 to 3 numbers"},
      {with(orb_slam, "KannalaBrandt8", "PinHole"),
       "'Camera.k4', which looks like lens distortion"},
      {with(orb_slam, "KannalaBrandt8", "Rectified"), "says 'Camera.type: Rectified'"},
      {with(orb_slam, "Camera.cy: 239.5\n", ""), "has no 'camera.cy'"},
  };
  for (const auto& [text, problem] : cases) CHECK_REFUSED(read(text), problem);
}

BOOST_AUTO_TEST_CASE(a_response_curve) {
  const auto of = [](const std::string& response) {
    return read(k + "response: " + response + "\n").response;
  };
  BOOST_TEST(!read(k).response.light);
  BOOST_TEST(!read(k).response.is_linear);
  BOOST_TEST(of("linear").is_linear);
  BOOST_TEST(of("sRGB").light->at(128) == 14146);
  BOOST_TEST(of("rec709").light->at(10) == 571);
  BOOST_TEST(of("2").light->at(128) == 16513);
  std::string table, falling, flat;
  for (int i = 0; i < 256; ++i) {
    table += std::to_string(3 + i * i) + ", ";
    falling += std::to_string(i == 200 ? 0 : i) + ", ";
    flat += "7, ";
  }
  const platform::Response given = of("[" + table + "]");
  BOOST_TEST(given.light->at(0) == 0);
  BOOST_TEST(given.light->at(128) == 16513);
  BOOST_TEST(given.light->at(255) == 65535);
  const std::map<std::string, std::string> cases{
      {"gamma", "that is not known: give linear, srgb, rec709"},
      {"0.1", "whose exponent is not 0.5 to 5"},
      {".nan", "whose exponent is not 0.5 to 5"},
      {"[0, 1, 2]", "of 3 numbers: give the light of 256 grey levels"},
      {"[" + falling + "]", "that falls at grey level 200"},
      {"[" + flat + "]", "that is the same light at all levels"},
      {"[" + with(table, "28, ", ".nan, ") + "]", "with values that are no numbers"},
  };
  for (const auto& [response, problem] : cases) CHECK_REFUSED(of(response), problem);
}

BOOST_AUTO_TEST_CASE(a_lens_ends_where_its_model_does) {
  const auto reach = [](const std::string& distortion) {
    return lens_reach_px(read("K: [200, 0, 319.5, 0, 200, 239.5, 0, 0, 1]\n" + size + distortion),
                         {640, 480});
  };
  BOOST_TEST(!reach("D: []\n"));
  // Its corners are 2.0 of a focal length from the middle: 1.31 rad are seen at 262 px.
  const auto wide = reach("distortion_model: equidistant\nD: []\n");
  BOOST_TEST_REQUIRE(wide.has_value());
  BOOST_TEST(std::abs(*wide - 262) < 1);
  // The pole of 1 / (1 - r²) comes at one focal length, behind all pixels.
  BOOST_TEST(!reach("D: [0, 0, 0, 0, 0, -1, 0, 0]\n"));
  const auto folded = reach("D: [0, 0, 0, 0, 0, 1, 0, 0]\n");
  BOOST_TEST_REQUIRE(folded.has_value());
  BOOST_TEST(std::abs(*folded - 100) < 1, "r / (1 + r²) is 0.5 at most");
}

BOOST_AUTO_TEST_SUITE_END()
