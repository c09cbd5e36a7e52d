#include <apps/hybrid/application.h>
#include <marker/feature_set.h>
#include <marker/work.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <memory>

#include "fake_platform.h"
#include "marker/synthetic_image.h"

using marker::Direction;
using marker::FrameResult;
using marker::Quad;
using marker::Status;
namespace packet = marker::packet;

namespace {

const Quad front{{{200, 120}, {319, 120}, {319, 239}, {200, 239}}};

struct Fixture {
  Fixture() {
    auto& options = fake_hal::state().options;
    for (std::uint32_t i = 0; i < hybrid::option_count; ++i) {
      options[i] = hybrid::option_table[i].default_value;
    }
  }

  /// Lays ready what the PL makes of an image with one marker, turned by 1 quarter.
  void show_marker(unsigned id, std::uint32_t width = 640, std::uint32_t height = 480) {
    synthetic::Image image(width, height);
    image.draw_marker(marker::dictionary[id], {front[1], front[2], front[3], front[0]});
    platform.binary = image.words();
    const Direction directions[] = {Direction::north, Direction::east, Direction::south,
                                    Direction::west};
    platform.features.clear();
    for (unsigned i = 0; i < 4; ++i) {
      platform.features.push_back(
          packet::encode({static_cast<std::uint16_t>(front[i].x),
                          static_cast<std::uint16_t>(front[i].y), 200, directions[i], 0}));
    }
    const marker::BoundingBox box{200, 120, 319, 239, 0};
    platform.features.push_back(packet::encode_start(box));
    platform.features.push_back(packet::encode_end(box));
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

  bool console_says(const char* text) {
    return fake_hal::state().console.find(text) != std::string::npos;
  }

  FakePlatform platform;
  std::unique_ptr<hybrid::Application> application = std::make_unique<hybrid::Application>();
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(hybrid_application, Fixture)

BOOST_AUTO_TEST_CASE(finds_the_marker) {
  show_marker(99);
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 0);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::ok));
  BOOST_TEST(r.frame == 0u);
  BOOST_TEST(r.feature_words == 7u);
  BOOST_TEST(r.features.corner_count == 4u);
  BOOST_TEST(r.features.blob_count == 1u);
  BOOST_TEST(r.binary_packets == 300u);
  BOOST_TEST(r.candidates.count == 1u);
  BOOST_REQUIRE(r.marker_count == 1u);
  BOOST_TEST(r.markers[0].identity.id == 99);
  BOOST_TEST(r.markers[0].identity.rotation == 1);
  BOOST_TEST(r.markers[0].corners[0].x == 319.5);
  BOOST_TEST(r.markers[0].corners[0].y == 120.5);
  BOOST_TEST(r.markers[0].pose.valid);
  // 119 px wide: 381.36 · 0.3 / 119 m away.
  BOOST_CHECK_CLOSE(r.markers[0].pose.translation[2], 381.36 * 0.3 / 119, 0.01);
  BOOST_TEST(fake_hal::state().console.empty());
}

BOOST_AUTO_TEST_CASE(whole_image_goes_up_burst_by_burst) {
  show_marker(99);
  platform.add_frame(640, 480);
  run();
  const hal_frame& frame = fake_hal::state().frames[0];
  BOOST_REQUIRE(platform.image.size() == 307'200u);
  BOOST_TEST(std::equal(platform.image.begin(), platform.image.end(), frame.pixels));
  const auto interrupts = static_cast<std::uint32_t>(marker::Work::interrupts);
  BOOST_TEST(fake_hal::state().work[interrupts] == 2400u + 300u);
}

BOOST_AUTO_TEST_CASE(control_packets_of_a_frame) {
  show_marker(99);
  platform.add_frame(640, 480);
  run();
  // Start-up; upload; reset with ena low; ena; six acknowledges, each toggling ready.
  const std::vector<std::uint32_t> expected = {0, 0x10, 0, 0, 2, 0, 1, 0xD, 1, 0xD, 1, 0xD, 1};
  BOOST_TEST(platform.controls == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(second_frame_starts_afresh) {
  show_marker(42);
  platform.add_frame(640, 480);
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 0);
  BOOST_TEST(platform.frames == 2u);
  BOOST_TEST(platform.resets == 2u);  // both engines at start-up only
  BOOST_TEST(result(1).frame == 1u);
  BOOST_TEST(result(1).marker_count == 1u);
  BOOST_TEST(result(1).feature_words == 7u);
}

BOOST_AUTO_TEST_CASE(stages_follow_each_other) {
  show_marker(99);
  platform.add_frame(640, 480);
  run();
  const marker::StageTimes t = result(0).times;
  BOOST_TEST(t.upload.start < t.upload.end);
  BOOST_TEST(t.upload.end <= t.feature_extraction.start);
  BOOST_TEST(t.feature_extraction.start < t.feature_extraction.end);
  BOOST_TEST(t.feature_extraction.end == t.receive.start);
  BOOST_TEST(t.receive.end == t.evaluation.start);
  BOOST_TEST(t.evaluation.end == t.identification.start);
  BOOST_TEST(t.identification.end == t.pose.start);
  BOOST_TEST(t.frame.start == t.feature_extraction.start);
  BOOST_TEST(t.frame.end == t.pose.end);
}

BOOST_AUTO_TEST_CASE(binary_image_is_invalidated_before_it_is_read) {
  show_marker(99);
  platform.add_frame(640, 480);
  run();
  const auto& invalidated = fake_hal::state().invalidated;
  BOOST_REQUIRE(invalidated.size() == 1u);
  BOOST_TEST(invalidated[0].second == 38'400u);
}

BOOST_AUTO_TEST_CASE(image_without_markers_is_a_result) {
  platform.binary.assign(9600, 0);
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 0);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::ok));
  BOOST_TEST(r.feature_words == 1u);
  BOOST_TEST(r.marker_count == 0u);
  BOOST_TEST(r.times.pose.end == r.times.frame.end);
}

