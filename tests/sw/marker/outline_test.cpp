#include <marker/marker_detector.h>
#include <marker/optics.h>
#include <marker/outline.h>
#include <marker/response.h>
#include <marker/scene/renderer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <boost/test/unit_test.hpp>

#include "pictures.h"

using marker::Pixel;
using marker::Point;

namespace {

/// A marker, and its picture.
struct Shown {
  platform::Scene scene =
      platform::make_scene("z1.0@distance=1.2m,yaw=20deg,roll=25deg,noise=0,id=7");
  platform::GreyImage image = platform::render(scene);
  std::array<platform::PixelPoint, 4> corners = platform::project_marker(scene.camera, scene.pose);

  /// Draws where `covers` says so.
  void draw(std::uint8_t level, const std::function<bool(double, double)>& covers) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (covers(x + 0.5, y + 0.5))
          image.pixels[static_cast<std::size_t>(y * image.width + x)] = level;
      }
    }
  }
  void draw_disc(std::uint8_t level, double radius) {
    draw(level, [&](double x, double y) {
      return std::hypot(x - corners[0].x, y - corners[0].y) < radius;
    });
  }
};

/// What the detector finds if it tries again, or follows outlines, too.
std::unique_ptr<marker::Detections> detect(const Shown& shown, bool tries_again,
                                           bool reads_outlines,
                                           const char* dictionary = "4x4_250") {
  auto detector = std::make_unique<marker::MarkerDetector>();
  auto found = std::make_unique<marker::Detections>();
  detector->open(*marker::find_dictionary(dictionary), {});
  marker::Optics optics{};
  optics.lens.camera = pictures::lens_of(shown.scene.camera).camera;
  optics.light = marker::linear_light();
  optics.tries_again = tries_again;
  optics.reads_outlines = reads_outlines;
  marker::CameraFrame frame{pictures::view(shown.image), {optics.lens.camera}};
  frame.optics = &optics;
  const std::vector<std::uint32_t> words =
      pictures::words_of(pictures::find_blobs(frame.image, 127, 9));
  detector->find_markers(frame, {words.data(), static_cast<std::uint32_t>(words.size() / 8)},
                         *found);
  return found;
}

/// True if the marker of the scene was found, and nothing else.
bool is_found(const Shown& shown, const marker::Detections& found, double most_px) {
  for (std::uint32_t i = 0; i < found.count; ++i) {
    const marker::DetectedMarker& m = found.markers[i].marker;
    BOOST_TEST(m.id == 7);
    for (unsigned k = 0; k < 4; ++k) {
      const Point seen = m.fit.image[k];
      BOOST_TEST(std::hypot(seen.x - shown.corners[k].x, seen.y - shown.corners[k].y) < most_px);
    }
  }
  return found.count == 1;
}

/// Two markers of 60 px, a few px of paper apart.
Shown two_markers(int gap) {
  Shown shown;
  platform::GreyImage& image = shown.image;
  std::fill(image.pixels.begin(), image.pixels.end(), 220);
  const marker::Dictionary& dictionary = *marker::find_dictionary("4x4_250");
  constexpr int cell = 10, cells = 6;
  for (int which = 0; which < 2; ++which) {
    const std::uint64_t word = dictionary.words[7];
    const int left = 100 + which * (cells * cell + gap);
    for (int y = 0; y < cells * cell; ++y) {
      for (int x = 0; x < cells * cell; ++x) {
        const int row = y / cell - 1, column = x / cell - 1;
        const bool border = row < 0 || column < 0 || row > 3 || column > 3;
        if (border || (word >> (15 - row * 4 - column) & 1) != 0)
          image.pixels[static_cast<std::size_t>((100 + y) * image.width + left + x)] = 30;
      }
    }
  }
  return shown;
}

