// What a camera makes of the light of a scene: curve, hidden corner, JPEG.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>

#include <marker/light_curves.h>
#include <marker/scene/camera_effects.h>
#include <marker/scene/renderer.h>

#include "scene_kit.h"

using namespace platform;

namespace {

GreyImage picture(const std::string& scene) {
  return render(make_scene(scene));
}

int most_difference(const GreyImage& a, const GreyImage& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
  return most;
}

int at(const GreyImage& image, double x, double y) {
  return image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(x)];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_effects)

BOOST_AUTO_TEST_CASE(levels_are_the_inverse_of_the_curve) {
  marker::LightTable srgb, square;
  marker::fill_srgb_light(srgb);
  marker::fill_light(2, square);
  for (std::size_t level = 1; level < srgb.size(); ++level) {
    const double light = srgb[level] / 65535.0;
    BOOST_TEST(std::abs(level_of(light, srgb) - static_cast<double>(level) / 255) < 1e-9);
  }
  BOOST_TEST(std::abs(level_of(0.25, square) - 0.5) < 1e-4);
  BOOST_TEST(level_of(-0.1, srgb) == 0);
  BOOST_TEST(level_of(1.5, srgb) == 1);
}

BOOST_AUTO_TEST_CASE(a_curve_lifts_the_dark) {
  const GreyImage light = picture("z1.0@noise=0"), levels = picture("z1.0@noise=0,response=srgb");
  BOOST_TEST(at(light, 330, 250) == 20, "0.08 of white");
  // IEC 61966-2-1: 1.055 · 0.08^(1 / 2.4) − 0.055.
  BOOST_TEST(at(levels, 330, 250) == 80);
}

BOOST_AUTO_TEST_CASE(a_disc_hides_the_corner_and_no_other) {
  const GreyImage whole = picture("z1.0@noise=0"), hidden = picture("z1.0@noise=0,hidden=0.1");
  BOOST_TEST(at(hidden, 320, 240) == 79, "as bright as the floor");
  BOOST_TEST(at(hidden, 327, 247) == 79);
  BOOST_TEST(at(hidden, 330, 250) == at(whole, 330, 250), "farther than a tenth of 114 px");
  BOOST_TEST(at(hidden, 433, 353) == at(whole, 433, 353));
}

// OpenCV 4.6 with libjpeg-turbo 2.1.5 makes these of the same picture.
BOOST_AUTO_TEST_CASE(jpeg_loses_what_a_file_loses) {
  const GreyImage whole = picture("z1.0@noise=0"), fine = picture("z1.0@noise=0,jpeg=100"),
                  coarse = picture("z1.0@noise=0,jpeg=20");
  BOOST_TEST(most_difference(whole, fine) <= 2);
  BOOST_TEST(most_difference(whole, coarse) > 20);
  GreyImage step{8, 8, std::vector<std::uint8_t>(64, 40)};
  for (std::size_t i = 0; i < 64; ++i) step.pixels[i] = i % 8 < 3 ? 40 : 200;
  lose_as_jpeg(step, 20);
  const int expected[8] = {43, 40, 23, 217, 187, 193, 206, 195};
  for (std::size_t i = 0; i < 64; ++i) BOOST_TEST(step.pixels[i] == expected[i % 8]);
}

BOOST_AUTO_TEST_CASE(pictures_whose_sides_are_no_multiples_of_eight) {
  GreyImage image{5, 3, std::vector<std::uint8_t>(15, 77)};
  lose_as_jpeg(image, 90);
  BOOST_TEST(image.pixels.size() == 15u);
  for (const std::uint8_t pixel : image.pixels) BOOST_TEST(std::abs(pixel - 77) <= 1);
}

BOOST_AUTO_TEST_CASE(what_no_camera_does_is_refused) {
  const auto refused = [](const char* scene, const char* why) {
    scene_kit::check_refused([&] { make_scene(scene); }, why);
  };
  refused("demo@response=7", "exponent from 0.5 to 5");
  refused("demo@response=xyz", "response");
  refused("demo@hidden=2", "hidden");
  refused("demo@jpeg=0", "whole number from 1 to 100");
}

BOOST_AUTO_TEST_SUITE_END()
