#include <boost/test/unit_test.hpp>
#include <cmath>

#include <marker/scene/renderer.h>

using namespace platform;

BOOST_AUTO_TEST_SUITE(convex_region)

BOOST_AUTO_TEST_CASE(an_upright_edge_covers_its_exact_share) {
  for (int hundredth = 0; hundredth <= 100; ++hundredth) {
    const double position = 10 + hundredth / 100.0;
    PixelPiece piece(10, 20);
    piece.clip(HalfPlane{1, 0, -position});
    BOOST_TEST(std::abs(piece.area() - (11 - position)) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_diagonal_halves_the_pixel) {
  PixelPiece piece(5, 7);
  piece.clip(HalfPlane{1, -1, 2});  // x - 5 >= y - 7
  BOOST_TEST(std::abs(piece.area() - 0.5) < 1e-15);
  piece.clip(HalfPlane{-1, -1, 13});  // (x - 5) + (y - 7) <= 1
  BOOST_TEST(std::abs(piece.area() - 0.25) < 1e-15);
}

BOOST_AUTO_TEST_CASE(nothing_is_left_outside) {
  PixelPiece piece(5, 7);
  piece.clip(ConvexRegion{{1, 0, -9}, {0, 1, 0}});
  BOOST_TEST(piece.area() == 0);
}

BOOST_AUTO_TEST_CASE(spans_of_an_upright_rectangle) {
  // x from 2.5 to 6.25, y from 1 to 3.5
  const ConvexRegion region{{1, 0, -2.5}, {-1, 0, 6.25}, {0, 1, -1}, {0, -1, 3.5}};
  BOOST_TEST(touched_pixels(region, 1, 10).first == 2);
  BOOST_TEST(touched_pixels(region, 1, 10).last == 7);
  BOOST_TEST(inner_pixels(region, 1, 10).first == 3);
  BOOST_TEST(inner_pixels(region, 1, 10).last == 6);
  BOOST_TEST(touched_pixels(region, 3, 10).last == 7);
  BOOST_TEST(inner_pixels(region, 3, 10).last == 0);
  BOOST_TEST(touched_pixels(region, 0, 10).last == 0);
  BOOST_TEST(touched_pixels(region, 4, 10).last == 0);
  BOOST_TEST(touched_pixels(region, 1, 5).last == 5);
}

BOOST_AUTO_TEST_CASE(pixel_pieces_add_up_to_the_polygon) {
  // A triangle (1, 1), (9, 2), (4, 8): area 26.5.
  const ConvexRegion region{{-1.0, 8.0, -7.0}, {-6.0, -5.0, 64.0}, {7.0, -3.0, -4.0}};
  double sum = 0;
  for (int y = 0; y < 10; ++y) {
    const PixelSpan touched = touched_pixels(region, y, 10);
    for (int x = touched.first; x < touched.last; ++x) {
      PixelPiece piece(x, y);
      piece.clip(region);
      sum += piece.area();
    }
    const PixelSpan inner = inner_pixels(region, y, 10);
    for (int x = inner.first; x < inner.last; ++x) {
      PixelPiece piece(x, y);
      piece.clip(region);
      BOOST_TEST(std::abs(piece.area() - 1) < 1e-12);
    }
  }
  BOOST_TEST(std::abs(sum - 26.5) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
