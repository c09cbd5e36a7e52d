#include <marker/quad_fit.h>
#include <marker/scene/renderer.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "pictures.h"

using marker::Extremes;
using marker::GreyImage;
using marker::Lens;
using marker::Point;
using marker::Quad;
using marker::QuadFit;
using marker::Refusal;

namespace {

constexpr std::uint32_t width = 96, height = 96;
const Lens pinhole{{100, 100, 48, 48}};

/// A grey picture that tests draw into.
struct Picture {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(width * height, 230);

  GreyImage view() const { return {pixels.data(), width, height}; }

  template <class Inside>
  void fill(std::uint8_t level, Inside inside) {
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        if (inside(x + 0.5, y + 0.5)) pixels[y * width + x] = level;
      }
    }
  }
};

/// Whole pixels are dark: its edges are known exactly.
Picture black_square(double left, double top, double side, std::uint8_t level = 20) {
  Picture picture;
  picture.fill(level, [=](double x, double y) {
    return x > left && x < left + side && y > top && y < top + side;
  });
  return picture;
}

Quad square(double left, double top, double side) {
  return {{{left, top}, {left + side, top}, {left + side, top + side}, {left, top + side}}};
}

double farthest(const Quad& a, const Quad& b) {
  double farthest = 0;
  for (unsigned i = 0; i < 4; ++i) {
    farthest = std::max(farthest, std::hypot(a[i].x - b[i].x, a[i].y - b[i].y));
  }
  return farthest;
}

Refusal refusal(const Picture& picture, const Quad& guess, const Lens& lens = pinhole) {
  return marker::fit_quad({picture.view(), lens}, guess, {}).refusal;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(quads_of_blobs)

BOOST_AUTO_TEST_CASE(corners_of_a_rolled_square_whatever_the_angle) {
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double c = std::cos(degrees * 3.14159265358979 / 180) * 20;
    const double s = std::sin(degrees * 3.14159265358979 / 180) * 20;
    const Quad corners = {{{50 - c, 50 - s}, {50 + s, 50 - c}, {50 + c, 50 + s}, {50 - s, 50 + c}}};
    const int directions[8][2] = {{0, -1}, {1, -1}, {1, 0},  {1, 1},
                                  {0, 1},  {-1, 1}, {-1, 0}, {-1, -1}};
    Extremes extremes{};
    for (unsigned i = 0; i < 8; ++i) {
      const Point outermost =
          *std::max_element(corners.begin(), corners.end(), [&](Point a, Point b) {
            return directions[i][0] * a.x + directions[i][1] * a.y <
                   directions[i][0] * b.x + directions[i][1] * b.y;
          });
      extremes[i] = {static_cast<int>(outermost.x), static_cast<int>(outermost.y)};
    }
    Quad quad{};
    BOOST_REQUIRE(marker::largest_quad(extremes, quad));
    // Where the pixels end in which the corners are.
    double nearest = 1e9;
    for (unsigned turns = 0; turns < 4; ++turns) {
      nearest =
          std::min(nearest, farthest(quad, {{corners[turns], corners[(turns + 1) % 4],
                                             corners[(turns + 2) % 4], corners[(turns + 3) % 4]}}));
    }
    BOOST_TEST(nearest < 1.415, "rolled by " << degrees);
  }
}

BOOST_AUTO_TEST_CASE(a_line_is_as_thin_as_its_pixels) {
  Extremes extremes{};
  for (unsigned i = 0; i < 8; ++i) extremes[i] = {i < 4 ? 30 : 10, 20};
  extremes[0] = extremes[7];
  extremes[4] = extremes[3];
  Quad quad{};
  BOOST_REQUIRE(marker::largest_quad(extremes, quad));
  for (const Point corner : quad) BOOST_TEST(std::abs(corner.y - 20.5) <= 0.5);
}

