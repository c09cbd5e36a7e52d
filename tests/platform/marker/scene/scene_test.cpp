#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <vector>

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

#include "scene_kit.h"

using namespace platform;
using scene_kit::check_refused;

BOOST_AUTO_TEST_SUITE(dictionary_of_markers)

BOOST_AUTO_TEST_CASE(known_words) {
  BOOST_TEST(dictionary().size() == 250u);
  BOOST_TEST(marker_word(0) == 0x4ACD);
  BOOST_TEST(marker_word(42) == 0xCD73);
  BOOST_TEST(marker_word(99) == 0x8F38);
}

BOOST_AUTO_TEST_CASE(all_words_differ) {
  const std::set<std::uint16_t> different(dictionary().begin(), dictionary().end());
  BOOST_TEST(different.size() == 250u);
}

BOOST_AUTO_TEST_CASE(the_top_left_cell_is_the_highest_bit) {
  BOOST_TEST(is_black(0x8000, 0, 0));
  BOOST_TEST(is_black(0x1000, 0, 3));
  BOOST_TEST(is_black(0x0001, 3, 3));
  BOOST_TEST(!is_black(0x7FFF, 0, 0));
}

BOOST_AUTO_TEST_CASE(unknown_ids_are_refused) {
  check_refused([] { marker_word(-1); }, "marker ID -1");
  check_refused([] { marker_word(250); }, "give 0 to 249");
}

BOOST_AUTO_TEST_SUITE_END()

using namespace platform;