BOOST_AUTO_TEST_CASE(smaller_images_take_fewer_bursts) {
  show_marker(7, 320, 256);
  platform.add_frame(320, 256);
  BOOST_TEST(run() == 0);
  BOOST_TEST(result(0).binary_packets == 80u);
  BOOST_TEST(result(0).marker_count == 1u);
  BOOST_TEST(platform.image.size() == 81'920u);
}

BOOST_AUTO_TEST_CASE(sizes_that_the_packets_do_not_allow_are_refused) {
  const std::uint32_t sizes[][2] = {{0, 0}, {648, 480}, {2080, 480}, {640, 2080}, {32, 31}};
  for (const auto& size : sizes) platform.add_frame(size[0], size[1]);
  BOOST_TEST(run() == 1);
  for (std::size_t i = 0; i < 5; ++i) {
    BOOST_TEST((result(i).status == Status::unsupported_size));
  }
  BOOST_TEST(platform.frames == 0u);
  BOOST_TEST(console_says("hybrid: frame 1: unsupported size, 648 x 480 px\n"));
}

BOOST_AUTO_TEST_CASE(without_dma_memory_nothing_starts) {
  platform.add_frame(640, 480);
  fake_hal::state().out_of_memory = true;
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::no_memory));
  BOOST_TEST(platform.frames == 0u);
}

BOOST_AUTO_TEST_CASE(engine_that_stays_in_reset_ends_the_program) {
  platform.reset_hangs = true;
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  BOOST_TEST(fake_hal::state().publications.empty());
  BOOST_TEST(console_says("does not leave reset"));
}

BOOST_AUTO_TEST_CASE(silent_upload_times_out_and_the_next_frame_recovers) {
  show_marker(99);
  platform.image_bursts = 100;
  platform.add_frame(640, 480);
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::upload_timeout));
  BOOST_TEST(result(0).feature_words == 0u);
  BOOST_TEST(platform.resets == 4u);
  BOOST_TEST(console_says("upload timed out"));
}

BOOST_AUTO_TEST_CASE(error_of_the_image_dma_is_reported_with_its_status) {
  show_marker(99);
  platform.image_bursts = 5;
  platform.dma_error = 0x40;  // decode error
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::upload_error));
  BOOST_TEST(console_says("DMASR 0x00004041"));
}

BOOST_AUTO_TEST_CASE(missing_end_word_times_out_with_what_came) {
  show_marker(99);
  platform.sends_end_word = false;
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::feature_timeout));
  BOOST_TEST(r.features.corner_count == 4u);
  BOOST_TEST(r.features.blob_count == 1u);
  BOOST_TEST(r.marker_count == 0u);
}

BOOST_AUTO_TEST_CASE(lost_packet_of_the_binary_image_times_out) {
  show_marker(99);
  platform.binary_packets = 299;
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::binary_timeout));
  BOOST_TEST(r.binary_packets == 299u);
  BOOST_TEST(r.features.corner_count == 4u);
  BOOST_TEST(r.marker_count == 0u);
}

BOOST_AUTO_TEST_CASE(error_of_the_binary_dma_ends_the_wait) {
  show_marker(99);
  platform.binary_packets = 10;
  platform.dma_error = 0x10;
  platform.add_frame(640, 480);
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::binary_error));
  BOOST_TEST(platform.resets == 4u);
}

BOOST_AUTO_TEST_CASE(endless_features_stop_at_the_store) {
  platform.binary.assign(9600, 0);
  for (std::uint32_t i = 0; i < marker::max_words + 10; ++i) {
    platform.features.push_back(0x8000'0000u | i);
  }
  platform.add_frame(640, 480);
  BOOST_TEST(run() == 1);
  const FrameResult r = result(0);
  BOOST_TEST((r.status == Status::too_many_features));
  BOOST_TEST(r.feature_words == marker::max_words + 1);
  BOOST_TEST(r.lost_words == 1u);
  BOOST_TEST(r.features.lost_corners == marker::max_words - marker::max_corners);
}

BOOST_AUTO_TEST_CASE(annotations_balance_and_interrupts_are_masked_at_the_end) {
  show_marker(99);
  platform.add_frame(640, 480);
  run();
  BOOST_TEST(fake_hal::state().function_stack.empty());
  BOOST_TEST(!fake_hal::state().enabled);
  BOOST_TEST((fake_hal::state().handler == nullptr));
}

BOOST_AUTO_TEST_SUITE_END()
