#include <marker/angles.h>
#include <marker/lens_models.h>
#include <marker/light_curves.h>
#include <marker/marker_detector.h>
#include <marker/optics.h>
#include <marker/scene/pose.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <boost/test/unit_test.hpp>
#include <opencv2/calib3d.hpp>

#include "pictures.h"

using marker::GeneralLens;
using marker::LensModel;
using marker::Point;

namespace {

const marker::Camera camera{381.36, 380, 320, 240};

const GeneralLens lenses[] = {
    {camera, LensModel::brown_conrady, {-0.3, 0.12, 0.001, -0.002, -0.03}},
    {camera, LensModel::rational, {0.4, -0.2, 0.001, -0.0005, 0.03, 0.7, -0.1, 0.02}},
    {camera,
     LensModel::rational,
     {0.1, 0.05, 0.001, 0.002, 0.01, 0.2, 0.1, 0.02, 0.003, -0.001, 0.002, 0.004}},
    {camera, LensModel::equidistant, {-0.05, 0.02, -0.03, 0.01}},
    {camera, LensModel::equidistant, {}},
};

/// Ideal points of the picture's middle, some 40 degrees wide.
std::vector<Point> grid() {
  std::vector<Point> points;
  for (int y = -2; y <= 2; ++y) {
    for (int x = -3; x <= 3; ++x) points.push_back({320 + x * 80.0, 240 + y * 80.0});
  }
  return points;
}

/// Where OpenCV says that the picture shows it.
Point by_opencv(const GeneralLens& lens, Point ideal) {
  const auto& k = lens.coefficients;
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const cv::Point3d ray((ideal.x - camera.cx) / camera.fx, (ideal.y - camera.cy) / camera.fy, 1);
  std::vector<cv::Point2d> seen;
  if (lens.model == LensModel::equidistant) {
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{ray}, seen, cv::Vec3d(), cv::Vec3d(),
                               matrix, cv::Vec4d(k[0], k[1], k[2], k[3]));
  } else {
    cv::projectPoints(std::vector<cv::Point3d>{ray}, cv::Vec3d(), cv::Vec3d(), matrix,
                      std::vector<double>(k.begin(), k.end()), seen);
  }
  return {seen[0].x, seen[0].y};
}

double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

const marker::Dictionary& dictionary = *marker::find_dictionary("4x4_250");
constexpr double side = 0.3;  // m

/// The marker with the ID 7, 0.8 m away, as a lens shows it that far off its axis.
struct OffAxis {
  GeneralLens lens;
  platform::Pose pose;
  platform::GreyImage image{640, 480, std::vector<std::uint8_t>(640 * 480, 220)};

  OffAxis(const GeneralLens& through, double degrees) : lens(through) {
    const Eigen::Vector3d to_it = platform::rotation_y(degrees) * Eigen::Vector3d(0, 0, 0.8);
    pose.rotation =
        platform::rotation_y(degrees) * platform::rotation_z(13) * platform::rotation_x(8);
    pose.translation = to_it - pose.rotation * Eigen::Vector3d(side / 2, side / 2, 0);
    double left = 640, right = 0;
    for (const Point corner : corners()) {
      left = std::min(left, corner.x - 10);
      right = std::max(right, corner.x + 10);
    }
    for (int y = 150; y < 330; ++y) {
      for (int x = std::max(0, static_cast<int>(left)); x < std::min(640.0, right); ++x)
        image.pixels[static_cast<std::size_t>(y * 640 + x)] = pixel(x, y);
    }
  }

  marker::Quad corners() const {
    marker::Quad seen{};
    for (unsigned i = 0; i < 4; ++i) {
      const Eigen::Vector3d place(i == 1 || i == 2 ? side : 0, i >= 2 ? side : 0, 0);
      const Eigen::Vector3d p = platform::transform(pose, place);
      const marker::Camera& c = lens.camera;
      seen[i] = marker::distort(lens, {c.fx * p.x() / p.z() + c.cx, c.fy * p.y() / p.z() + c.cy});
    }
    return seen;
  }

