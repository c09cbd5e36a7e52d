#include <marker/marker_search.h>

#include <boost/test/unit_test.hpp>
#include <memory>

#include "fake_hal.h"
#include "synthetic_image.h"

using marker::Candidate;
using marker::Identification;
using marker::Quad;

namespace {

struct Fixture {
  Fixture() { fake_hal::reset(); }
};

/// Pixel indices clockwise from the top left of the image.
const Quad front{{{100, 60}, {219, 60}, {219, 179}, {100, 179}}};
const Quad tilted{{{60, 40}, {170, 72}, {158, 201}, {44, 160}}};

/// The same corners clockwise from the marker's own top left, when the marker is turned by
/// `rotation` quarters.
Quad own_order(const Quad& q, unsigned rotation) {
  return {q[rotation], q[(rotation + 1) % 4], q[(rotation + 2) % 4], q[(rotation + 3) % 4]};
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(marker_search, Fixture)

BOOST_AUTO_TEST_CASE(all_ids_in_all_rotations_from_a_drawn_image) {
  for (unsigned id = 0; id < marker::dictionary_size; ++id) {
    for (unsigned rotation = 0; rotation < 4; ++rotation) {
      const Quad& quad = id % 2 == 0 ? front : tilted;
      synthetic::Image image(256, 224);
      image.draw_marker(marker::dictionary[id], own_order(quad, rotation));
      for (const std::uint32_t width : {60u, 24u}) {
        const Identification found =
            marker::identify_candidate(image.view(), marker::swap_bottom(quad), width);
        BOOST_REQUIRE_MESSAGE(found.found, "id " << id << " rotation " << rotation);
        BOOST_TEST(found.id == id);
        BOOST_TEST(found.rotation == rotation);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(corners_start_at_the_markers_own_top_left) {
  for (unsigned rotation = 0; rotation < 4; ++rotation) {
    const Quad corners = marker::marker_corners(marker::swap_bottom(front), rotation);
    const Quad expected = own_order(front, rotation);
    for (unsigned i = 0; i < 4; ++i) {
      BOOST_TEST(corners[i].x == expected[i].x + 0.5);
      BOOST_TEST(corners[i].y == expected[i].y + 0.5);
    }
  }
}

BOOST_AUTO_TEST_CASE(white_border_cell_is_no_marker) {
  synthetic::Image image(256, 224);
  image.draw_marker(marker::dictionary[99], front, 3);
  BOOST_TEST(!marker::identify_candidate(image.view(), marker::swap_bottom(front), 60).found);
}

BOOST_AUTO_TEST_CASE(degenerate_candidate_is_no_marker) {
  const synthetic::Image image(256, 224);
  BOOST_TEST(
      !marker::identify_candidate(image.view(), {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}}, 60).found);
}

BOOST_AUTO_TEST_CASE(marker_half_outside_the_image_is_no_marker) {
  synthetic::Image image(256, 224);
  const Quad cut{{{-60, 60}, {59, 60}, {59, 179}, {-60, 179}}};
  image.draw_marker(marker::dictionary[99], cut);
  BOOST_TEST(!marker::identify_candidate(image.view(), marker::swap_bottom(cut), 60).found);
}

BOOST_AUTO_TEST_CASE(first_marker_ends_the_search) {
  synthetic::Image image(640, 224);
  auto features = std::make_unique<marker::FeatureSet>();
  auto candidates = std::make_unique<marker::CandidateList>();
  features->clear();
  candidates->lost = 0;
  candidates->count = 3;
  const int ids[] = {-1, 42, 99};  // the first is a plain square
  for (unsigned n = 0; n < 3; ++n) {
    Quad quad = front;
    for (auto& corner : quad) corner.x += 180.0 * n - 60;
    image.draw_marker(ids[n] < 0 ? 0xFFFF : marker::dictionary[ids[n]], own_order(quad, 2));
    Candidate& candidate = candidates->candidates[n];
    const Quad by_quadrant = marker::swap_bottom(quad);
    for (unsigned i = 0; i < 4; ++i) {
      candidate.corners[i] = static_cast<std::uint16_t>(features->corner_count);
      features->push(marker::Corner{static_cast<std::uint16_t>(by_quadrant[i].x),
                                    static_cast<std::uint16_t>(by_quadrant[i].y), 100,
                                    marker::Direction::north, 1});
    }
  }
  const marker::FoundMarker found =
      marker::find_first_marker(*features, *candidates, image.view(true), 60);
  BOOST_TEST(found.found);
  BOOST_TEST(found.candidate == 1u);
  BOOST_TEST(found.examined == 2u);
  BOOST_TEST(found.identity.id == 42);
  BOOST_TEST(found.identity.rotation == 2);
  BOOST_TEST(found.corners[0].x == 219 + 120 + 0.5);  // bottom right of the image
  BOOST_TEST(found.corners[0].y == 179.5);

  candidates->count = 1;
  const marker::FoundMarker none =
      marker::find_first_marker(*features, *candidates, image.view(true), 60);
  BOOST_TEST(!none.found);
  BOOST_TEST(none.examined == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
