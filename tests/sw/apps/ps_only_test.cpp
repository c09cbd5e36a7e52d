#include <apps/ps_only/application.h>
#include <marker/dictionary.h>
#include <marker/work.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <memory>

#include "fake_platform.h"
#include "marker/synthetic_image.h"

using marker::FrameResult;
using marker::Status;

namespace {

struct Fixture {
  Fixture() {
    auto& options = fake_hal::state().options;
    for (std::uint32_t i = 0; i < ps_only::option_count; ++i) {
      options[i] = ps_only::option_table[i].default_value;
    }
  }

  void set(const std::string& name, double value) {
    for (std::uint32_t i = 0; i < ps_only::option_count; ++i) {
      if (ps_only::option_table[i].name == name) {
        fake_hal::state().options[i] = value;
        return;
      }
    }
    BOOST_FAIL("no option " << name);
  }

  /// A frame that shows a marker on white paper.
  void add_marker(unsigned id) {
    constexpr std::uint32_t width = 640, height = 480;
    platform.add_frame(width, height);
    synthetic::Image binary(width, height);
    binary.draw_marker(marker::dictionary[id], {{{200, 120}, {319, 120}, {319, 239}, {200, 239}}});
    const std::vector<std::uint32_t> words = binary.words();
    auto* pixels = const_cast<std::uint8_t*>(fake_hal::state().frames.back().pixels);
    for (std::uint32_t i = 0; i < width * height; ++i) {
      pixels[i] = words[i / 32] >> i % 32 & 1 ? 20 : 220;
    }
  }

  int run() { return application->run(); }

  FrameResult result(std::size_t n) {
    const auto& publication = fake_hal::state().publications.at(n);
    BOOST_REQUIRE(publication.kind == marker::frame_result_kind);
    BOOST_REQUIRE(publication.data.size() == sizeof(FrameResult));
    FrameResult result;
    std::memcpy(&result, publication.data.data(), sizeof result);
    return result;
  }

  FakePlatform platform;
  std::unique_ptr<ps_only::Application> application = std::make_unique<ps_only::Application>();
};

double us(const marker::StageTime& stage) {
  return static_cast<double>(stage.end - stage.start) / 333.333343;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(ps_only_application, Fixture)

BOOST_AUTO_TEST_CASE(finds_a_marker_without_the_pl) {
  add_marker(42);
  BOOST_TEST(run() == 0);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::ok));
  BOOST_TEST_REQUIRE(r.marker_count == 1u);
  BOOST_TEST(r.markers[0].identity.id == 42u);
  BOOST_TEST(r.markers[0].identity.rotation == 0u);
  BOOST_TEST(r.markers[0].pose.valid);
  BOOST_TEST(r.features.blob_count == 1u);
  BOOST_TEST(r.has_threshold);
  BOOST_TEST(r.threshold == 127u);
  BOOST_TEST(platform.controls.size() == 0u, "the PL was asked for something");
  BOOST_TEST(platform.image.size() == 0u);
}

BOOST_AUTO_TEST_CASE(threshold_adapts_from_frame_to_frame) {
  add_marker(1);
  add_marker(1);
  run();
  BOOST_TEST(result(0).threshold == 127u);
  BOOST_TEST(result(1).threshold == 120u, "between 20 and 220");
}

BOOST_AUTO_TEST_CASE(capture_takes_the_camera_s_time) {
  add_marker(1);
  run();
  const FrameResult r = result(0);
  BOOST_TEST(std::abs(us(r.times.capture) - 6144) < 5, us(r.times.capture));
  BOOST_TEST(r.times.capture.start == r.times.frame.start);
  BOOST_TEST(r.times.capture.start == r.times.feature_extraction.start);
  BOOST_TEST(r.times.blob_detection.end == r.times.feature_extraction.end);
  BOOST_TEST(r.times.pose.end == r.times.frame.end);
}

BOOST_AUTO_TEST_CASE(capture_follows_the_pixel_clock) {
  set("pixel_clock", 25);
  add_marker(1);
  run();
  BOOST_TEST(std::abs(us(result(0).times.capture) - 12288) < 5);
}

BOOST_AUTO_TEST_CASE(options_reach_the_detectors) {
  set("minimum_side", 200);
  add_marker(1);
  run();
  BOOST_TEST(result(0).features.blob_count == 0u);
  BOOST_TEST(result(0).marker_count == 0u);
}

BOOST_AUTO_TEST_CASE(binary_image_is_not_that_of_a_dma) {
  add_marker(1);
  run();
  const auto& work = fake_hal::state().work;
  BOOST_TEST(work.count(static_cast<std::uint32_t>(marker::Work::grid_samples)) == 1u);
  BOOST_TEST(work.count(static_cast<std::uint32_t>(marker::Work::grid_samples_dma)) == 0u);
  BOOST_TEST(fake_hal::state().function_stack.empty());
}

BOOST_AUTO_TEST_CASE(unsupported_sizes_are_reported_and_the_next_frame_goes_on) {
  platform.add_frame(100, 100);
  platform.add_frame(2080, 32);
  add_marker(7);
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::unsupported_size));
  BOOST_TEST((result(1).status == Status::unsupported_size));
  BOOST_TEST_REQUIRE(result(2).marker_count == 1u);
  BOOST_TEST(result(2).markers[0].identity.id == 7u);
  BOOST_TEST(fake_hal::state().console.find("100 x 100 px") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
