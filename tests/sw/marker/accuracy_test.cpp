// How well corners and poses are known: on the thesis' poses, over all rolls, and against the
// noise.
#include <marker/board_pose.h>
#include <marker/marker_reader.h>
#include <marker/quad_fit.h>
#include <marker/scene/portable_math.h>
#include <marker/scene/renderer.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "fake_hal.h"
#include "pictures.h"
#include "views.h"

using platform::GreyImage;
using platform::Pose;
using platform::Scene;

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

marker::BoardPoses pose_of(const marker::QuadFit& fit, const marker::Camera& camera) {
  const marker::SeenMarker seen{marker::single_marker(platform::marker_side_m), fit.ideal,
                                marker::weights_of(fit.covariance), fit.common};
  return marker::estimate_board_pose(&seen, 1, camera);
}

Pose to_pose(const marker::BoardPose& pose) {
  return {views::rotation_of(pose), views::translation_of(pose)};
}

/// Means over the 41 poses.
struct Errors {
  double corner_px = 0, translation_mm = 0, rotation_deg = 0;
};

Errors over_the_poses(double blur) {
  Errors errors;
  std::vector<Scene> scenes = pictures::poses_of_the_thesis();
  BOOST_REQUIRE(scenes.size() == 41u);
  for (Scene& scene : scenes) {
    scene.blur_sigma_px = blur;
    const GreyImage picture = platform::render(scene);
    const marker::Lens lens = pictures::lens_of(scene.camera);
    const pictures::Found found = pictures::find_marker(scene, pictures::view(picture), lens);
    BOOST_REQUIRE_MESSAGE(found.found, scene.name);
    const marker::BoardPoses poses = pose_of(found.fit, lens.camera);
    BOOST_REQUIRE_MESSAGE(poses.valid, scene.name);
    errors.corner_px += found.corner_error / 41;
    errors.translation_mm += platform::translation_error_mm(to_pose(poses.best), scene.pose) / 41;
    errors.rotation_deg += platform::rotation_error_deg(to_pose(poses.best), scene.pose) / 41;
  }
  BOOST_TEST_MESSAGE("blur " << blur << " px: " << errors.corner_px << " px, "
                             << errors.translation_mm << " mm, " << errors.rotation_deg << " deg");
  return errors;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(accuracy, Fixture)

BOOST_AUTO_TEST_CASE(poses_of_the_thesis_at_any_blur) {
  struct Measured {
    double blur;
    Errors errors;
  };
  for (const Measured& measured :
       {Measured{0, {0.0042, 0.18, 0.043}}, Measured{0.35, {0.0047, 0.16, 0.047}},
        Measured{0.7, {0.0071, 0.28, 0.065}}}) {
    const Errors errors = over_the_poses(measured.blur);
    BOOST_TEST(errors.corner_px < measured.errors.corner_px);
    BOOST_TEST(errors.translation_mm < measured.errors.translation_mm);
    BOOST_TEST(errors.rotation_deg < measured.errors.rotation_deg);
  }
}

// The thesis' rule loses 101 of them, around 45°.
BOOST_AUTO_TEST_CASE(no_roll_is_lost) {
  double worst = 0, sum = 0;
  unsigned views = 0;
  for (const double depth : {1.0, 2.0}) {
    for (const double yaw : {0.0, 20.0, 40.0, 60.0}) {
      for (int roll = 0; roll < 90; ++roll, ++views) {
        Scene scene;
        scene.pose = platform::pose_from_centre(
            platform::rotation_y(yaw) * platform::rotation_z(roll), {0, 0, depth});
        scene.seed = views;
        const GreyImage picture = platform::render(scene);
        const pictures::Found found =
            pictures::find_marker(scene, pictures::view(picture), pictures::lens_of(scene.camera));
        BOOST_TEST(found.found, depth << " m, yaw " << yaw << ", roll " << roll);
        worst = std::max(worst, found.corner_error);
        sum += found.corner_error;
      }
    }
  }
  BOOST_TEST(views == 720u);
  BOOST_TEST_MESSAGE("720 views: mean " << sum / views << " px, worst " << worst << " px");
  BOOST_TEST(sum / views < 0.005);
  BOOST_TEST(worst < 0.02);
}

// From the front, tilted and rolled, and small: 750 of 750, none of them as another.
BOOST_AUTO_TEST_CASE(every_id_in_three_views) {
  const auto book = std::make_unique<marker::CodeBook>();
  book->open(*marker::find_dictionary("4x4_250"));
  const std::vector<Pose> views = {
      platform::pose_from_centre(platform::rotation_z(0), {0, 0, 1}),
      platform::pose_from_centre(
          platform::rotation_y(50) * platform::rotation_x(-20) * platform::rotation_z(47),
          {0.05, 0.03, 1.5}),
      platform::pose_from_centre(platform::rotation_y(25) * platform::rotation_z(200), {0, 0, 4})};
  unsigned found = 0;
  for (int id = 0; id < platform::dictionary_size; ++id) {
    for (const Pose& view : views) {
      Scene scene;
      scene.camera = {160, 160, 381.36, 381.36, 80, 80};
      scene.pose = view;
      scene.marker_id = id;
      scene.blur_sigma_px = 0.5;
      scene.seed = static_cast<std::uint64_t>(id);
      const GreyImage picture = platform::render(scene);
      const marker::GreyImage image = pictures::view(picture);
      const auto truth = platform::project_marker(scene.camera, scene.pose);
      for (const marker::Extremes& blob : pictures::find_blobs(image)) {
        marker::DetectedMarker marker{};
        if (marker::detect_marker({image, pictures::lens_of(scene.camera)}, blob, *book, {},
                                  marker) != marker::Refusal::none) {
          continue;
        }
        BOOST_TEST(marker.id == id);
        BOOST_TEST(std::hypot(marker.fit.ideal[0].x - truth[0].x,
                              marker.fit.ideal[0].y - truth[0].y) < 0.3);
        ++found;
      }
    }
  }
  BOOST_TEST(found == 750u);
}

/// A picture of 128 × 128 px: the marker, and a camera that looks past it.
Scene small_scene() {
  Scene scene;
  scene.camera = {128, 128, 381.36, 381.36, 40, 90};
  scene.pose = platform::pose_from_centre(
      platform::rotation_y(35) * platform::rotation_x(-15) * platform::rotation_z(20),
      {0.08, -0.09, 1.4});
  scene.blur_sigma_px = 0.4;
  return scene;
}

/// A small turn about the camera's axes and a shift: from `truth` to `pose`.
Vector6d difference(const Pose& pose, const Pose& truth) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(pose.rotation * truth.rotation.transpose()));
  Vector6d difference;
  difference << turn.axis() * turn.angle(), pose.translation - truth.translation;
  return difference;
}

