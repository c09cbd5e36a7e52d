// Rules of the corner detection that need a picture of their own.
#include <pl/corner_detection/core.h>
#include <boost/test/unit_test.hpp>

#include "detection_kit.h"

using namespace detection_kit;

BOOST_AUTO_TEST_SUITE(corner_rules)

BOOST_AUTO_TEST_CASE(centres_lie_four_pixels_inside_the_frame) {
  Image image = plain(200);
  for (const int x : {3, 60}) dot(image, x, 20, 10);
  for (const int y : {3, 60}) dot(image, 30, y, 10);
  BOOST_TEST(corners(image).empty());
  for (const int x : {4, 59}) dot(image, x, 40, 10);
  for (const int y : {4, 59}) dot(image, 15, y, 10);
  const unsigned strength = 16 * (200 - 10 - 30) / 4;
  const std::vector<Found> expected{
      {15, 4, strength, 0}, {4, 40, strength, 0}, {59, 40, strength, 0}, {15, 59, strength, 0}};
  BOOST_TEST(corners(image) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(of_equal_neighbours_the_first_in_raster_order_is_the_corner) {
  Image image = plain(200);
  dot(image, 20, 20, 10);
  dot(image, 21, 20, 10);
  dot(image, 40, 20, 10);
  dot(image, 40, 21, 10);
  dot(image, 20, 40, 10);
  dot(image, 19, 41, 10);
  const unsigned s = 16 * 160 / 4;
  const std::vector<Found> expected{{20, 20, s, 0}, {40, 20, s, 0}, {20, 40, s, 0}};
  BOOST_TEST(corners(image) == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(suppression_compares_all_twelve_bits_of_the_strength) {
  // 2560 against 2561: equal once shifted right by two.
  Image image = plain(200);
  dot(image, 20, 20, 10);
  dot(image, 21, 20, 10);
  dot(image, 24, 20, 201);  // on the circle of the second one only
  const std::vector<Found> found = corners(image);
  BOOST_REQUIRE(found.size() == 1u);
  BOOST_TEST(found[0].x == 21u);
  BOOST_TEST(found[0].strength == 2561u / 4);
}

BOOST_AUTO_TEST_CASE(a_bright_spot_is_not_a_corner_and_the_limit_does_not_wrap) {
  Image bright_spot = plain(10);
  dot(bright_spot, 20, 20, 200);
  BOOST_TEST(corners(bright_spot).empty());
  // 230 + 30 = 260: nothing exceeds it. In eight bits it would be 4.
  Image high = plain(255);
  dot(high, 20, 20, 230);
  BOOST_TEST(corners(high).empty());
  // 225 + 30 = 255 is not exceeded either; 224 + 30 is, by one.
  dot(high, 40, 20, 225);
  BOOST_TEST(corners(high).empty());
  dot(high, 40, 40, 224);
  BOOST_TEST(corners(high) == (std::vector<Found>{{40, 40, 4, 0}}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_greatest_strength_fits) {
  Image image = plain(255);
  dot(image, 20, 20, 0);
  BOOST_TEST(corners(image) == (std::vector<Found>{{20, 20, 16 * (255 - 30) / 4, 0}}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_direction_is_where_the_tip_of_the_dark_region_points) {
  // Dark quarters of the plane; the tip lies at their inner end.
  struct Case {
    int sx, sy, ex, ey;  ///< dark
    unsigned direction;
  };
  const Case cases[] = {{32, 32, 63, 63, 0},  // tip at the top left: north before west
                        {0, 32, 31, 63, 0},   // top right: north before east
                        {32, 0, 63, 31, 1},   // bottom left: south before west
                        {0, 0, 31, 31, 1}};   // bottom right: south before east
  for (const Case& c : cases) {
    Image image = plain(200);
    bar(image, c.sx, c.sy, c.ex, c.ey);
    const std::vector<Found> found = corners(image);
    BOOST_REQUIRE(found.size() == 1u);
    BOOST_TEST(found[0].direction == c.direction);
  }
  // A wedge that points to the right, and one that points to the left.
  for (const bool right : {true, false}) {
    Image image = plain(200);
    for (int i = 0; i < 20; ++i) {
      const int x = right ? 40 - i : 24 + i;
      bar(image, x, 32 - i, x, 32 + i);
    }
    unsigned tips = 0;
    for (const Found& f : corners(image)) {
      if (f.y != 32 || (right ? f.x < 38 : f.x > 26)) continue;
      ++tips;
      BOOST_TEST(f.direction == (right ? 2u : 3u));
    }
    BOOST_TEST(tips == 1u);
  }
}

BOOST_AUTO_TEST_CASE(nine_pixels_in_a_row_make_a_corner_eight_do_not) {
  for (unsigned start = 0; start < 16; ++start) {
    const auto run_of = [start](unsigned length) {
      const std::uint32_t bits = ((1u << length) - 1) << start;
      return static_cast<std::uint16_t>(bits | bits >> 16);
    };
    BOOST_TEST(pl::fast::contiguous(run_of(9)));
    BOOST_TEST(!pl::fast::contiguous(run_of(8)));
    BOOST_TEST(pl::fast::contiguous(run_of(16)));
    // Eleven pixels with a gap.
    const auto gap = static_cast<std::uint16_t>(run_of(15) & ~(1u << (start + 7) % 16));
    BOOST_TEST(!pl::fast::contiguous(gap));
  }
  BOOST_TEST(!pl::fast::contiguous(0));
}

BOOST_AUTO_TEST_SUITE_END()
