#include <marker/marker_detector.h>
#include <marker/scene/renderer.h>
#include <marker/work.h>
#include <vp/random.h>

#include <blob_stream.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

#include "fake_hal.h"
#include "pictures.h"
#include "views.h"

using marker::BlobList;
using marker::Board;
using marker::Detections;
using marker::DetectorOptions;
using marker::Refusal;
using platform::GreyImage;
using platform::Scene;

namespace {

const marker::Camera thesis_camera{381.36, 381.36, 320, 240};

struct Fixture {
  Fixture() { fake_hal::reset(); }

  std::unique_ptr<marker::MarkerDetector> detector = std::make_unique<marker::MarkerDetector>();
  std::unique_ptr<Detections> found = std::make_unique<Detections>();

  void open(const DetectorOptions& options = {}, const char* dictionary = "4x4_250") {
    detector->open(*marker::find_dictionary(dictionary), options);
  }

  void detect(const GreyImage& picture, const std::vector<std::uint32_t>& words,
              bool in_dma_memory = false) {
    const BlobList blobs{words.data(),
                         static_cast<std::uint32_t>(words.size() / blob_stream::words_per_blob)};
    detector->find_markers({pictures::view(picture), {thesis_camera}, in_dma_memory}, blobs,
                           *found);
    detector->find_poses(thesis_camera, *found);
    const marker::BlobCounts& counts = found->blobs;
    const std::uint32_t refused = std::accumulate(counts.refused.begin(), counts.refused.end(), 0u);
    BOOST_TEST(counts.received == blobs.count);
    BOOST_TEST(counts.malformed + counts.small + refused + counts.lost + found->count ==
               counts.received);
    BOOST_TEST(counts.refused[0] == 0u);
  }

  void detect(const GreyImage& picture) {
    detect(picture, pictures::words_of(pictures::find_blobs(pictures::view(picture), 127, 8)));
  }

  std::uint32_t refused(Refusal reason) const {
    return found->blobs.refused[static_cast<std::uint32_t>(reason)];
  }
};

/// The words of a blob of so many pixels: an upright rectangle.
std::vector<std::uint32_t> box(std::uint32_t left, std::uint32_t top, std::uint32_t width,
                               std::uint32_t height) {
  const std::uint32_t right = left + width - 1, bottom = top + height - 1;
  const auto point = blob_stream::point;
  return {point(left, top),    point(right, top),   point(right, top), point(right, bottom),
          point(left, bottom), point(left, bottom), point(left, top),  point(left, top)};
}

GreyImage empty_picture(int width, int height, std::uint8_t level = 200) {
  return {width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, level)};
}

/// Upright, 4 px a cell, on white.
void draw_marker(GreyImage& picture, int id, int left, int top) {
  const std::uint16_t word = platform::marker_word(id);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      const int row = y / 4 - 1, column = x / 4 - 1;
      const bool inside = row >= 0 && row < 4 && column >= 0 && column < 4;
      const bool black = !inside || platform::is_black(word, row, column);
      picture.pixels[static_cast<std::size_t>(top + y) * picture.width + left + x] =
          black ? 20 : 200;
    }
  }
}