/// True where the picture shows the marker's outline: half a cell inside to 1.5 cells outside.
bool shows_outline(const Scene& scene, int x, int y) {
  const Eigen::Vector3d ray((x + 0.5 - scene.camera.cx) / scene.camera.fx,
                            (y + 0.5 - scene.camera.cy) / scene.camera.fy, 1);
  const Eigen::Vector3d normal = scene.pose.rotation.col(2);
  const double depth = normal.dot(scene.pose.translation) / normal.dot(ray);
  const Eigen::Vector3d at =
      scene.pose.rotation.transpose() * (depth * ray - scene.pose.translation);
  const double side = platform::marker_side_m, half_cell = side / 12;
  const auto within = [&](double margin) {
    return at.x() > -margin && at.x() < side + margin && at.y() > -margin && at.y() < side + margin;
  };
  return within(3 * half_cell) && !within(-half_cell);
}

/// The Cramér–Rao bound: what an unbiased estimator of the pose scatters at least, given the grey
/// values around the marker's outline, the light and the blur.
Matrix6d least_covariance(const Scene& scene) {
  constexpr double step = 2e-5;  // rad and m
  const std::size_t pixels = platform::render_light(scene).size();
  Eigen::Matrix<double, Eigen::Dynamic, 6> slope(pixels, 6);
  for (int k = 0; k < 6; ++k) {
    const auto light = [&](double move) {
      Scene moved = scene;
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k % 3);
      if (k < 3) {
        moved.pose.rotation =
            Eigen::AngleAxisd(move, axis).toRotationMatrix() * scene.pose.rotation;
      } else {
        moved.pose.translation += move * axis;
      }
      return platform::render_light(moved);
    };
    const std::vector<double> ahead = light(step), behind = light(-step);
    for (std::size_t i = 0; i < pixels; ++i) {
      const int x = static_cast<int>(i) % scene.camera.width;
      const int y = static_cast<int>(i) / scene.camera.width;
      slope(static_cast<Eigen::Index>(i), k) =
          shows_outline(scene, x, y) ? (ahead[i] - behind[i]) / (2 * step) : 0;
    }
  }
  const double rounding = 1 / (255.0 * 255 * 12);
  const double variance = scene.noise_sigma * scene.noise_sigma + rounding;
  const Matrix6d information = slope.transpose() * slope / variance;
  return information.inverse();
}