namespace {

/// Width of the marker in the picture before noise, px, along a row inside the black ring of a
/// front view.
double rendered_width(const Scene& scene, int row) {
  const std::vector<double> light = render_light(scene);
  const Brightness& level = scene.brightness;
  const auto corners = ground_truth(scene).corners_px;
  const int margin = 5;  // stays inside the white border
  double width = 0;
  for (int x = static_cast<int>(corners[0].x) - margin; x < static_cast<int>(corners[1].x) + margin;
       ++x) {
    width += (level.border - light[static_cast<std::size_t>(row * scene.camera.width + x)]) /
             (level.border - level.black);
  }
  return width;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ground_truths)

BOOST_AUTO_TEST_CASE(marker_widths_of_table_5_3) {
  // At 4.5 m the projection is 25.42 px; the thesis counts 26.
  const std::vector<long> published{229, 114, 76, 57, 46, 38, 33, 29, 25};
  for (std::size_t i = 0; i < published.size(); ++i) {
    const double distance = 0.5 * static_cast<double>(i + 1);
    const Scene scene =
        make_scene("z" + std::to_string((i + 1) / 2) + ((i + 1) % 2 == 1 ? ".5" : ".0"));
    BOOST_TEST_CONTEXT(scene.name) {
      const auto corners = ground_truth(scene).corners_px;
      const double width = corners[1].x - corners[0].x;
      BOOST_TEST(std::lround(width) == published[i]);
      BOOST_TEST(std::abs(width - 381.36 * 0.3 / distance) < 1e-9);
      BOOST_TEST(std::abs(rendered_width(scene, static_cast<int>(corners[0].y) + 2) - width) <
                 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_have_no_bias_at_any_sub_pixel_place) {
  Scene scene = make_scene("front0");
  const double left = ground_truth(scene).corners_px[0].x;
  for (int step = 0; step < 50; ++step) {
    Scene moved = scene;
    const double shift = step / 50.0;  // px
    moved.pose.translation[0] += shift / moved.camera.fx;
    const std::vector<double> light = render_light(moved);
    const int row = static_cast<int>(ground_truth(moved).corners_px[0].y) + 3;
    const int inside = static_cast<int>(left) + 10;  // black ring: 19 px wide
    double edge = 0;                                 // white pixels up to here
    const int outside = static_cast<int>(left) - 20;
    for (int x = outside; x < inside; ++x) {
      edge += (light[static_cast<std::size_t>(row * 640 + x)] - scene.brightness.black) /
              (scene.brightness.border - scene.brightness.black);
    }
    BOOST_TEST(std::abs(outside + edge - (left + shift)) < 0.005);
  }
}

BOOST_AUTO_TEST_CASE(a_slanted_square_covers_the_area_of_its_projection) {
  Scene scene = make_scene("yaw30");
  scene.pose = pose_from_centre(rotation_x(25) * rotation_z(33), {0.2, 0.1, 1.5});
  Scene with_square = scene;
  with_square.squares.push_back({-0.62, 0, 0.30, plain_square_word});
  with_square.squares[0].v = -0.1;
  // Black against white of the room as well: only the square's black area differs.
  for (Scene* each : {&scene, &with_square}) {
    Brightness& light = each->brightness;
    light.wall = light.floor = light.ceiling = light.side_walls = light.border;
  }
  const std::vector<double> without = render_light(scene);
  const std::vector<double> with = render_light(with_square);
  double covered = 0;
  for (std::size_t i = 0; i < with.size(); ++i) covered += without[i] - with[i];
  covered /= scene.brightness.border - scene.brightness.black;
  double area = 0;
  const std::vector<Eigen::Vector3d> corners{
      {-0.62, -0.1, 0}, {-0.32, -0.1, 0}, {-0.32, 0.2, 0}, {-0.62, 0.2, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const PixelPoint a = project(scene.camera, transform(scene.pose, corners[i]));
    const PixelPoint b = project(scene.camera, transform(scene.pose, corners[(i + 1) % 4]));
    area += (a.x * b.y - b.x * a.y) / 2;
  }
  BOOST_TEST(area > 1000);
  BOOST_TEST(std::abs(covered - area) < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()

using namespace platform;

namespace {

/// Changes the scene x0.0 and checks that it can no longer be rendered, nor its truth told.
template <typename Change>
void check_change_refused(Change change, const std::string& part) {
  Scene scene = make_scene("x0.0");
  validate(scene);
  change(scene);
  scene_kit::check_refused([&] { render(scene); }, part);
  scene_kit::check_refused([&] { ground_truth(scene); }, part);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(scene_refusals)

BOOST_AUTO_TEST_CASE(camera_and_pose) {
  check_change_refused([](Scene& s) { s.camera.width = 0; }, "camera width");
  check_change_refused([](Scene& s) { s.pose.translation = {0, 0, 0}; }, "Z = 0");
  check_change_refused([](Scene& s) { s.pose.translation = {0, 0, -2}; }, "behind the camera");
  check_change_refused([](Scene& s) { s.pose.rotation = rotation_y(180); }, "marker's back");
  check_change_refused([](Scene& s) { s.pose.rotation.setZero(); }, "not orthonormal");
  check_change_refused([](Scene& s) { s.pose.translation = {0, -2, 2}; }, "outside the room");
  check_change_refused([](Scene& s) { s.pose.translation = {5, 0, 2}; }, "outside the room");
}

BOOST_AUTO_TEST_CASE(marker_and_squares) {
  check_change_refused([](Scene& s) { s.marker_id = 250; }, "marker ID 250");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{0.5, 0, 0.3, plain_square_word}};
      },
      "square 1 overlaps the marker");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{0.62, 0, 0.3, plain_square_word}, {1.0, 0, 0.3, plain_square_word}};
      },
      "square 2 overlaps square 1");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{1, 0, 0, plain_square_word}};
      },
      "no place or size");
  check_change_refused(
      [](Scene& s) {
        s.squares = {{1, std::nan(""), 0.3, plain_square_word}};
      },
      "no place or size");
}

BOOST_AUTO_TEST_CASE(light_and_noise) {
  check_change_refused([](Scene& s) { s.brightness.wall = 1.5; }, "brightness of the wall is 1.5");
  check_change_refused([](Scene& s) { s.brightness.black = -0.1; }, "brightness of black");
  check_change_refused([](Scene& s) { s.noise_sigma = -0.1; }, "noise is -0.1");
  check_change_refused([](Scene& s) { s.noise_sigma = std::nan(""); }, "noise is");
  check_change_refused([](Scene& s) { s.blur_sigma_px = 101; }, "blur is 101");
  check_change_refused([](Scene& s) { s.room.wall_w = -1; }, "inside out");
}

BOOST_AUTO_TEST_SUITE_END()