 private:
  std::uint8_t pixel(int x, int y) const {
    constexpr int samples = 6;
    int dark = 0;
    for (int i = 0; i < samples * samples; ++i) {
      Point ideal{};
      std::uint32_t steps = 0;
      // Whole rows. NOLINTNEXTLINE(bugprone-integer-division)
      const Point at{x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples};
      if (marker::undistort(lens, at, ideal, steps) && is_dark(ideal)) ++dark;
    }
    return static_cast<std::uint8_t>(220 - 190 * dark / (samples * samples));
  }

  bool is_dark(Point ideal) const {
    const Eigen::Vector3d ray((ideal.x - lens.camera.cx) / lens.camera.fx,
                              (ideal.y - lens.camera.cy) / lens.camera.fy, 1);
    const Eigen::Vector3d normal = pose.rotation.col(2);
    const Eigen::Vector3d hit = normal.dot(pose.translation) / normal.dot(ray) * ray;
    const Eigen::Vector3d place = pose.rotation.transpose() * (hit - pose.translation);
    const double u = place.x() / side * 6, v = place.y() / side * 6;
    if (!(u >= 0 && v >= 0 && u < 6 && v < 6)) return false;
    const int row = static_cast<int>(v) - 1, column = static_cast<int>(u) - 1;
    if (row < 0 || column < 0 || row > 3 || column > 3) return true;
    return (dictionary.words[7] >> (15 - row * 4 - column) & 1) != 0;
  }
};