// 1000 pictures that differ in noise alone: the covariance says how far the poses scatter, in each
// of the six coordinates and in all together.
BOOST_AUTO_TEST_CASE(the_covariance_is_the_spread_of_1000_noisy_renderings) {
  constexpr int renderings = 1000;
  const Scene scene = small_scene();
  const std::vector<double> light = platform::render_light(scene);
  const marker::Lens lens = pictures::lens_of(scene.camera);
  platform::GaussianNoise noise(17);
  Vector6d mean = Vector6d::Zero();
  Matrix6d spread = Matrix6d::Zero(), stated = Matrix6d::Zero();
  double surprise = 0, chi_squared = 0;
  for (int i = 0; i < renderings; ++i) {
    GreyImage picture{scene.camera.width, scene.camera.height, {}};
    for (const double value : light) {
      const double level = std::floor((value + scene.noise_sigma * noise.next()) * 255 + 0.5);
      picture.pixels.push_back(static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)));
    }
    const pictures::Found found = pictures::find_marker(scene, pictures::view(picture), lens);
    BOOST_REQUIRE(found.found);
    const marker::BoardPoses poses = pose_of(found.fit, lens.camera);
    BOOST_REQUIRE(poses.valid);
    const Vector6d off = difference(to_pose(poses.best), scene.pose);
    const Matrix6d covariance =
        Eigen::Map<const Matrix6d>(poses.best.covariance.data());  // symmetric
    mean += off / renderings;
    spread += off * off.transpose() / renderings;
    stated += covariance / renderings;
    surprise += off.dot(covariance.ldlt().solve(off)) / renderings;
    chi_squared += poses.best.chi_squared / renderings;
  }
  const Matrix6d bound = least_covariance(scene);
  for (int i = 0; i < 6; ++i) {
    const double over_bound = std::sqrt(spread(i, i) / bound(i, i));
    BOOST_TEST_MESSAGE("coordinate " << i << ": " << over_bound << " times the bound");
    BOOST_TEST(over_bound > 0.95);
    BOOST_TEST(over_bound < 2);
    const double ratio = std::sqrt(stated(i, i) / spread(i, i));
    BOOST_TEST_MESSAGE("coordinate " << i << ": stated " << std::sqrt(stated(i, i)) << ", spread "
                                     << std::sqrt(spread(i, i)) << ", mean " << mean[i]);
    BOOST_TEST(ratio > 0.85);
    BOOST_TEST(ratio < 1.2);
  }
  BOOST_TEST_MESSAGE("mean squared distance " << surprise << ", chi squared " << chi_squared);
  BOOST_TEST(surprise > 5);
  BOOST_TEST(surprise < 7.5);
  BOOST_TEST(chi_squared > 1.5);
  BOOST_TEST(chi_squared < 3);
}

BOOST_AUTO_TEST_SUITE_END()
