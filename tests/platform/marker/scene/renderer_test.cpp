#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>

using namespace platform;

namespace {

std::uint64_t fnv1a(const GreyImage& image) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (std::uint8_t pixel : image.pixels) hash = (hash ^ pixel) * 0x100000001B3u;
  return hash;
}

std::array<int, 256> histogram(const GreyImage& image) {
  std::array<int, 256> counts{};
  for (std::uint8_t pixel : image.pixels) ++counts[pixel];
  return counts;
}

double light_at(const Scene& scene, const std::vector<double>& light, int x, int y) {
  return light[static_cast<std::size_t>(y * scene.camera.width + x)];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(renderer)

BOOST_AUTO_TEST_CASE(cells_of_a_front_view_spell_the_word) {
  for (int id : {0, 1, 42, 99, 137, 249}) {
    const Scene scene = make_scene("front" + std::to_string(id));
    const GreyImage image = render(scene);
    const auto corners = ground_truth(scene).corners_px;
    const double cell = (corners[1].x - corners[0].x) / 6;
    std::uint16_t word = 0;
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        const bool black = image.at(static_cast<int>(corners[0].x + (column + 0.5) * cell),
                                    static_cast<int>(corners[0].y + (row + 0.5) * cell)) < 128;
        const bool ring = row == 0 || row == 5 || column == 0 || column == 5;
        if (ring) {
          BOOST_TEST(black);
        } else {
          word = static_cast<std::uint16_t>(2 * word + (black ? 1 : 0));
        }
      }
    }
    BOOST_TEST(word == marker_word(id));
  }
}

BOOST_AUTO_TEST_CASE(pictures_are_the_same_on_every_host) {
  const std::map<std::string, std::uint64_t> known{
      {"x0.0", 0x7A7DAE12E7F6C496u},      {"z4.5", 0x4D89E2EA94DA9EB1u},
      {"yaw60", 0xB0DF371BEFC3E501u},     {"roll30", 0xCF9F9D5261E3A9DCu},
      {"squares15", 0x87E871E87E5FBC92u}, {"demo", 0x1147794A675D722Du}};
  for (const auto& [name, checksum] : known) {
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(fnv1a(render(make_scene(name))) == checksum);
    }
  }
  Scene blurred = make_scene("id36");
  blurred.blur_sigma_px = 0.7;
  BOOST_TEST(fnv1a(render(blurred)) == 0x78DF2A8B777FF792u);
}

BOOST_AUTO_TEST_CASE(the_seed_changes_the_noise_and_nothing_else) {
  Scene scene = make_scene("x0.5");
  const GreyImage first = render(scene);
  BOOST_TEST((first.pixels == render(scene).pixels));
  ++scene.seed;
  const GreyImage second = render(scene);
  BOOST_TEST((first.pixels != second.pixels));
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    if (std::abs(first.pixels[i] - second.pixels[i]) > 25) BOOST_ERROR("not noise");
  }
  scene.noise_sigma = 0;
  const GreyImage clean = render(scene);
  ++scene.seed;
  BOOST_TEST((clean.pixels == render(scene).pixels));
}

BOOST_AUTO_TEST_CASE(noise_has_the_deviation_of_table_5_1) {
  const Scene scene = make_scene("z4.5");
  const GreyImage image = render(scene);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (int y = 60; y < 200; ++y) {  // wall only
    for (int x = 20; x < 620; ++x) {
      const double difference = image.at(x, y) - 0.698 * 255;
      sum += difference;
      squares += difference * difference;
      ++count;
    }
  }
  const double rounding = 1.0 / 12;  // variance that rounding to 8 bits adds
  BOOST_TEST(std::abs(sum / count) < 0.03);
  BOOST_TEST(std::abs(std::sqrt(squares / count - rounding) - 0.007 * 255) < 0.02);
}