DetectorOptions grid_options() {
  DetectorOptions options;
  options.board.kind = Board::Kind::grid;
  options.board.grid = {5, 2, 0.3, 0.26, 0};
  return options;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(marker_detector, Fixture)

BOOST_AUTO_TEST_CASE(every_marker_of_a_frame_with_its_pose) {
  const Scene scene = pictures::ten_markers();
  open();
  detect(platform::render(scene));
  BOOST_REQUIRE(found->count == 10u);
  std::vector<bool> seen(10);
  for (std::uint32_t i = 0; i < found->count; ++i) {
    const marker::Detection& detection = found->markers[i];
    const int id = detection.marker.id;
    BOOST_REQUIRE(id < 10);
    BOOST_TEST(!seen[static_cast<std::size_t>(id)]);
    seen[static_cast<std::size_t>(id)] = true;
    BOOST_REQUIRE(detection.pose.valid);
    const Eigen::Vector3d place(id % 5 * 0.56, id / 5 * 0.56, 0);
    const Eigen::Vector3d truth = scene.pose.rotation * place + scene.pose.translation;
    BOOST_TEST((views::translation_of(detection.pose.best) - truth).norm() < 0.01);
    BOOST_TEST(detection.marker.fit.covariance[0] > 0);
  }
  BOOST_TEST(!found->board.valid);
}

BOOST_AUTO_TEST_CASE(a_board_has_one_pose_from_all_of_its_markers) {
  const Scene scene = pictures::ten_markers();
  open(grid_options());
  detect(platform::render(scene));
  BOOST_TEST(found->count == 10u);
  BOOST_TEST(found->board_markers == 10u);
  BOOST_REQUIRE(found->board.valid);
  BOOST_TEST(!found->markers[0].pose.valid);
  const marker::BoardPose& pose = found->board.best;
  BOOST_TEST((views::translation_of(pose) - scene.pose.translation).norm() < 0.001);
  BOOST_TEST(views::angle_between(views::rotation_of(pose), scene.pose.rotation) < 0.1);
}

BOOST_AUTO_TEST_CASE(markers_that_are_not_on_the_board_do_not_count) {
  DetectorOptions options = grid_options();
  options.board.grid.rows = 1;
  open(options);
  detect(platform::render(pictures::ten_markers()));
  BOOST_TEST(found->count == 10u);
  BOOST_TEST(found->board_markers == 5u);
  options.board.grid.first_id = 100;
  open(options);
  detect(platform::render(pictures::ten_markers()));
  BOOST_TEST(found->board_markers == 0u);
  BOOST_TEST(!found->board.valid);
}

BOOST_AUTO_TEST_CASE(an_id_that_is_seen_twice_says_nothing_of_the_board) {
  Scene scene = pictures::ten_markers();
  scene.squares.back().word = platform::marker_word(3);  // ID 9 is 3, too
  open(grid_options());
  detect(platform::render(scene));
  BOOST_TEST(found->count == 10u);
  BOOST_TEST(found->board_markers == 8u);
  BOOST_REQUIRE(found->board.valid);
  BOOST_TEST((views::translation_of(found->board.best) - scene.pose.translation).norm() < 0.001);
}

BOOST_AUTO_TEST_CASE(charuco_boards_are_known_too) {
  Board board;
  board.kind = Board::Kind::charuco;
  board.charuco = {5, 7, 0.04, 0.03, false};
  marker::Places places{};
  BOOST_TEST(board.find(0, places));
  BOOST_TEST(!board.find(17, places));
  board.kind = Board::Kind::none;
  BOOST_TEST(!board.find(0, places));
}

BOOST_AUTO_TEST_CASE(frames_without_blobs_are_results) {
  open(grid_options());
  detect(empty_picture(640, 480), {});
  BOOST_TEST(found->count == 0u);
  BOOST_TEST(!found->board.valid);
}

BOOST_AUTO_TEST_CASE(coordinates_outside_of_the_picture_are_never_followed) {
  open();
  const GreyImage picture = empty_picture(64, 48);
  std::vector<std::uint32_t> words = box(20, 10, 20, 20);
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (const std::uint32_t wrong :
         {blob_stream::point(64, 10), blob_stream::point(20, 48), 0xFFFF'FFFFu}) {
      std::vector<std::uint32_t> hostile = words;
      hostile[i] = wrong;
      detect(picture, hostile, true);
      BOOST_TEST(found->blobs.malformed == 1u);
    }
  }
  BOOST_TEST(fake_hal::state().invalidated.empty());
}

BOOST_AUTO_TEST_CASE(points_that_are_no_extremes_are_malformed) {
  open();
  const GreyImage picture = empty_picture(64, 48);
  for (std::size_t i = 0; i < 8; ++i) {
    std::vector<std::uint32_t> words = box(20, 10, 20, 20);
    words[i] = blob_stream::point(26, 14);  // inside: another one is farther out
    detect(picture, words);
    BOOST_TEST(found->blobs.malformed == 1u, "extreme " << i);
  }
}

BOOST_AUTO_TEST_CASE(any_words_are_counted_and_do_no_harm) {
  open();
  vp::RandomBits random(3);
  GreyImage picture = empty_picture(320, 240);
  for (auto& pixel : picture.pixels) pixel = static_cast<std::uint8_t>(random.next() >> 56);
  std::vector<std::uint32_t> words;
  for (int i = 0; i < 500 * 8; ++i) {
    const auto bits = static_cast<std::uint32_t>(random.next() >> 32);
    words.push_back(blob_stream::point(bits % 340, (bits >> 10) % 250));
  }
  for (std::uint32_t side = 1; side < 200; ++side) {
    const std::vector<std::uint32_t> blob = box(side % 50, side % 40, side, side);
    words.insert(words.end(), blob.begin(), blob.end());
  }
  detect(picture, words, true);
  BOOST_TEST(found->count == 0u);
  BOOST_TEST(found->blobs.malformed > 400u);
  BOOST_TEST(found->blobs.small > 5u);
}

BOOST_AUTO_TEST_CASE(small_and_flat_blobs_cost_no_pixel) {
  open();
  const GreyImage picture = empty_picture(640, 480);
  std::vector<std::uint32_t> words = box(20, 10, 8, 300);
  const std::vector<std::uint32_t> flat = box(20, 10, 300, 8);
  words.insert(words.end(), flat.begin(), flat.end());
  // A slanted line has a large box, and no corner on either side.
  const std::uint32_t from = blob_stream::point(100, 100), to = blob_stream::point(160, 160);
  const std::vector<std::uint32_t> line = {from, from, to, to, to, from, from, from};
  words.insert(words.end(), line.begin(), line.end());
  detect(picture, words, true);
  BOOST_TEST(found->blobs.small == 2u);
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::code_cells)] == 0u);
  BOOST_TEST(found->count == 0u);
}

