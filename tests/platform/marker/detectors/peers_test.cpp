// The libraries beside us see what is there, in our coordinates.
#include <marker/detectors/peers.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include <marker/code_book.h>
#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

using namespace platform;
using namespace platform::detectors;

namespace {

MarkerSet markers_of(const char* name) {
  const marker::Dictionary& words = *marker::find_dictionary(name);
  return {words.cells, words.distance, 0, {words.words, words.words + words.size}, marker_side_m};
}

/// The marker seen from the front, 30 px a cell, on white.
GreyImage drawn(const MarkerSet& markers, std::size_t id) {
  constexpr std::uint32_t cell = 30, margin = 60;
  const std::uint32_t cells = markers.cells + 2 * markers.border;
  const std::uint32_t side = cells * cell + 2 * margin;
  GreyImage image{static_cast<int>(side), static_cast<int>(side), {}};
  image.pixels.assign(std::size_t{side} * side, 230);
  for (std::uint32_t y = 0; y < cells * cell; ++y) {
    for (std::uint32_t x = 0; x < cells * cell; ++x) {
      const std::uint32_t row = y / cell - markers.border, column = x / cell - markers.border;
      const bool border = row >= markers.cells || column >= markers.cells;
      const std::uint32_t place = row * markers.cells + column;
      const bool black =
          border || (markers.words[id] >> (markers.cells * markers.cells - 1 - place) & 1) != 0;
      if (black) image.pixels[(y + margin) * side + x + margin] = 20;
    }
  }
  return image;
}

double corner_error(const SeenMarker& seen, const GroundTruth& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += std::hypot(seen.corners_px[i].x - truth.corners_px[i].x,
                      seen.corners_px[i].y - truth.corners_px[i].y);
  return sum / 4;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(peers)

// In an orientation that no quarter turn hides; a mistake in axes, origin or order of corners would
// be hundreds of mm, degrees or px. Every library's half pixel is looked at: refined corners are
// nearer.
BOOST_AUTO_TEST_CASE(each_library_gives_corners_and_pose_as_we_do) {
  Scene scene = make_scene("demo@distance=1m,pitch=20deg,yaw=15deg,roll=40deg");
  const GreyImage image = render(scene);
  const GroundTruth truth = ground_truth(scene);
  const auto all = make_peers(markers_of("4x4_250"));
  BOOST_TEST(all.size() == 4u);
  for (const auto& peer : all) {
    unsigned matches = 0;
    for (const SeenMarker& seen : peer->find(image, scene.camera)) {
      if (seen.id != truth.marker_id || corner_error(seen, truth) > 5) continue;
      ++matches;
      BOOST_TEST_CONTEXT(peer->name()) {
        BOOST_TEST(corner_error(seen, truth) < (peer->name() == "opencv" ? 1.2 : 0.4));
        BOOST_TEST_REQUIRE(seen.pose.has_value());
        BOOST_TEST(translation_error_mm(*seen.pose, truth.pose) < 30);
        BOOST_TEST(rotation_error_deg(*seen.pose, truth.pose) < 3);
      }
    }
    BOOST_TEST(matches == 1u, peer->name() << " found it " << matches << " times");
  }
}

// AprilTag's bits are in an order of its own, for even and odd sides. One marker of each has a
// border two cells wide.
BOOST_AUTO_TEST_CASE(every_dictionary_is_read_by_every_library) {
  for (const char* name : {"4x4_50", "5x5_100", "6x6_250", "7x7_1000", "apriltag_36h11",
                           "apriltag_25h9", "aruco_mip_36h12"}) {
    MarkerSet markers = markers_of(name);
    for (const std::uint32_t border : {1U, 2U}) {
      markers.border = border;
      const auto all = make_peers(markers);
      std::vector<std::size_t> ids{0, markers.words.size() - 1};
      if (border == 2) ids = {17};
      for (const std::size_t id : ids) {
        const GreyImage image = drawn(markers, id);
        for (const auto& peer : all) {
          const auto seen = peer->find(image, Camera::for_resolution(image.width, image.height));
          BOOST_TEST_CONTEXT(name << ", " << peer->name() << ", ID " << id) {
            BOOST_TEST_REQUIRE(seen.size() == 1u);
            BOOST_TEST(seen[0].id == static_cast<int>(id));
            BOOST_TEST(std::abs(seen[0].corners_px[0].x - 60) < 2, "upright: top left comes first");
            BOOST_TEST(std::abs(seen[0].corners_px[0].y - 60) < 2);
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_found_in_an_empty_image) {
  const GreyImage image{64, 48, std::vector<std::uint8_t>(std::size_t{64} * 48, 128)};
  for (const auto& peer : make_peers(markers_of("4x4_250")))
    BOOST_TEST(peer->find(image, Camera::for_resolution(64, 48)).empty(), peer->name());
}

BOOST_AUTO_TEST_SUITE_END()
