#include <marker/marker_detector.h>
#include <marker/optics.h>
#include <marker/response.h>
#include <marker/scene/renderer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <boost/test/unit_test.hpp>

#include "pictures.h"

using marker::InnerShift;
using marker::LightTable;
using marker::ResponseFinder;
using marker::ResponseOrigin;

namespace {

/// A scene, and the light of each of its pixels.
struct View {
  platform::Scene scene;
  std::vector<double> light;
};

/// A marker from several sides, sharp and blurred.
const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    std::vector<View> made;
    for (const char* conditions :
         {"distance=1.1m,yaw=35deg,roll=17deg,id=3", "distance=1.5m,pitch=-30deg,roll=71deg,id=42",
          "distance=1.2m,yaw=-25deg,roll=140deg,blur=0.6px,id=77",
          "distance=0.9m,pitch=20deg,yaw=20deg,roll=215deg,blur=1px,id=5"}) {
      View view{platform::make_scene(std::string("z1.0@noise=0,") + conditions), {}};
      view.light = platform::render_light(view.scene);
      made.push_back(std::move(view));
    }
    return made;
  }();
  return all;
}

double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}
double linear(double light) {
  return light;
}
double square_root(double light) {
  return std::sqrt(light);
}

using Curve = double (*)(double);

/// What a camera with that curve delivers, with some noise.
platform::GreyImage photograph(const View& view, Curve curve) {
  std::mt19937 noise(7);
  platform::GreyImage image{view.scene.camera.width, view.scene.camera.height, {}};
  for (const double light : view.light) {
    const double level = curve(std::clamp(light, 0.0, 1.0)) * 255 + noise() % 1000 / 500.0 - 0.5;
    image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)));
  }
  return image;
}

/// How a frame is looked at, and what is seen.
struct Look {
  marker::Optics optics{};
  std::unique_ptr<marker::Detections> found = std::make_unique<marker::Detections>();
  std::unique_ptr<marker::MarkerDetector> detector = std::make_unique<marker::MarkerDetector>();

  explicit Look(const LightTable* light = nullptr) {
    optics.light = light != nullptr ? light->data() : marker::linear_light();
    detector->open(*marker::find_dictionary("4x4_250"), {});
  }

  /// Mean distance of the corners from the true ones, px.
  double error(const View& view) const {
    BOOST_TEST_REQUIRE(found->count == 1u);
    const auto truth = platform::project_marker(view.scene.camera, view.scene.pose);
    double sum = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const marker::Point seen = found->markers[0].marker.fit.image[i];
      sum += std::hypot(seen.x - truth[i].x, seen.y - truth[i].y) / 4;
    }
    return sum;
  }

  /// With what the finder knows; it learns.
  double look(const View& view, Curve curve, ResponseFinder* finder = nullptr) {
    const platform::GreyImage image = photograph(view, curve);
    optics.lens.camera = pictures::lens_of(view.scene.camera).camera;
    marker::CameraFrame frame{pictures::view(image), {optics.lens.camera}};
    frame.optics = &optics;
    const auto threshold = static_cast<std::uint8_t>(curve(0.45) * 255);
    const std::vector<std::uint32_t> words =
        pictures::words_of(pictures::find_blobs(frame.image, threshold));
    const auto follow = [&] {
      optics.light = finder->light();
      optics.common_shift = finder->common_shift();
      optics.seeks_response = true;
    };
    if (finder != nullptr) {
      finder->begin_frame();
      follow();
    }
    const auto blobs = static_cast<std::uint32_t>(words.size() / 8);
    detector->find_markers(frame, {words.data(), blobs}, *found);
    while (finder != nullptr) {
      for (std::uint32_t i = 0; i < found->count; ++i) finder->add(found->markers[i].marker.inner);
      if (!finder->end_look()) break;
      follow();
      detector->measure_again(frame, *found);
    }
    return error(view);
  }
};

