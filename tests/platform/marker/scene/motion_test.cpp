// Scenes that move, and the sensor that sees them: shutter, exposure, vignetting, with their truth.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <marker/scene/conditions.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

#include "input_error.h"

using namespace platform;

namespace {

Scene scene_of(const std::string& name) {
  return make_scene(name, Camera::for_resolution(160, 120));
}

std::vector<double> light_of(const std::string& name) {
  return render_light(scene_of(name));
}

double most_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

std::vector<double> row(const std::vector<double>& picture, std::size_t y) {
  constexpr std::size_t width = 160;
  const auto first = picture.begin() + static_cast<std::ptrdiff_t>(y * width);
  return {first, first + width};
}

const std::string moving = "velocity_x=0.4,velocity_y=-0.2,velocity_z=0.3,spin=50";

}  // namespace

BOOST_AUTO_TEST_SUITE(motion)

BOOST_AUTO_TEST_CASE(a_short_exposure_stops_the_motion) {
  BOOST_TEST(most_difference(light_of("demo@" + moving + ",exposure=0ms"), light_of("demo")) ==
             0.0);
  BOOST_TEST(most_difference(light_of("demo@exposure=20ms,readout=20ms"), light_of("demo")) == 0.0,
             "nothing moves");
}

BOOST_AUTO_TEST_CASE(the_marker_is_where_its_motion_led) {
  const GroundTruth before = ground_truth(scene_of("z1.0"));
  const GroundTruth later = ground_truth(scene_of("z1.0@velocity_x=0.4,velocity_z=0.5,time=100ms"));
  BOOST_TEST(
      (later.pose.translation - before.pose.translation - Eigen::Vector3d(0.04, 0, 0.05)).norm() <
      1e-12);
  const Scene turned = scene_of("front0@spin=90,time=500ms");
  BOOST_TEST(rotation_error_deg(ground_truth(turned).pose, turned.pose) == 45.0,
             boost::test_tools::tolerance(1e-9));
  const Eigen::Vector3d middle{marker_side_m / 2, marker_side_m / 2, 0};
  BOOST_TEST(
      (transform(ground_truth(turned).pose, middle) - transform(turned.pose, middle)).norm() <
      1e-12);
}

BOOST_AUTO_TEST_CASE(an_exposure_is_the_mean_of_what_passes) {
  const std::string scene = "z1.0@velocity_x=2,exposure=20ms";  // 3.8 px: 16 moments
  std::vector<double> mean(160 * 120);
  for (int moment = 0; moment < 16; ++moment) {
    const double us = 20'000 * ((moment + 0.5) / 16 - 0.5);
    const auto still = light_of("z1.0@velocity_x=2,time=" + std::to_string(us) + "us");
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += still[i] / 16;
  }
  BOOST_TEST(most_difference(light_of(scene), mean) < 1e-9);
  BOOST_TEST(most_difference(light_of("z1.0@velocity_x=2,exposure=0ms"), mean) > 0.3);
  const GroundTruth truth = ground_truth(scene_of(scene)), still = ground_truth(scene_of("z1.0"));
  BOOST_TEST(truth.corners_px[0].x == still.corners_px[0].x, "of the middle of the exposure");
}

BOOST_AUTO_TEST_CASE(a_rolling_shutter_sees_each_row_at_its_own_time) {
  const auto rolling = light_of("demo@" + moving + ",readout=60ms");
  for (const std::size_t y : {0u, 31u, 60u, 119u}) {
    const double us = 60'000 * ((static_cast<double>(y) + 0.5) / 120 - 0.5);
    const auto still = light_of("demo@" + moving + ",time=" + std::to_string(us) + "us");
    BOOST_TEST(most_difference(row(rolling, y), row(still, y)) < 1e-9, "row " << y);
  }
  BOOST_TEST(most_difference(rolling, light_of("demo@" + moving + ",exposure=0ms")) > 0.1);
}

BOOST_AUTO_TEST_CASE(true_corners_are_where_a_rolling_shutter_puts_them) {
  const Scene scene = scene_of("z1.0@velocity_x=1,velocity_y=0.5,readout=50ms");
  const GroundTruth truth = ground_truth(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    const PixelPoint seen = truth.corners_px[i];
    const Pose then = pose_at(scene, exposure_time(scene, seen.y));
    const PixelPoint there = project_marker(scene.camera, then)[i];
    BOOST_TEST(std::hypot(there.x - seen.x, there.y - seen.y) < 1e-9);
  }
  const auto at_once =
      ground_truth(scene_of("z1.0@velocity_x=1,velocity_y=0.5,exposure=0ms")).corners_px;
  BOOST_TEST(std::abs(truth.corners_px[2].x - at_once[2].x) > 0.5, "it is skewed");
  BOOST_TEST(translation_error_mm(truth.pose, scene.pose) == 0.0, "the pose is that of its middle");
}

BOOST_AUTO_TEST_CASE(vignetting_takes_its_share_from_the_corners) {
  const auto plain = light_of("z1.0"), dark = light_of("z1.0@vignetting=0.4");
  const auto share = [&](std::size_t x, std::size_t y) {
    return dark[y * 160 + x] / plain[y * 160 + x];
  };
  const double corner = (79.5 * 79.5 + 59.5 * 59.5) / (80.0 * 80 + 60 * 60);
  BOOST_TEST(share(0, 0) == 1 - 0.4 * corner, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(share(159, 119) == share(0, 0), boost::test_tools::tolerance(1e-9));
  BOOST_TEST(share(80, 60) > 0.9999);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const auto said = [](const std::string& name) { return input_error([&] { make_scene(name); }); };
  const auto contains = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  BOOST_TEST(contains(said("demo@exposure=-1ms"), "exposure"));
  BOOST_TEST(contains(said("demo@readout=11s"), "readout"));
  BOOST_TEST(contains(said("demo@exposure=3"), "has no unit"));
  BOOST_TEST(contains(said("demo@vignetting=2"), "vignetting"));
  BOOST_TEST(contains(said("demo@speed=2"), "is no condition"));
  for (const char* unseen : {"demo@spin=90", "demo@velocity_y=1,noise=0.01"})
    BOOST_TEST(contains(said(unseen), "name the exposure, readout or time that it lasts"));
  BOOST_TEST(said("demo@spin=90,time=0s") == "nothing thrown");
  BOOST_TEST(said("z1.0@velocity_z=-2,exposure=2s") != "nothing thrown",
             "it flies into the camera");
}

BOOST_AUTO_TEST_SUITE_END()