std::unique_ptr<marker::Detections> detect(const OffAxis& shown, const GeneralLens& lens) {
  auto detector = std::make_unique<marker::MarkerDetector>();
  auto found = std::make_unique<marker::Detections>();
  marker::DetectorOptions options;
  options.board.marker_side = side;
  detector->open(dictionary, options);
  marker::Optics optics{};
  optics.lens = lens;
  optics.light = marker::linear_light();
  marker::CameraFrame frame{pictures::view(shown.image), {lens.camera}};
  frame.optics = &optics;
  const std::vector<std::uint32_t> words = pictures::words_of(pictures::find_blobs(frame.image));
  detector->find_markers(frame, {words.data(), static_cast<std::uint32_t>(words.size() / 8)},
                         *found);
  detector->find_poses(lens.camera, *found);
  return found;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(lens_models)

BOOST_AUTO_TEST_CASE(functions_are_those_of_the_library) {
  for (double x = 0; x <= 1.5; x += 0.01) {
    BOOST_TEST(std::abs(marker::tangent(x) - std::tan(x)) <= 1e-13 * (1 + std::tan(x)));
    BOOST_TEST(std::abs(marker::angle_of(std::tan(x)) - x) < 2e-15);
  }
  BOOST_TEST(std::abs(marker::angle_of(1e300) - std::acos(0)) < 1e-15);
  for (double x = 1e-5; x < 1e5; x *= 1.7)
    BOOST_TEST(std::abs(marker::logarithm(x) - std::log(x)) < 2e-14);
  for (double x = -20; x < 20; x += 0.37)
    BOOST_TEST(std::abs(marker::exponential(x) / std::exp(x) - 1) < 3e-13);
  for (double e = 0.5; e < 5; e += 0.5)
    BOOST_TEST(std::abs(marker::power(0.3, e) / std::pow(0.3, e) - 1) < 1e-12);
}

BOOST_AUTO_TEST_CASE(pictures_are_bent_as_opencv_bends_them) {
  for (const GeneralLens& lens : lenses) {
    for (const Point ideal : grid()) {
      BOOST_TEST(distance(marker::distort(lens, ideal), by_opencv(lens, ideal)) < 1e-9,
                 "model " << static_cast<int>(lens.model) << " at " << ideal.x << ", " << ideal.y);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_bent_is_straightened) {
  for (const GeneralLens& lens : lenses) {
    for (const Point ideal : grid()) {
      Point back{};
      std::uint32_t steps = 0;
      BOOST_TEST_REQUIRE(marker::undistort(lens, marker::distort(lens, ideal), back, steps));
      BOOST_TEST(distance(back, ideal) < 1e-6);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_general_lens_may_be_a_plain_one) {
  const marker::Lens plain{camera, -0.3, 0.12, 0.001, -0.002, -0.03};
  for (const Point ideal : grid())
    BOOST_TEST(distance(marker::distort(lenses[0], ideal), marker::distort(plain, ideal)) < 1e-9);
  BOOST_TEST((GeneralLens{camera, LensModel::rational, {}}.is_pinhole()));
  BOOST_TEST(!lenses[4].is_pinhole(), "an equidistant lens bends without any coefficient");
}

BOOST_AUTO_TEST_CASE(what_a_model_does_not_have_is_refused) {
  Point ideal{};
  std::uint32_t steps = 0;
  const auto has = [&](const GeneralLens& lens, double r) {
    return marker::undistort(lens, {camera.cx + r * camera.fx, camera.cy}, ideal, steps);
  };
  // Folds at r = 0.577, which is seen at 0.385.
  const GeneralLens folded{camera, LensModel::rational, {-1, 0, 0, 0, 0, 0, 0, 0, 0}};
  BOOST_TEST(has(folded, 0.38));
  BOOST_TEST(!has(folded, 0.39));
  // Its denominator is 0 at r = 1.
  const GeneralLens pole{camera, LensModel::rational, {0, 0, 0, 0, 0, -1}};
  BOOST_TEST(has(pole, 0.5));
  BOOST_TEST(!has(pole, 1.01));
  // Its angle falls behind 0.577 rad.
  const GeneralLens turned{camera, LensModel::equidistant, {-1}};
  BOOST_TEST(has(turned, 0.38));
  BOOST_TEST(!has(turned, 0.39));
  BOOST_TEST(has(lenses[4], 1.30));
  BOOST_TEST(!has(lenses[4], 1.32), "beyond the widest angle");
}

/// As the way across a line grows: against differences of what undistort() says.
BOOST_AUTO_TEST_CASE(a_gradient_is_that_of_the_way_across) {
  const Point across{0.6, 0.8};
  for (const GeneralLens& lens : lenses) {
    for (const Point ideal : grid()) {
      const Point gradient = marker::gradient(lens, ideal, across);
      const Point seen = marker::distort(lens, ideal);
      const auto way = [&](double x, double y) {
        Point at{};
        std::uint32_t steps = 0;
        BOOST_TEST_REQUIRE(marker::undistort(lens, {seen.x + x, seen.y + y}, at, steps));
        return marker::dot(at - ideal, across);
      };
      BOOST_TEST(std::abs((way(0.1, 0) - way(-0.1, 0)) / 0.2 - gradient.x) < 1e-3);
      BOOST_TEST(std::abs((way(0, 0.1) - way(0, -0.1)) / 0.2 - gradient.y) < 1e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(markers_are_found_far_off_the_axis_of_a_fisheye_lens) {
  const GeneralLens fisheye{
      {250, 250, 320, 240}, LensModel::equidistant, {-0.02, 0.005, -0.002, 0.0003}};
  for (const double degrees : {0.0, 40.0, 55.0}) {
    const OffAxis shown(fisheye, degrees);
    const auto found = detect(shown, fisheye);
    BOOST_TEST_REQUIRE(found->count == 1u, degrees << " degrees");
    const marker::Detection& one = found->markers[0];
    BOOST_TEST(one.marker.id == 7);
    const marker::Quad corners = shown.corners();
    for (unsigned i = 0; i < 4; ++i)
      BOOST_TEST(distance(one.marker.fit.image[i], corners[i]) < 0.03);
    for (int i = 0; i < 3; ++i)
      BOOST_TEST(std::abs(one.pose.best.translation[static_cast<unsigned>(i)] -
                          shown.pose.translation[i]) < 1e-3);
  }
}

/// Four numbers of a fisheye lens in another model's place: no pose that looks like one.
BOOST_AUTO_TEST_CASE(another_lens_is_not_as_good) {
  const GeneralLens fisheye{{250, 250, 320, 240}, LensModel::equidistant, {-0.02, 0.005}};
  GeneralLens other = fisheye;
  other.model = LensModel::brown_conrady;
  const OffAxis shown(fisheye, 40);
  BOOST_TEST(detect(shown, fisheye)->count == 1u);
  const auto found = detect(shown, other);
  for (std::uint32_t i = 0; i < found->count; ++i) {
    const auto& translation = found->markers[i].pose.best.translation;
    BOOST_TEST(std::abs(translation[2] - shown.pose.translation[2]) > 0.05);
  }
}

BOOST_AUTO_TEST_SUITE_END()