BOOST_AUTO_TEST_CASE(what_turns_anticlockwise_is_no_blob) {
  const Extremes extremes = {
      {{20, 10}, {10, 20}, {10, 40}, {20, 50}, {40, 50}, {50, 40}, {50, 20}, {40, 10}}};
  Quad quad{};
  BOOST_TEST(!marker::largest_quad(extremes, quad));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(edge_lines)

BOOST_AUTO_TEST_CASE(edges_between_whole_pixels_are_exact) {
  const Picture picture = black_square(20, 24, 48);
  for (const double off : {-2.5, -1.0, 0.0, 1.0, 2.5}) {
    const QuadFit fit =
        marker::fit_quad({picture.view(), pinhole}, square(20 + off, 24 - off, 48), {});
    BOOST_TEST(fit.refusal == Refusal::none);
    BOOST_TEST(farthest(fit.ideal, square(20, 24, 48)) < 1e-9, "guess off by " << off);
    BOOST_TEST(fit.dark == 20);
    BOOST_TEST(fit.bright == 230);
    // No better than to the rounding of the grey levels.
    for (unsigned i = 0; i < 8; ++i) BOOST_TEST(fit.covariance[9 * i] > 1e-8);
  }
}

// Rolled, tilted, blurred, noisy: 0.0028 px, and within four standard deviations of the truth.
BOOST_AUTO_TEST_CASE(a_rendered_marker) {
  platform::Scene scene;
  scene.pose = platform::pose_from_centre(platform::rotation_y(30) * platform::rotation_z(40),
                                          {0.1, 0, 1.2});
  scene.blur_sigma_px = 0.5;
  const platform::GreyImage picture = platform::render(scene);
  const Lens lens = pictures::lens_of(scene.camera);
  const pictures::Found found = pictures::find_marker(scene, pictures::view(picture), lens);
  BOOST_REQUIRE(found.found);
  BOOST_TEST_MESSAGE("a rendered marker: " << found.corner_error << " px");
  BOOST_TEST(found.corner_error < 0.01);
  const auto truth = platform::project_marker(scene.camera, scene.pose);
  for (unsigned i = 0; i < 4; ++i) {
    const double sx = std::sqrt(found.fit.covariance[18 * i]);
    const double sy = std::sqrt(found.fit.covariance[18 * i + 9]);
    BOOST_TEST(std::abs(found.fit.ideal[i].x - truth[i].x) < 4 * sx);
    BOOST_TEST(std::abs(found.fit.ideal[i].y - truth[i].y) < 4 * sy);
    BOOST_TEST(sx < 0.02);
    BOOST_TEST(sy < 0.02);
  }
  const auto covariance = [&](unsigned i, unsigned j) { return found.fit.covariance[8 * i + j]; };
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      BOOST_TEST(covariance(i, j) == covariance(j, i), boost::test_tools::tolerance(1e-9));
      BOOST_TEST(covariance(i, j) * covariance(i, j) < covariance(i, i) * covariance(j, j));
    }
  }
  // Corners that do not share a side know nothing of each other.
  BOOST_TEST(covariance(0, 4) == 0);
  BOOST_TEST(covariance(3, 7) == 0);
}

// Where pixels are noisy, strips are narrower: as wide as elsewhere, the mean would be 0.099 px
// instead of 0.064.
BOOST_AUTO_TEST_CASE(noisy_edges_are_measured_less_widely) {
  double sum = 0;
  constexpr unsigned pictures_drawn = 16;
  for (unsigned i = 0; i < pictures_drawn; ++i) {
    platform::Scene scene;
    scene.camera = {200, 200, 381.36, 381.36, 100, 100};
    scene.pose = platform::pose_from_centre(
        platform::rotation_y(25) * platform::rotation_z(20 + 15 * i), {0, 0, 2});
    scene.noise_sigma = 0.1;
    scene.seed = i;
    const platform::GreyImage picture = platform::render(scene);
    const pictures::Found found =
        pictures::find_marker(scene, pictures::view(picture), pictures::lens_of(scene.camera));
    BOOST_TEST_REQUIRE(found.found);
    sum += found.corner_error / pictures_drawn;
  }
  BOOST_TEST_MESSAGE("noisy edges: " << sum << " px");
  BOOST_TEST(sum < 0.08);
}

// The far corner is bent by 34 px; the corners are found within 0.0051 px.
BOOST_AUTO_TEST_CASE(through_a_lens) {
  platform::Scene scene;
  scene.camera = {260, 260, 381.36, 381.36, 20, 10};
  scene.pose = platform::pose_from_centre(platform::rotation_y(-20) * platform::rotation_z(10),
                                          {0.26, 0.28, 0.75});
  Lens lens = pictures::lens_of(scene.camera);
  lens.k1 = -0.25;
  lens.k2 = 0.06;
  lens.p1 = 0.001;
  lens.p2 = -0.0007;
  const platform::GreyImage picture = pictures::render_through(scene, lens);
  const pictures::Found found = pictures::find_marker(scene, pictures::view(picture), lens);
  BOOST_REQUIRE(found.found);
  BOOST_TEST_MESSAGE("through a lens: " << found.corner_error << " px");
  BOOST_TEST(found.corner_error < 0.01);
  const auto truth = platform::project_marker(scene.camera, scene.pose);
  BOOST_TEST(std::hypot(found.fit.image[2].x - truth[2].x, found.fit.image[2].y - truth[2].y) > 30);
  // Without the lens its sides are not straight: the same picture is not measured that well.
  const pictures::Found bent =
      pictures::find_marker(scene, pictures::view(picture), pictures::lens_of(scene.camera));
  BOOST_TEST((!bent.found || bent.corner_error > 1));
}