marker::CameraFrame frame_of(const platform::GreyImage& image) {
  return {pictures::view(image), {{400, 400, image.width / 2.0, image.height / 2.0}}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(outline)

BOOST_AUTO_TEST_CASE(a_marker_that_something_touches_is_found) {
  Shown shown;
  // A dark bar from the middle of the first side, away from the marker.
  const Point a{shown.corners[0].x, shown.corners[0].y}, b{shown.corners[1].x, shown.corners[1].y};
  const Point side = b - a, middle = 0.5 * (a + b);
  const double length = std::sqrt(marker::dot(side, side));
  const Point along = (1 / length) * side, out{along.y, -along.x};
  shown.draw(20, [&](double x, double y) {
    const Point off = Point{x, y} - middle;
    const double way = marker::dot(off, out);
    return way > -1 && way < 0.5 * length && std::abs(marker::dot(off, along)) < 3;
  });
  BOOST_TEST(detect(shown, false, false)->count == 0u);
  BOOST_TEST(detect(shown, true, false)->count == 0u);
  BOOST_TEST(is_found(shown, *detect(shown, true, true), 0.2));
}

BOOST_AUTO_TEST_CASE(a_marker_with_a_hidden_corner_is_found) {
  for (const std::uint8_t level : {20, 229}) {
    Shown shown;
    shown.draw_disc(level, 9);
    // The ends of two sides are left out: with them, the corner is 0.2 px off.
    BOOST_TEST(is_found(shown, *detect(shown, true, true), 0.05), "level " << int{level});
  }
  Shown shown;
  shown.draw_disc(20, 45);
  BOOST_TEST(detect(shown, true, true)->count == 0u, "half of two sides is hidden");
}

BOOST_AUTO_TEST_CASE(markers_of_one_id_in_two_places_are_two) {
  const auto found = detect(two_markers(10), true, true);
  BOOST_TEST(found->count == 2u);
  BOOST_TEST(found->blobs.refused[static_cast<std::size_t>(marker::Refusal::twice)] == 0u);
}

BOOST_AUTO_TEST_CASE(what_is_found_at_once_stays_as_it_is) {
  const Shown shown;
  const auto once = detect(shown, false, false), all = detect(shown, true, true);
  BOOST_TEST_REQUIRE(is_found(shown, *once, 0.05));
  BOOST_TEST_REQUIRE(is_found(shown, *all, 0.05));
  for (unsigned k = 0; k < 4; ++k)
    BOOST_TEST(once->markers[0].marker.fit.image[k].x == all->markers[0].marker.fit.image[k].x);
}

BOOST_AUTO_TEST_CASE(neighbours_two_pixels_away_are_found_at_the_second_try) {
  BOOST_TEST(detect(two_markers(10), false, false)->count == 2u);
  const Shown near = two_markers(2);
  BOOST_TEST(detect(near, false, false)->count == 0u);
  const auto found = detect(near, true, false);
  BOOST_TEST_REQUIRE(found->count == 2u);
  for (unsigned i = 0; i < 2; ++i) {
    const marker::DetectedMarker& m = found->markers[i].marker;
    BOOST_TEST(m.id == 7);
    BOOST_TEST(std::abs(m.fit.image[0].x - (100 + 62 * i)) < 0.1);
  }
  BOOST_TEST(detect(two_markers(0), true, false)->count == 0u, "one blob");
}

/// Marker 7 of a dictionary, 48 px wide and so many px high, leaning; `wrong`: cells of its code
/// that are not as they should be.
Shown narrow_marker(const char* name, double height, unsigned wrong = 0) {
  Shown shown;
  const marker::Dictionary& dictionary = *marker::find_dictionary(name);
  std::uint64_t word = dictionary.words[7];
  for (unsigned i = 0; i < wrong; ++i) word ^= std::uint64_t{1} << (5 * i);
  const Point origin{200.3, 150.4}, right{48, 5}, down{-9, height};
  const double area = right.x * down.y - right.y * down.x;
  const auto side = static_cast<int>(dictionary.cells) + 2;
  const auto is_black = [&](Point p) {
    const Point off = p - origin;
    const double u = (off.x * down.y - off.y * down.x) / area * side;
    const double v = (right.x * off.y - right.y * off.x) / area * side;
    if (u < 0 || v < 0 || u >= side || v >= side) return false;
    const int column = static_cast<int>(u) - 1, row = static_cast<int>(v) - 1;
    const int cells = side - 2;
    if (row < 0 || column < 0 || row >= cells || column >= cells) return true;
    return (word >> (cells * cells - 1 - row * cells - column) & 1) != 0;
  };
  constexpr int samples = 8;
  for (int y = 0; y < shown.image.height; ++y) {
    for (int x = 0; x < shown.image.width; ++x) {
      int black = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const Point p{x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples};
        black += is_black(p) ? 1 : 0;
      }
      shown.image.pixels[static_cast<std::size_t>(y * shown.image.width + x)] =
          static_cast<std::uint8_t>(220 - 190 * black / (samples * samples));
    }
  }
  const std::array<Point, 4> corners = {origin, origin + right, origin + right + down,
                                        origin + down};
  for (unsigned i = 0; i < 4; ++i) shown.corners[i] = {corners[i].x, corners[i].y};
  return shown;
}

// Of eight cells in 10 px of height none is high enough for its edges to be measured.
BOOST_AUTO_TEST_CASE(a_marker_with_narrow_cells_is_found_by_its_outline) {
  const Shown shown = narrow_marker("apriltag_36h11", 10);
  BOOST_TEST(detect(shown, true, false, "apriltag_36h11")->count == 0u);
  const auto found = detect(shown, true, true, "apriltag_36h11");
  BOOST_TEST_REQUIRE(is_found(shown, *found, 0.7));
  // They say how little is known of their corners.
  const marker::QuadFit& fit = found->markers[0].marker.fit;
  for (unsigned i = 0; i < 8; ++i) BOOST_TEST(std::sqrt(fit.covariance[9 * i]) == 0.3);
  BOOST_TEST(detect(narrow_marker("apriltag_36h11", 4), true, true, "apriltag_36h11")->count == 0u,
             "narrower than can be read");
}

BOOST_AUTO_TEST_CASE(narrow_cells_must_be_a_word_that_chance_hardly_makes) {
  BOOST_TEST(
      detect(narrow_marker("apriltag_36h11", 10, 1), true, true, "apriltag_36h11")->count == 0u,
      "a wrong cell");
  BOOST_TEST(detect(narrow_marker("4x4_250", 7.5), true, true, "4x4_250")->count == 0u, "16 cells");
  BOOST_TEST(detect(narrow_marker("4x4_250", 20), true, true, "4x4_250")->count == 1u,
             "the same with cells that can be measured");
}

BOOST_AUTO_TEST_CASE(a_square_is_in_its_own_outline) {
  platform::GreyImage image{64, 48, std::vector<std::uint8_t>(64 * 48, 220)};
  for (int y = 10; y < 30; ++y) {
    for (int x = 20; x < 44; ++x) image.pixels[static_cast<std::size_t>(y * 64 + x)] = 30;
  }
  const marker::OutlineQuads quads = marker::quads_of_outline(frame_of(image), {20, 10});
  BOOST_TEST_REQUIRE(quads.count == 1u);
  const marker::Quad corners = {{{20, 10}, {44, 10}, {44, 30}, {20, 30}}};
  for (const Point& corner : corners) {
    const bool is_there = std::any_of(quads.quads[0].begin(), quads.quads[0].end(), [&](Point p) {
      return std::hypot(p.x - corner.x, p.y - corner.y) < 1;
    });
    BOOST_TEST(is_there);
  }
}

/// Nothing, one pixel, a line, all of it, noise: no quadrilateral, and an end.
BOOST_AUTO_TEST_CASE(hostile_pictures_end) {
  const auto quads = [](const platform::GreyImage& image, Pixel start) {
    return marker::quads_of_outline(frame_of(image), start).count;
  };
  platform::GreyImage image{64, 48, std::vector<std::uint8_t>(64 * 48, 220)};
  BOOST_TEST(quads(image, {5, 5}) == 0u);
  std::fill(image.pixels.begin(), image.pixels.end(), 10);
  BOOST_TEST(quads(image, {0, 0}) == 0u);
  std::fill(image.pixels.begin(), image.pixels.end(), 220);
  image.pixels[20 * 64 + 30] = 0;
  BOOST_TEST(quads(image, {30, 20}) == 0u);
  for (int x = 10; x < 50; ++x) image.pixels[static_cast<std::size_t>(20 * 64 + x)] = 0;
  BOOST_TEST(quads(image, {10, 20}) == 0u);
  BOOST_TEST(quads(image, {63, 47}) == 0u);
  std::mt19937 noise(1);
  for (int i = 0; i < 50; ++i) {
    for (std::uint8_t& pixel : image.pixels) pixel = static_cast<std::uint8_t>(noise());
    const auto x = static_cast<std::int32_t>(noise() % 64),
               y = static_cast<std::int32_t>(noise() % 48);
    BOOST_TEST(quads(image, {x, y}) <= marker::OutlineQuads::most);
  }
  // A comb whose outline has no room.
  platform::GreyImage comb{640, 480, std::vector<std::uint8_t>(640 * 480, 220)};
  for (int y = 10; y < 470; ++y) {
    for (int x = 10; x < 630; ++x)
      comb.pixels[static_cast<std::size_t>(y * 640 + x)] = y < 20 || x % 4 < 2 ? 20 : 220;
  }
  BOOST_TEST(quads(comb, {10, 10}) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