BOOST_AUTO_TEST_CASE(wall_and_floor_are_the_histogram_peaks_of_c_7) {
  for (const char* name : {"x0.0", "z2.5", "z4.5", "squares15", "demo"}) {
    const auto counts = histogram(render(make_scene(name)));
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(std::max_element(counts.begin(), counts.begin() + 128) - counts.begin() == 79);
      BOOST_TEST(std::max_element(counts.begin() + 128, counts.end()) - counts.begin() == 178);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_room_stands_where_it_should) {
  const Scene scene = make_scene("x0.0");  // the optical axis meets the wall 2.6 m away
  const std::vector<double> light = render_light(scene);
  BOOST_TEST(light_at(scene, light, 200, 100) == 0.698);
  // The wall meets the floor at 240 + 381.36 * 1.2 / 2.6 = 416.01 px.
  BOOST_TEST(light_at(scene, light, 200, 415) == 0.698);
  BOOST_TEST(std::abs(light_at(scene, light, 200, 416) - (0.31 + 0.388 * 0.0123)) < 1e-4);
  BOOST_TEST(light_at(scene, light, 200, 417) == 0.31);
  // The marker's border begins 0.125 m left of and above the centre: 23.835 px.
  BOOST_TEST(light_at(scene, light, 295, 230) == 0.698);
  BOOST_TEST(light_at(scene, light, 297, 230) == 0.90);
  BOOST_TEST(std::abs(light_at(scene, light, 296, 230) - (0.698 + 0.202 * 0.835)) < 1e-9);
  BOOST_TEST(std::abs(light_at(scene, light, 320, 240) - 0.08) < 1e-9);
}

BOOST_AUTO_TEST_CASE(side_walls_and_ceiling_show_at_the_sides) {
  const Scene scene = make_scene("z4.5");
  const std::vector<double> light = render_light(scene);
  // The wall, 5.1 m away, reaches 381.36 * 4.5 / 5.1 = 336.5 px to the side: outside the picture.
  BOOST_TEST(light_at(scene, light, 0, 200) == 0.698);
  // The ceiling begins 381.36 * 2.6 / 5.1 = 194.4 px above the centre.
  BOOST_TEST(light_at(scene, light, 100, 46) == 0.698);
  BOOST_TEST(light_at(scene, light, 100, 44) == 0.80);
  const Scene side = make_scene("yaw60");
  BOOST_TEST(light_at(side, render_light(side), 10, 200) == 0.62);
}

BOOST_AUTO_TEST_CASE(every_pixel_is_covered_once) {
  // With one brightness everywhere each pixel adds up to it, whatever edges cross it.
  for (const char* name : {"demo", "squares15", "yaw60", "roll30", "id88"}) {
    Scene scene = make_scene(name);
    scene.brightness = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    const std::vector<double> light = render_light(scene);
    const auto [low, high] = std::minmax_element(light.begin(), light.end());
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(*low > 0.5 - 1e-9);
      BOOST_TEST(*high < 0.5 + 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(saturation) {
  Scene scene = make_scene("z1.0");
  scene.noise_sigma = 0.5;
  const auto counts = histogram(render(scene));
  BOOST_TEST(counts[0] > 1000);
  BOOST_TEST(counts[255] > 1000);
}

BOOST_AUTO_TEST_CASE(blur_keeps_the_light_and_softens_edges) {
  Scene scene = make_scene("front0");
  const std::vector<double> sharp = render_light(scene);
  scene.blur_sigma_px = 1.0;
  const std::vector<double> soft = render_light(scene);
  double difference = 0;
  for (std::size_t i = 0; i < sharp.size(); ++i) difference += soft[i] - sharp[i];
  BOOST_TEST(std::abs(difference) / static_cast<double>(sharp.size()) < 1e-5);
  // One deviation from a straight edge a Gaussian has 15.87 % of the step left.
  const auto corners = ground_truth(scene).corners_px;
  const int row = static_cast<int>(corners[0].y) + 9;
  double edge = 0;
  for (int x = static_cast<int>(corners[0].x) - 8; x < static_cast<int>(corners[0].x) + 9; ++x) {
    edge += (light_at(scene, soft, x, row) - light_at(scene, sharp, x, row));
  }
  BOOST_TEST(std::abs(edge) < 1e-3);
  BOOST_TEST(light_at(scene, soft, static_cast<int>(corners[0].x) - 1, row) < 0.89);
}

BOOST_AUTO_TEST_CASE(another_resolution) {
  const GreyImage image = render(make_scene("z1.0", Camera::for_resolution(320, 240)));
  BOOST_TEST(image.width == 320);
  BOOST_TEST(image.height == 240);
  BOOST_TEST(image.pixels.size() == 320u * 240u);
}

BOOST_AUTO_TEST_SUITE_END()
