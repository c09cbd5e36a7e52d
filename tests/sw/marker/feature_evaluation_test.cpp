#include <marker/feature_evaluation.h>
#include <marker/work.h>

#include <boost/test/unit_test.hpp>
#include <memory>

#include "fake_hal.h"

using marker::BoundingBox;
using marker::Corner;
using marker::Direction;

namespace {

struct Fixture {
  Fixture() {
    fake_hal::reset();
    features->clear();
  }

  /// Returns the corner's index.
  unsigned corner(unsigned x, unsigned y, Direction direction, unsigned strength = 100) {
    features->push(Corner{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                          static_cast<std::uint16_t>(strength), direction, 0});
    return features->corner_count - 1;
  }

  void blob(const BoundingBox& box) { features->push(box); }

  unsigned evaluate(double margin = 4) {
    marker::evaluate_features(*features, {margin}, *candidates);
    return candidates->count;
  }

  /// The four corners of a box, all suitable.
  void square(unsigned left, unsigned top, unsigned right, unsigned bottom) {
    corner(left, top, Direction::north);
    corner(right, top, Direction::east);
    corner(left, bottom, Direction::west);
    corner(right, bottom, Direction::south);
  }

  std::unique_ptr<marker::FeatureSet> features = std::make_unique<marker::FeatureSet>();
  std::unique_ptr<marker::CandidateList> candidates = std::make_unique<marker::CandidateList>();
};

const BoundingBox box{100, 100, 200, 180, 0};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(feature_evaluation, Fixture)

BOOST_AUTO_TEST_CASE(square_is_a_candidate_by_quadrant) {
  blob(box);
  corner(200, 180, Direction::south);
  corner(100, 180, Direction::west);
  corner(200, 100, Direction::east);
  corner(100, 100, Direction::north);
  BOOST_REQUIRE(evaluate() == 1u);
  const auto& c = candidates->candidates[0];
  BOOST_TEST(c.blob == 0);
  BOOST_TEST(c.corners[marker::top_left] == 3);
  BOOST_TEST(c.corners[marker::top_right] == 2);
  BOOST_TEST(c.corners[marker::bottom_left] == 1);
  BOOST_TEST(c.corners[marker::bottom_right] == 0);
  const marker::Quad quad = marker::candidate_corners(*features, c);
  BOOST_TEST(quad[marker::bottom_left].x == 100);
  BOOST_TEST(quad[marker::bottom_left].y == 180);
  for (unsigned i = 0; i < 4; ++i) BOOST_TEST(features->corners[i].assigned == 1);
}

BOOST_AUTO_TEST_CASE(no_corners_three_corners_no_blobs) {
  blob(box);
  BOOST_TEST(evaluate() == 0u);
  corner(100, 100, Direction::north);
  corner(200, 100, Direction::north);
  corner(100, 180, Direction::south);
  BOOST_TEST(evaluate() == 0u);
  for (unsigned i = 0; i < 3; ++i) BOOST_TEST(features->corners[i].assigned == 0);
  features->blob_count = 0;
  BOOST_TEST(evaluate() == 0u);
}

BOOST_AUTO_TEST_CASE(suitable_directions_of_each_quadrant) {
  const bool suitable[4][4] = {// N, S, E, W
                               {true, false, false, true},
                               {true, false, true, false},
                               {false, true, false, true},
                               {false, true, true, false}};
  for (unsigned quadrant = 0; quadrant < 4; ++quadrant) {
    for (unsigned direction = 0; direction < 4; ++direction) {
      features->clear();
      blob(box);
      square(100, 100, 200, 180);
      features->corners[quadrant].direction = static_cast<Direction>(direction);
      BOOST_TEST(evaluate() == (suitable[quadrant][direction] ? 1u : 0u));
    }
  }
}

BOOST_AUTO_TEST_CASE(margin_reaches_exactly_four_pixels_out) {
  blob(box);
  square(96, 96, 204, 184);
  BOOST_TEST(evaluate() == 1u);
  BOOST_TEST(evaluate(3) == 0u);
  features->corners[0].x = 95;
  BOOST_TEST(evaluate() == 0u);
  BOOST_TEST(evaluate(5) == 1u);
}

BOOST_AUTO_TEST_CASE(score_favours_the_outermost_corner) {
  // C / D: (50/54 + 40/44) 100 = 183.5 outside; (30/54 + 20/44) 150 = 151.5 inside.
  blob(box);
  square(100, 100, 200, 180);
  corner(120, 120, Direction::north, 150);
  BOOST_REQUIRE(evaluate() == 1u);
  BOOST_TEST(candidates->candidates[0].corners[0] == 0);
  // 182 · 1.0101 = 183.8 wins, 181 · 1.0101 = 182.8 does not.
  features->corners[4].strength = 181;
  evaluate();
  BOOST_TEST(candidates->candidates[0].corners[0] == 0);
  features->corners[4].strength = 182;
  evaluate();
  BOOST_TEST(candidates->candidates[0].corners[0] == 4);
  BOOST_TEST(features->corners[0].assigned == 0);  // replaced, free again
}

BOOST_AUTO_TEST_CASE(equal_scores_keep_the_first) {
  blob(box);
  square(100, 100, 200, 180);
  corner(100, 100, Direction::west);
  evaluate();
  BOOST_TEST(candidates->candidates[0].corners[0] == 0);
}

BOOST_AUTO_TEST_CASE(mid_line_belongs_to_both_sides_and_the_first_quadrant_takes_it) {
  blob(box);                                                // centre (150, 140), D = (54, 44)
  const unsigned top = corner(150, 100, Direction::north);  // scores 100 · 40/44 = 90.9
  const unsigned left =
      corner(100, 140, Direction::west, 90);                 // 90 · 50/54 = 83.3: not in top left
  const unsigned right = corner(200, 140, Direction::east);  // top right is tried first
  const unsigned bottom = corner(150, 180, Direction::east, 100);  // bottom left is not suitable
  BOOST_REQUIRE(evaluate() == 1u);
  const auto& c = candidates->candidates[0].corners;
  BOOST_TEST(c[marker::top_left] == top);
  BOOST_TEST(c[marker::top_right] == right);
  BOOST_TEST(c[marker::bottom_left] == left);
  BOOST_TEST(c[marker::bottom_right] == bottom);

  features->corners[left].strength =
      100;  // 92.6: takes top left, and the replaced corner is not offered again
  BOOST_TEST(evaluate() == 0u);
}

BOOST_AUTO_TEST_CASE(corner_on_the_centre_scores_nothing) {
  blob(box);
  square(100, 100, 200, 180);
  features->corners[0].x = 150;
  features->corners[0].y = 140;
  BOOST_TEST(evaluate() == 0u);
}

BOOST_AUTO_TEST_CASE(concave_four_are_no_candidate_and_released) {
  blob(box);
  square(100, 100, 200, 180);
  features->corners[3].x = 151;  // inside the triangle of the other three
  features->corners[3].y = 141;
  features->corners[1].y = 139;
  features->corners[2].x = 149;
  BOOST_TEST(evaluate() == 0u);
  for (unsigned i = 0; i < 4; ++i) BOOST_TEST(features->corners[i].assigned == 0);
}

BOOST_AUTO_TEST_CASE(coincident_corners_are_no_candidate) {
  blob(box);
  corner(150, 100, Direction::north);
  corner(150, 100, Direction::east);
  corner(100, 180, Direction::south);
  corner(200, 180, Direction::south);
  BOOST_TEST(evaluate() == 0u);
}

BOOST_AUTO_TEST_CASE(collinear_corners_are_no_candidate) {
  blob(box);
  square(100, 100, 200, 180);
  features->corners[0] = {150, 100, 100, Direction::north, 0};
  features->corners[2] = {150, 180, 100, Direction::west, 0};
  features->corners[1] = {150, 110, 90, Direction::east, 0};
  BOOST_TEST(evaluate() == 0u);
}

BOOST_AUTO_TEST_CASE(corners_of_a_failed_blob_serve_the_next) {
  blob({60, 60, 210, 190, 0});  // its bottom right quadrant finds a corner that faces the wrong way
  blob(box);
  square(100, 100, 200, 180);
  features->corners[3].direction = Direction::north;
  BOOST_TEST(evaluate() == 0u);
  features->corners[3].direction = Direction::south;
  features->blobs[0].ex = 199 - 4;  // now the first blob misses both right corners
  BOOST_REQUIRE(evaluate() == 1u);
  BOOST_TEST(candidates->candidates[0].blob == 1);
}

BOOST_AUTO_TEST_CASE(corners_of_a_candidate_are_taken) {
  blob(box);
  blob({101, 101, 199, 179, 1});
  square(100, 100, 200, 180);
  BOOST_REQUIRE(evaluate() == 1u);
  BOOST_TEST(candidates->candidates[0].blob == 0);
}

BOOST_AUTO_TEST_CASE(second_evaluation_starts_anew) {
  blob(box);
  square(100, 100, 200, 180);
  BOOST_TEST(evaluate() == 1u);
  BOOST_TEST(evaluate() == 1u);
}

BOOST_AUTO_TEST_CASE(box_at_the_image_border) {
  blob({0, 0, 40, 40, 0});
  square(0, 0, 40, 40);
  BOOST_TEST(evaluate() == 1u);
  features->clear();
  blob({599, 439, 639, 479, 0});
  square(599, 439, 639, 479);
  BOOST_TEST(evaluate() == 1u);
}

BOOST_AUTO_TEST_CASE(box_without_size_gives_nothing) {
  blob({50, 50, 50, 50, 0});
  square(50, 50, 50, 50);
  BOOST_TEST(evaluate(0) == 0u);
  BOOST_TEST(evaluate(4) == 0u);
}

BOOST_AUTO_TEST_CASE(candidates_beyond_capacity_are_counted) {
  const unsigned blobs = marker::max_candidates + 2;
  for (unsigned n = 0; n < blobs; ++n) {
    const auto left = static_cast<std::uint16_t>(n % 60 * 10);
    const auto top = static_cast<std::uint16_t>(n / 60 * 10);
    blob({left, top, static_cast<std::uint16_t>(left + 5), static_cast<std::uint16_t>(top + 5), 0});
    square(left, top, left + 5u, top + 5u);
  }
  evaluate(0);
  BOOST_TEST(candidates->count == marker::max_candidates);
  BOOST_TEST(candidates->lost == 2u);
}

BOOST_AUTO_TEST_CASE(work_is_counted_by_blob_and_corner) {
  blob(box);
  blob({400, 300, 450, 350, 1});
  square(100, 100, 200, 180);
  evaluate();
  const auto work = [](marker::Work item) {
    return fake_hal::state().work[static_cast<std::uint32_t>(item)];
  };
  BOOST_TEST(work(marker::Work::blobs_evaluated) == 2u);
  BOOST_TEST(work(marker::Work::corner_tests) == 8u);
  BOOST_TEST(work(marker::Work::quadrant_tests) == 1u + 2 + 3 + 4);
  BOOST_TEST(work(marker::Work::score_evaluations) == 4u);
  BOOST_TEST(work(marker::Work::candidates) == 1u);
  BOOST_TEST(fake_hal::state().function_stack.empty());
}

BOOST_AUTO_TEST_SUITE_END()