std::unique_ptr<ResponseFinder> new_finder() {
  auto finder = std::make_unique<ResponseFinder>();
  finder->open();
  return finder;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(response)

BOOST_AUTO_TEST_CASE(tables_are_those_of_the_standards) {
  LightTable table{};
  const auto off = [&](int level, double light) {
    return std::abs(table[level] - light * marker::white_light);
  };
  marker::fill_srgb_light(table);
  for (const int level : {0, 5, 10, 11, 50, 128, 254, 255}) {
    const double v = level / 255.0;
    const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    BOOST_TEST(off(level, light) <= 0.5001, "sRGB " << level);
  }
  marker::fill_rec709_light(table);
  BOOST_TEST(off(128, std::pow((128 / 255.0 + 0.099) / 1.099, 1 / 0.45)) <= 0.5001);
  BOOST_TEST(off(10, 10 / 255.0 / 4.5) <= 0.5001);
  for (const double exponent : {0.5, 1.0, 2.2, 5.0}) {
    marker::fill_light(exponent, table);
    BOOST_TEST(off(100, std::pow(100 / 255.0, exponent)) <= 0.5001);
    BOOST_TEST(std::is_sorted(table.begin(), table.end()));
    BOOST_TEST(table[0] == 0);
    BOOST_TEST(table[255] == marker::white_light);
  }
  BOOST_TEST(marker::linear_light()[128] == 128 * 257);
}

BOOST_AUTO_TEST_CASE(a_known_curve_brings_the_corners_back) {
  LightTable light{};
  marker::fill_srgb_light(light);
  for (const View& view : views()) {
    const double as_it_is = Look().look(view, srgb), given = Look(&light).look(view, srgb);
    BOOST_TEST(as_it_is > 0.08);
    BOOST_TEST(given < 0.015);
    // The wrong curve is no better than none.
    BOOST_TEST(Look(&light).look(view, linear) > 0.08);
  }
}

BOOST_AUTO_TEST_CASE(an_unknown_curve_is_found_in_the_first_frame) {
  for (const View& view : views()) {
    const auto finder = new_finder();
    BOOST_TEST((finder->origin() == ResponseOrigin::unknown));
    BOOST_TEST(Look().look(view, srgb, finder.get()) < 0.03);
    BOOST_TEST((finder->origin() == ResponseOrigin::found));
    BOOST_TEST(finder->exponent() > 2.1);
    BOOST_TEST(finder->exponent() < 2.5);
  }
  const auto finder = new_finder();
  Look().look(views()[0], square_root, finder.get());
  BOOST_TEST(std::abs(finder->exponent() - 2) < 0.05);
}

BOOST_AUTO_TEST_CASE(light_stays_light) {
  const auto finder = new_finder();
  for (const View& view : views()) {
    BOOST_TEST(Look().look(view, linear, finder.get()) < 0.015);
    BOOST_TEST(std::abs(finder->exponent() - 1) < 0.03);
  }
}

/// What is measured of edges says a tenth of a transition, again and again.
BOOST_AUTO_TEST_CASE(the_curve_is_the_mean_over_markers_and_frames) {
  const auto finder = new_finder();
  const double unknown = finder->common_shift();
  BOOST_TEST(unknown == marker::unknown_shift);
  const InnerShift curved{20, false, 0.05, 1e-6, 0.5};
  finder->begin_frame();
  finder->add(curved);
  BOOST_TEST(finder->end_look(), "worth another look");
  BOOST_TEST(std::abs(std::log(finder->exponent()) - 0.1 / 0.51) < 1e-9);
  const InnerShift straight{20, false, 0, 1e-6, 0.5};
  finder->add(straight);
  BOOST_TEST(!finder->end_look(), "the curve holds");
  const double first = finder->common_shift();
  BOOST_TEST(first < 0.05);
  BOOST_TEST(!finder->is_settled(), "one marker");
  for (int frame = 0; frame < 20; ++frame) {
    finder->begin_frame();
    for (int i = 0; i < 5; ++i) finder->add(straight);
    BOOST_TEST(!finder->end_look());
  }
  BOOST_TEST(finder->common_shift() < first);
  BOOST_TEST(finder->is_settled());
  // Markers that differ: no curve does that.
  for (int frame = 0; frame < 5; ++frame) {
    finder->begin_frame();
    finder->add({20, false, 0.1, 1e-6, 0.5});
    finder->add({20, false, -0.1, 1e-6, 0.5});
    finder->end_look();
  }
  BOOST_TEST(finder->common_shift() > 0.05);
}

BOOST_AUTO_TEST_CASE(what_says_nothing_changes_nothing) {
  const auto finder = new_finder();
  for (const InnerShift& seen :
       {InnerShift{}, InnerShift{20, false, 5, 1e-6, 0.5}, InnerShift{20, false, 0.1, 1e-6, 0},
        InnerShift{20, true, 0.02, 1e-6, 0.5}}) {
    finder->begin_frame();
    finder->add(seen);
    BOOST_TEST(!finder->end_look());
    BOOST_TEST((finder->origin() == ResponseOrigin::unknown));
    BOOST_TEST(finder->exponent() == 1);
  }
  // A blurred marker that says it clearly is better than nothing, until a clear one comes.
  finder->begin_frame();
  finder->add({20, true, 0.15, 1e-6, 0.5});
  BOOST_TEST(finder->end_look());
  BOOST_TEST(finder->common_shift() > 0.05);
}

/// Their error is one that they share, so a better one outweighs any other.
BOOST_AUTO_TEST_CASE(of_blurred_markers_the_surer_one_counts) {
  const auto finder = new_finder();
  finder->begin_frame();
  finder->add({20, true, 0.15, 1e-6, 0.5});
  finder->add({6, true, -0.2, 0.01, 0.5});
  BOOST_TEST(finder->end_look());
  BOOST_TEST(std::log(finder->exponent()) > 0.99 * 0.15 / 0.5 / 0.51);
  const auto unsure = new_finder();
  unsure->begin_frame();
  unsure->add({6, true, 0.15, 0.01, 0.5});
  BOOST_TEST(!unsure->end_look());
  BOOST_TEST((unsure->origin() == ResponseOrigin::unknown));
}

/// Cells of 3.8 to 7 px under a blur of 1 px, seen straight and askew: the cells around an edge are
/// blurred into it.
BOOST_AUTO_TEST_CASE(a_blurred_marker_alone_tells_the_curve) {
  for (const char* conditions :
       {"distance=2.4m,yaw=20deg,roll=17deg,blur=1px,id=3",
        "distance=2.3m,pitch=-30deg,roll=71deg,blur=0.9px,id=42",
        "distance=3.4m,yaw=-15deg,roll=52deg,blur=0.9px,id=120",
        "distance=2.6m,pitch=40deg,yaw=30deg,roll=33deg,blur=0.8px,id=9"}) {
    View view{platform::make_scene(std::string("z1.0@noise=0,") + conditions), {}};
    view.light = platform::render_light(view.scene);
    for (const auto& [curve, exponent] : {std::pair<Curve, double>{srgb, 2.25}, {square_root, 2}}) {
      const auto finder = new_finder();
      BOOST_TEST(Look().look(view, curve, finder.get()) < 0.07, conditions);
      BOOST_TEST(std::abs(std::log(finder->exponent() / exponent)) < 0.1, conditions);
    }
    const auto straight = new_finder();
    BOOST_TEST(Look().look(view, linear, straight.get()) < 0.04, conditions);
    BOOST_TEST(straight->exponent() == 1, conditions);
  }
}

/// Pixels that are black or white have transitions of no width.
BOOST_AUTO_TEST_CASE(edges_without_width_have_a_covariance) {
  constexpr int cell = 10, left = 200, top = 150, id = 3;
  View view{views()[0].scene, {}};
  view.light.assign(views()[0].light.size(), 1);
  for (int i = 0; i < 36; ++i) {
    const int row = i / 6, column = i % 6;
    const bool is_border = row == 0 || row == 5 || column == 0 || column == 5;
    if (!is_border && !platform::is_black(platform::marker_word(id), row - 1, column - 1)) continue;
    for (int y = top + row * cell; y < top + (row + 1) * cell; ++y) {
      const auto first = view.light.begin() + y * view.scene.camera.width + left + column * cell;
      std::fill_n(first, cell, 0);
    }
  }
  const Curve hard = [](double light) { return light < 0.3 ? -1 : light < 0.6 ? 0.5 : 2.0; };
  Look look;
  look.optics.common_shift = marker::unknown_shift;
  look.look(view, hard);
  const marker::QuadFit& fit = look.found->markers[0].marker.fit;
  BOOST_TEST(fit.reach == 0);
  for (unsigned i = 0; i < 64; ++i) BOOST_TEST(std::isfinite(fit.covariance[i]));
  for (unsigned i = 0; i < 8; ++i) BOOST_TEST(fit.covariance[9 * i] > 0);
}

/// All sides may be too near or too far by the same: in light of which nothing is known, a corner
/// moves along its diagonal.
BOOST_AUTO_TEST_CASE(the_covariance_has_what_sides_share) {
  const View& view = views()[0];
  Look known, unknown;
  unknown.optics.common_shift = marker::unknown_shift;
  known.look(view, linear);
  unknown.look(view, linear);
  const marker::QuadFit& a = known.found->markers[0].marker.fit;
  const marker::QuadFit& b = unknown.found->markers[0].marker.fit;
  BOOST_TEST(a.ideal[0].x == b.ideal[0].x);
  const double shift = marker::unknown_shift * b.reach / 2.5;
  // Of the length between opposite corners: twice a corner's way, which is more than the shift.
  const auto variance = [](const marker::QuadFit& fit) {
    const marker::Point span = fit.ideal[2] - fit.ideal[0];
    const double length = std::sqrt(marker::dot(span, span));
    const double u[] = {-span.x / length, -span.y / length, 0, 0, span.x / length, span.y / length};
    double sum = 0;
    for (unsigned i = 0; i < 6; ++i) {
      for (unsigned k = 0; k < 6; ++k) sum += u[i] * fit.covariance[8 * i + k] * u[k];
    }
    return sum;
  };
  BOOST_TEST(variance(a) < shift * shift / 100);
  BOOST_TEST(variance(b) > 4 * shift * shift);
  BOOST_TEST(variance(b) < 16 * shift * shift);
  // It stays apart, as all markers of the picture have it: without it both know the same.
  for (unsigned i = 0; i < 8; ++i) {
    BOOST_TEST(a.common[i] == 0);
    for (unsigned k = 0; k < 8; ++k) {
      const double own = b.covariance[8 * i + k] - b.common[i] * b.common[k];
      BOOST_TEST(std::abs(own - a.covariance[8 * i + k]) < 1e-9);
    }
  }
  BOOST_TEST(std::hypot(b.common[0], b.common[1]) > shift);
}

BOOST_AUTO_TEST_SUITE_END()