/// What a DMA engine wrote is not in the caches as it is in memory: all pixels that matter must
/// have been invalidated. The others are made noise, and nothing changes.
BOOST_AUTO_TEST_CASE(every_pixel_that_is_read_was_invalidated) {
  Scene scene = pictures::ten_markers();
  scene.pose.rotation = platform::rotation_y(25) * platform::rotation_z(15);
  scene.pose.translation = {-1.1, -0.9, 3.2};
  GreyImage picture = platform::render(scene);
  const std::vector<std::uint32_t> words =
      pictures::words_of(pictures::find_blobs(pictures::view(picture), 127, 8));
  open();
  detect(picture, words, true);
  BOOST_REQUIRE(found->count == 10u);
  const auto first = std::make_unique<Detections>(*found);
  std::vector<bool> fresh(picture.pixels.size());
  for (const auto& [data, size] : fake_hal::state().invalidated) {
    const std::ptrdiff_t at = static_cast<const std::uint8_t*>(data) - picture.pixels.data();
    BOOST_REQUIRE(at >= 0);
    BOOST_REQUIRE(static_cast<std::size_t>(at) + size <= fresh.size());
    std::fill_n(fresh.begin() + at, size, true);
  }
  vp::RandomBits random(5);
  std::size_t stale = 0;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (fresh[i]) continue;
    picture.pixels[i] = static_cast<std::uint8_t>(random.next() >> 56);
    ++stale;
  }
  BOOST_TEST(stale > fresh.size() / 4);
  detect(picture, words, true);
  BOOST_REQUIRE(found->count == first->count);
  BOOST_TEST((found->blobs.refused == first->blobs.refused));
  for (std::uint32_t i = 0; i < found->count; ++i) {
    BOOST_TEST(found->markers[i].marker.id == first->markers[i].marker.id);
    BOOST_TEST(
        (found->markers[i].marker.fit.covariance == first->markers[i].marker.fit.covariance));
  }
}

BOOST_AUTO_TEST_CASE(of_more_markers_than_there_is_room_for_the_rest_is_counted) {
  GreyImage picture = empty_picture(1280, 720);
  int drawn = 0;
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column, ++drawn) {
      draw_marker(picture, drawn % 250, 20 + column * 60, 10 + row * 46);
    }
  }
  BOOST_REQUIRE(drawn == 300);
  open();
  detect(picture);
  BOOST_TEST(found->count == marker::max_detections);
  BOOST_TEST(found->blobs.lost == 300 - marker::max_detections);
}

BOOST_AUTO_TEST_CASE(of_a_marker_in_two_blobs_the_better_one_stays) {
  const auto seen = [](std::uint16_t id, double left, double variance) {
    marker::Detection marker{};
    marker.marker.id = id;
    marker.marker.fit.image = {{{left, 0}, {left + 40, 0}, {left + 40, 40}, {left, 40}}};
    marker.marker.fit.covariance[0] = variance;
    return marker;
  };
  const auto twice = static_cast<std::size_t>(Refusal::twice);
  marker::clear(*found);
  marker::add_marker(seen(7, 100, 0.02), *found);
  marker::add_marker(seen(7, 108, 0.01), *found);
  BOOST_TEST_REQUIRE(found->count == 1u);
  BOOST_TEST(found->markers[0].marker.fit.image[0].x == 108);
  marker::add_marker(seen(7, 104, 0.02), *found);
  BOOST_TEST(found->markers[0].marker.fit.image[0].x == 108);
  BOOST_TEST(found->blobs.refused[twice] == 2u);
  marker::add_marker(seen(8, 104, 0.01), *found);  // another marker, or a wrong ID
  marker::add_marker(seen(7, 119, 0.01), *found);  // another place
  BOOST_TEST(found->count == 3u);
  BOOST_TEST(found->blobs.refused[twice] == 2u);
}

BOOST_AUTO_TEST_CASE(a_marker_that_the_border_cuts_is_refused) {
  GreyImage whole = empty_picture(120, 120);
  draw_marker(whole, 7, 50, 50);
  open();
  detect(whole);
  BOOST_REQUIRE(found->count == 1u);
  GreyImage cut = empty_picture(120, 120);
  for (int y = 0; y < 120; ++y) {  // the columns from 56 on
    for (int x = 0; x < 64; ++x) {
      cut.pixels[static_cast<std::size_t>(y) * 120 + x] =
          whole.pixels[static_cast<std::size_t>(y) * 120 + x + 56];
    }
  }
  detect(cut);
  BOOST_TEST(found->count == 0u);
  BOOST_TEST(refused(Refusal::hidden) == 1u);
}

BOOST_AUTO_TEST_CASE(a_marker_that_fills_the_picture_is_found_or_refused) {
  Scene scene;
  for (const double depth : {0.2, 0.24, 0.26, 0.3}) {
    scene.pose = platform::pose_from_centre(platform::rotation_z(0), {0, 0, depth});
    open();
    detect(platform::render(scene));
    BOOST_TEST(found->count == (depth > 0.25 ? 1u : 0u), "at " << depth << " m");
  }
}

BOOST_AUTO_TEST_SUITE_END()