BOOST_AUTO_TEST_CASE(refused_shape) {
  const Picture picture = black_square(20, 24, 48);
  Quad anticlockwise = square(20, 24, 48);
  std::swap(anticlockwise[1], anticlockwise[3]);
  BOOST_TEST(refusal(picture, anticlockwise) == Refusal::shape);
  BOOST_TEST(refusal(picture, square(20, 24, 8)) == Refusal::shape);
  Lens folded = pinhole;
  folded.k1 = -3;
  BOOST_TEST(refusal(picture, square(0, 0, 90), folded) == Refusal::shape);
  const double nan = std::nan("");
  BOOST_TEST(refusal(picture, square(nan, nan, 48)) == Refusal::shape);
}

BOOST_AUTO_TEST_CASE(refused_hidden) {
  const Picture picture = black_square(60, 24, 48);  // cut by the right border
  BOOST_TEST(refusal(picture, square(60, 24, 36)) == Refusal::hidden);
  BOOST_TEST(refusal(picture, square(300, 300, 48)) == Refusal::hidden);
  BOOST_TEST(refusal(picture, square(-300, 24, 48)) == Refusal::hidden);
}

BOOST_AUTO_TEST_CASE(refused_contrast) {
  BOOST_TEST(refusal(black_square(20, 24, 48, 215), square(20, 24, 48)) == Refusal::contrast);
  BOOST_TEST(refusal(black_square(20, 24, 48, 209), square(20, 24, 48)) == Refusal::none);
  BOOST_TEST(refusal(black_square(20, 24, 48, 255), square(20, 24, 48)) == Refusal::contrast);
}

BOOST_AUTO_TEST_CASE(refused_ragged) {
  Picture picture;
  picture.fill(20, [](double x, double y) { return std::hypot(x - 48, y - 48) < 30; });
  const double half = 30 * 0.886;  // a square of the disc's area
  const Refusal why = refusal(picture, square(48 - half, 48 - half, 2 * half));
  BOOST_TEST((why == Refusal::ragged || why == Refusal::hidden));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(lens_distortion)

BOOST_AUTO_TEST_CASE(there_and_back) {
  const Lens lens{{600, 590, 320, 240}, -0.3, 0.12, 0.001, -0.002, -0.03};
  for (double y = 0; y <= 480; y += 60) {
    for (double x = 0; x <= 640; x += 80) {
      Point ideal{};
      BOOST_REQUIRE(marker::undistort(lens, {x, y}, ideal));
      const Point again = marker::distort(lens, ideal);
      BOOST_TEST(std::hypot(again.x - x, again.y - y) < 1e-7);
    }
  }
}

// x = 0.25, y = -0.1 by hand: r² = 0.0725, radial = 1 + 0.1·0.0725 = 1.00725.
BOOST_AUTO_TEST_CASE(the_model_of_opencv) {
  const Lens lens{{100, 100, 0, 0}, 0.1, 0, 0.01, 0.02, 0};
  const Point seen = marker::distort(lens, {25, -10});
  BOOST_TEST(seen.x == 100 * (0.25 * 1.00725 + 2 * 0.01 * -0.025 + 0.02 * (0.0725 + 0.125)),
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(seen.y == 100 * (-0.1 * 1.00725 + 0.01 * (0.0725 + 0.02) + 2 * 0.02 * -0.025),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(beyond_the_fold_there_is_no_point) {
  const Lens lens{{100, 100, 0, 0}, -1, 0, 0, 0, 0};  // folds at r = 0.577, which is seen at 0.385
  Point ideal{};
  BOOST_TEST(marker::undistort(lens, {38, 0}, ideal));
  BOOST_TEST(!marker::undistort(lens, {39, 0}, ideal));
}

BOOST_AUTO_TEST_SUITE_END()
