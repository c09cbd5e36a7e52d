#include <marker/rectification.h>
#include <marker/work.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "fake_hal.h"
#include "synthetic_image.h"

using marker::Homography;
using marker::Point;
using marker::Quad;

namespace {

/// Top left, top right, bottom left, bottom right of a canonical square.
Quad square(double width) {
  return {{{0, 0}, {width, 0}, {0, width}, {width, width}}};
}

/// A quadrilateral with each corner in its own quarter of the image.
Quad random_quad(std::mt19937& generator) {
  const auto at = [&](double low, double span) { return low + span * (generator() % 1000) / 1000; };
  Quad quad{};
  quad[0] = {at(100, 100), at(80, 100)};
  quad[1] = {at(340, 100), at(80, 100)};
  quad[2] = {at(100, 100), at(300, 100)};
  quad[3] = {at(340, 100), at(300, 100)};
  return quad;
}

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rectification, Fixture)

BOOST_AUTO_TEST_CASE(appendix_d_equals_an_independent_solution) {
  std::mt19937 generator(1);
  for (int n = 0; n < 200; ++n) {
    const Quad corners = random_quad(generator);
    const Homography h = marker::make_homography(corners, 60);
    BOOST_REQUIRE(h.valid);
    const Eigen::Matrix3d expected = synthetic::solve_homography(square(60), corners);
    BOOST_CHECK_SMALL(h.h1 - expected(0, 0), 1e-9);
    BOOST_CHECK_SMALL(h.h2 - expected(0, 1), 1e-9);
    BOOST_CHECK_SMALL(h.u1 - expected(0, 2), 1e-9);
    BOOST_CHECK_SMALL(h.h4 - expected(1, 0), 1e-9);
    BOOST_CHECK_SMALL(h.h5 - expected(1, 1), 1e-9);
    BOOST_CHECK_SMALL(h.v1 - expected(1, 2), 1e-9);
    BOOST_CHECK_SMALL(h.h7 - expected(2, 0), 1e-11);
    BOOST_CHECK_SMALL(h.h8 - expected(2, 1), 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(canonical_corners_map_onto_the_image_corners) {
  std::mt19937 generator(2);
  for (int n = 0; n < 50; ++n) {
    const Quad corners = random_quad(generator);
    const Homography h = marker::make_homography(corners, 24);
    for (unsigned i = 0; i < 4; ++i) {
      Point image{};
      BOOST_REQUIRE(marker::transform(h, square(24)[i], image));
      BOOST_CHECK_SMALL(image.x - corners[i].x, 1e-9);
      BOOST_CHECK_SMALL(image.y - corners[i].y, 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(clockwise_order_would_be_wrong) {
  const Homography h =
      marker::make_homography({{{100, 100}, {200, 110}, {190, 210}, {95, 205}}}, 60);
  Point image{};
  // Given clockwise corners, the canonical bottom right lands on what is the image's bottom left.
  const bool in_front = marker::transform(h, {60, 60}, image);
  BOOST_TEST((!in_front || std::abs(image.x - 190) > 50));
}

BOOST_AUTO_TEST_CASE(degenerate_corners_are_flagged) {
  BOOST_TEST(!marker::make_homography({{{5, 5}, {5, 5}, {5, 5}, {5, 5}}}, 60).valid);
  BOOST_TEST(!marker::make_homography({{{0, 0}, {10, 0}, {20, 0}, {30, 0}}}, 60).valid);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!marker::make_homography({{{0, 0}, {nan, 0}, {0, 9}, {9, 9}}}, 60).valid);
}

BOOST_AUTO_TEST_CASE(points_behind_the_camera_have_no_image) {
  const Homography h{1, 0, 0, 0, 1, 0, -0.1, 0, true};
  Point image{};
  BOOST_TEST(marker::transform(h, {9, 0}, image));
  BOOST_TEST(!marker::transform(h, {10, 0}, image));
  BOOST_TEST(!marker::transform(h, {11, 0}, image));
}

BOOST_AUTO_TEST_CASE(samples_per_cell_of_both_widths) {
  const synthetic::Image image(64, 64);
  marker::CellCounts cells{};
  const Homography h = marker::make_homography({{{2, 2}, {62, 2}, {2, 62}, {62, 62}}}, 60);
  marker::rectify(image.view(true), h, 60, cells);
  BOOST_TEST(cells.samples_per_cell == 64u);
  auto& work = fake_hal::state().work;
  BOOST_TEST(work[static_cast<std::uint32_t>(marker::Work::grid_samples)] == 2304u);
  BOOST_TEST(work[static_cast<std::uint32_t>(marker::Work::grid_samples_dma)] == 2304u);
  marker::rectify(image.view(false), marker::make_homography(square(24), 24), 24, cells);
  BOOST_TEST(cells.samples_per_cell == 4u);
  BOOST_TEST(work[static_cast<std::uint32_t>(marker::Work::grid_samples)] == 2304u + 144u);
  BOOST_TEST(work[static_cast<std::uint32_t>(marker::Work::grid_samples_dma)] == 2304u);
}

BOOST_AUTO_TEST_CASE(samples_lie_at_i_plus_a_half_without_the_outer_ring) {
  // Identity: canonical (i + 0.5, j + 0.5) reads pixel (i + 1, j + 1).
  synthetic::Image image(64, 64);
  marker::CellCounts cells{};
  const Homography identity{1, 0, 0, 0, 1, 0, 0, 0, true};
  for (std::uint32_t x = 0; x < 64; ++x) image.set(x, 2, true);
  marker::rectify(image.view(), identity, 60, cells);
  BOOST_TEST(cells.dark[0][0] == 8u);  // row j = 1, the first that is sampled
  for (std::uint32_t x = 0; x < 64; ++x) image.set(x, 2, false), image.set(x, 1, true);
  marker::rectify(image.view(), identity, 60, cells);
  BOOST_TEST(cells.dark[0][0] == 0u);  // row j = 0 is left out
  for (std::uint32_t y = 0; y < 64; ++y) image.set(10, y, true), image.set(11, y, true);
  marker::rectify(image.view(), identity, 60, cells);
  BOOST_TEST(cells.dark[3][0] == 0u);  // columns i = 9 and 10 are left out
  BOOST_TEST(cells.dark[3][1] == 0u);
}

BOOST_AUTO_TEST_CASE(outside_the_image_is_white) {
  synthetic::Image image(64, 64);
  for (auto& word : image.words()) word = 0xFFFFFFFFu;
  marker::CellCounts cells{};
  marker::rectify(image.view(), {1, 0, -31, 0, 1, -31, 0, 0, true}, 60, cells);
  BOOST_TEST(cells.dark[0][0] == 0u);
  BOOST_TEST(cells.dark[5][5] == 64u);
  BOOST_TEST(cells.dark[3][3] == 64u);  // from canonical 31: image pixel 0 and up
  marker::rectify(image.view(), {1e30, 0, 0, 0, 1e30, 0, 0, 0, true}, 60, cells);
  for (const auto& row : cells.dark) {
    for (const std::uint32_t dark : row) BOOST_TEST(dark == 0u);
  }
}

BOOST_AUTO_TEST_CASE(canonical_width_is_whole_cells_within_limits) {
  BOOST_TEST(marker::canonical_width(60) == 60u);
  BOOST_TEST(marker::canonical_width(24) == 24u);
  BOOST_TEST(marker::canonical_width(50) == 48u);
  BOOST_TEST(marker::canonical_width(0) == 18u);
  BOOST_TEST(marker::canonical_width(-5) == 18u);
  BOOST_TEST(marker::canonical_width(1e12) == 600u);
  BOOST_TEST(marker::canonical_width(std::numeric_limits<double>::quiet_NaN()) == 18u);
}

BOOST_AUTO_TEST_SUITE_END()
