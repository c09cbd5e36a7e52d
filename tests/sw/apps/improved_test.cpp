#include <apps/improved/application.h>
#include <apps/improved/own_dictionary.h>
#include <marker/scene/renderer.h>
#include <marker/work.h>

#include <blob_stream.h>

#include <boost/test/unit_test.hpp>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "fake_camera.h"
#include "marker/pictures.h"
#include "marker/views.h"

using marker::DetectionResult;
using Status = marker::DetectionStatus;

namespace {

/// What the logic makes of a picture.
CameraFrame frame_of(const platform::GreyImage& picture) {
  const std::vector<marker::Extremes> blobs =
      pictures::find_blobs(pictures::view(picture), 127, 10);
  CameraFrame frame{picture.pixels, pictures::words_of(blobs)};
  frame.packet.insert(frame.packet.end(), {0, static_cast<std::uint32_t>(blobs.size()), 0, 127});
  return frame;
}

/// Pictures are rendered once.
const CameraFrame& ten_markers() {
  static const CameraFrame frame = frame_of(platform::render(pictures::ten_markers()));
  return frame;
}

const CameraFrame& one_marker() {
  static const CameraFrame frame = frame_of(platform::render(platform::make_scene("demo")));
  return frame;
}

/// The same picture where the logic takes all of it for one blob.
CameraFrame on_dark_background() {
  CameraFrame frame = ten_markers();
  const auto corner = blob_stream::point(639, 479), right = blob_stream::point(639, 0),
             down = blob_stream::point(0, 479);
  frame.packet = {0, right, right, corner, down, down, 0, 0, 0, 1, 0, 127};
  return frame;
}

struct Fixture {
  Fixture() {
    auto& options = fake_hal::state().options;
    for (std::uint32_t i = 0; i < improved::option_count; ++i) {
      options[i] = improved::option_table[i].default_value;
    }
  }

  void set(const std::string& name, double value) {
    for (std::uint32_t i = 0; i < improved::option_count; ++i) {
      if (improved::option_table[i].name != name) continue;
      fake_hal::state().options[i] = value;
      return;
    }
    BOOST_FAIL("no option " << name);
  }

  void show(const std::vector<CameraFrame>& frames) {
    camera.frames = frames;
    for (std::size_t i = 0; i < frames.size(); ++i) camera.add_image(640, 480);
  }

  int run() { return application->run(); }

  const DetectionResult& result(std::size_t n) {
    const auto& publication = fake_hal::state().publications.at(n);
    BOOST_REQUIRE(publication.kind == marker::detection_result_kind);
    BOOST_REQUIRE(publication.data.size() <= sizeof *copy);
    std::memcpy(copy.get(), publication.data.data(), publication.data.size());
    BOOST_REQUIRE(publication.data.size() == marker::published_bytes(*copy));
    return *copy;
  }

  bool console_says(const char* text) {
    return fake_hal::state().console.find(text) != std::string::npos;
  }

  FakeCamera camera;
  std::unique_ptr<DetectionResult> copy = std::make_unique<DetectionResult>();
  std::unique_ptr<improved::Application> application = std::make_unique<improved::Application>();
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(improved_application, Fixture)

BOOST_AUTO_TEST_CASE(option_table_is_sound) {
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < improved::option_count; ++i) {
    const hal_option_info& option = improved::option_table[i];
    BOOST_TEST(names.insert(option.name).second);
    BOOST_TEST(option.minimum <= option.default_value);
    BOOST_TEST(option.default_value <= option.maximum);
    BOOST_TEST(!std::string(option.documentation).empty());
  }
  std::string dictionaries;
  for (const marker::Dictionary& dictionary : marker::dictionaries) {
    dictionaries += (dictionaries.empty() ? "" : "|") + std::string(dictionary.name);
  }
  BOOST_TEST(improved::option_table[0].unit == dictionaries);
}

BOOST_AUTO_TEST_CASE(options_make_board_and_dictionary) {
  set("dictionary", 16);
  set("board", 2);
  set("board_columns", 5);
  set("board_rows", 7);
  set("board_square", 0.04);
  set("marker_side", 0.03);
  const improved::Options options = improved::read_options();
  BOOST_TEST(options.dictionary->name == std::string("apriltag_36h11"));
  marker::Places places{};
  BOOST_TEST(options.detector.board.find(0, places));
  BOOST_TEST(places[0][1] == 0.005, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(!options.detector.board.find(17, places));
}

BOOST_AUTO_TEST_CASE(a_dictionary_and_its_border_may_be_the_users_own) {
  set("border_bits", 2);
  BOOST_TEST(improved::read_options().border == 2u);
  BOOST_TEST(improved::read_options().own_dictionary == nullptr);
  std::uint32_t option = 0;
  while (improved::option_table[option].name != std::string("dictionary_file")) ++option;
  fake_hal::state().option_data[option] = "what is in it";
  BOOST_TEST(improved::read_options().own_dictionary ==
             fake_hal::state().option_data[option].data());
}

// What is more than one cell of a border is part of the code.
BOOST_AUTO_TEST_CASE(wide_borders_are_black_cells_of_the_code) {
  const marker::Dictionary& known = *marker::find_dictionary("5x5_50");
  const auto own = std::make_unique<improved::OwnDictionary>();
  BOOST_TEST(own->open(known, nullptr, 1));
  BOOST_TEST(own->get().words == known.words);
  BOOST_TEST(own->open(known, nullptr, 2));
  BOOST_TEST(own->get().cells == 7u);
  for (std::uint32_t id = 0; id < known.size; ++id) {
    const std::uint64_t word = own->get().words[id];
    BOOST_TEST(word >> 41 == 0xFFu, "the first row, and the first cell of the second one");
    BOOST_TEST((word >> 36 & 0x1F) == known.words[id] >> 20);
    BOOST_TEST((word >> 8 & 0x1F) == (known.words[id] & 0x1F));
    BOOST_TEST((word & 0xFF) == 0xFFu);
    BOOST_TEST((marker::rotate_clockwise(word, 7) >> 36 & 0x1F) ==
               marker::rotate_clockwise(known.words[id], 5) >> 20);
  }
  BOOST_TEST(!own->open(known, nullptr, 3), "nine cells a side are more bits than a word has");
  const std::uint64_t data[] = {3, 1, 24, 3, 0b101010001};
  BOOST_TEST(own->open(known, data, 1), "the file says how wide");
  BOOST_TEST(own->get().cells == 7u);
  BOOST_TEST(own->get().distance == 20u, "no more cells are corrected than the code book can");
  BOOST_TEST(own->get().words[0] == (std::uint64_t{0x3FFF} << 35 | 0b1110111ull << 28 |
                                     0b1101011ull << 21 | 0b1100111ull << 14 | 0x3FFF));
}

BOOST_AUTO_TEST_CASE(a_border_that_does_not_fit_is_told) {
  set("dictionary", 12);
  set("border_bits", 2);
  show({ten_markers()});
  BOOST_TEST(run() == 1);
  BOOST_TEST(console_says("border is too wide"));
}

BOOST_AUTO_TEST_CASE(finds_all_markers_and_their_poses) {
  show({ten_markers()});
  BOOST_TEST(run() == 0);
  const DetectionResult& r = result(0);
  BOOST_TEST((r.status == Status::ok));
  BOOST_TEST(r.frame == 0u);
  BOOST_TEST(r.width == 640u);
  BOOST_TEST(r.threshold == 127u);
  BOOST_TEST(r.found.count == 10u);
  for (std::uint32_t i = 0; i < r.found.count; ++i) BOOST_TEST(r.found.markers[i].pose.valid);
  BOOST_TEST(fake_hal::state().console.empty());
  BOOST_TEST(fake_hal::state().publications.at(0).data.size() < sizeof(DetectionResult) / 10);
}

BOOST_AUTO_TEST_CASE(finds_the_pose_of_a_board) {
  set("board", 1);
  set("board_columns", 5);
  set("board_rows", 2);
  set("board_gap", 0.26);
  show({ten_markers()});
  BOOST_TEST(run() == 0);
  const DetectionResult& r = result(0);
  BOOST_TEST(r.found.board_markers == 10u);
  BOOST_REQUIRE(r.found.board.valid);
  const platform::Scene scene = pictures::ten_markers();
  BOOST_TEST((views::translation_of(r.found.board.best) - scene.pose.translation).norm() < 0.001);
}

BOOST_AUTO_TEST_CASE(the_next_frame_is_triggered_before_this_one_is_worked_on) {
  show({ten_markers(), one_marker(), ten_markers(), one_marker()});
  BOOST_TEST(run() == 0);
  BOOST_TEST(camera.triggers == 4u);
  const std::vector<std::size_t> published = {0, 0, 1, 2};
  BOOST_TEST(camera.published_at_trigger == published, boost::test_tools::per_element());
  // Two pairs of buffers, in turn.
  const auto& addresses = camera.picture_addresses;
  BOOST_TEST(addresses[0] != addresses[1]);
  BOOST_TEST(addresses[0] == addresses[2]);
  BOOST_TEST(addresses[1] == addresses[3]);
  const std::uint32_t markers[] = {10, 1, 10, 1};
  for (std::uint32_t i = 0; i < 4; ++i) {
    BOOST_TEST(result(i).frame == i);
    BOOST_TEST(result(i).camera_frame == i);
    BOOST_TEST(result(i).found.count == markers[i]);
  }
}

BOOST_AUTO_TEST_CASE(without_overlap_frames_are_taken_one_by_one) {
  set("overlap", 0);
  show({ten_markers(), one_marker(), ten_markers()});
  BOOST_TEST(run() == 0);
  const std::vector<std::size_t> published = {0, 1, 2};
  BOOST_TEST(camera.published_at_trigger == published, boost::test_tools::per_element());
  BOOST_TEST(result(1).found.count == 1u);
}

BOOST_AUTO_TEST_CASE(one_interrupt_a_frame) {
  show({one_marker(), one_marker(), one_marker()});
  run();
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::interrupts)] == 3u);
  BOOST_TEST(fake_hal::state().sleeps == 3u);
}

BOOST_AUTO_TEST_CASE(stages_follow_each_other) {
  show({one_marker(), one_marker()});
  run();
  for (std::size_t i = 0; i < 2; ++i) {
    const marker::DetectionTimes t = result(i).times;
    BOOST_TEST(t.capture.start < t.capture.end);
    BOOST_TEST(t.capture.end <= t.detection.start);
    BOOST_TEST(t.detection.start < t.detection.end);
    BOOST_TEST(t.detection.end == t.pose.start);
    BOOST_TEST(t.frame.start == t.capture.start);
    BOOST_TEST(t.frame.end == t.pose.end);
  }
}

BOOST_AUTO_TEST_CASE(a_picture_that_is_late_is_waited_for) {
  camera.picture_delay = 20;
  show({ten_markers()});
  BOOST_TEST(run() == 0);
  BOOST_TEST(result(0).found.count == 10u);
}

BOOST_AUTO_TEST_CASE(what_the_logic_lost_is_told) {
  CameraFrame frame = one_marker();
  frame.packet[frame.packet.size() - 2] = 17;
  show({frame});
  BOOST_TEST(run() == 0);
  BOOST_TEST(result(0).lost_in_logic == 17u);
}

BOOST_AUTO_TEST_CASE(frames_without_blobs_are_results) {
  CameraFrame frame = one_marker();
  frame.packet = {0, 0, 0, 127};
  show({frame});
  BOOST_TEST(run() == 0);
  BOOST_TEST((result(0).status == Status::ok));
  BOOST_TEST(result(0).found.blobs.received == 0u);
}

BOOST_AUTO_TEST_CASE(markers_on_a_dark_background_are_parted_from_it) {
  set("tries", 3);
  show({on_dark_background()});
  run();
  const DetectionResult& found = result(0);
  BOOST_TEST(found.found.count == 10u);
  BOOST_TEST(found.found.blobs.background == 1u);
  for (std::uint32_t i = 0; i < found.found.count; ++i)
    BOOST_TEST(found.found.markers[i].pose.valid);
}

BOOST_AUTO_TEST_CASE(without_outlines_a_dark_background_hides_its_markers) {
  set("tries", 2);
  show({on_dark_background()});
  run();
  BOOST_TEST(result(0).found.count == 0u);
  BOOST_TEST(result(0).found.blobs.background == 1u);
}

BOOST_AUTO_TEST_CASE(outlines_are_for_pictures_of_a_camera) {
  show({on_dark_background(), on_dark_background()});
  fake_hal::state().frames[0].response = HAL_RESPONSE_UNKNOWN;
  run();
  BOOST_TEST(result(0).found.count == 10u, "a camera's");
  BOOST_TEST(result(1).found.count == 0u, "levels that are light, as a scene's");
}

BOOST_AUTO_TEST_CASE(a_silent_camera_times_out_and_the_next_frame_recovers) {
  for (const bool overlap : {true, false}) {
    Fixture f;
    f.set("overlap", overlap);
    f.camera.wrong_from = 1;
    f.camera.sends_packet = false;
    f.show({one_marker(), one_marker(), one_marker()});
    BOOST_TEST(f.run() == 1);
    BOOST_TEST((f.result(0).status == Status::ok));
    BOOST_TEST((f.result(1).status == Status::timeout));
    BOOST_TEST((f.result(2).status == Status::ok));
    BOOST_TEST(f.result(2).found.count == 1u);
    BOOST_TEST(f.camera.logic_resets == 1u);
    BOOST_TEST(f.camera.resets == 4u);
    BOOST_TEST(
        f.console_says("improved: frame 1: no packet of blobs in time, 640 x 480 px, DMASR"));
  }
}

BOOST_AUTO_TEST_CASE(dma_errors_give_the_frame_up) {
  struct Way {
    std::uint32_t packet_error, picture_error;
    Status status;
  };
  for (const Way& way : {Way{0x40, 0, Status::packet_error}, Way{0, 0x20, Status::picture_error}}) {
    Fixture f;
    f.camera.wrong_from = 0;
    f.camera.packet_error = way.packet_error;
    f.camera.picture_error = way.picture_error;
    f.show({one_marker(), one_marker()});
    BOOST_TEST(f.run() == 1);
    BOOST_TEST((f.result(0).status == way.status));
    BOOST_TEST(f.result(0).found.count == 0u);
    BOOST_TEST((f.result(1).status == Status::ok));
    BOOST_TEST(f.camera.resets == 4u);
  }
}

BOOST_AUTO_TEST_CASE(torn_pictures_are_never_worked_on) {
  camera.wrong_from = 1;
  camera.picture_bytes_short = 640;
  show({one_marker(), one_marker(), one_marker()});
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(1).status == Status::picture_cut));
  BOOST_TEST((result(2).status == Status::ok));
}

BOOST_AUTO_TEST_CASE(a_picture_that_never_ends_times_out) {
  camera.wrong_from = 0;
  camera.sends_picture = false;
  show({one_marker(), one_marker()});
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::picture_cut));
  BOOST_TEST((result(1).status == Status::ok));
}

BOOST_AUTO_TEST_CASE(hostile_packets_are_told_and_never_followed) {
  CameraFrame cut = one_marker(), longer = one_marker(), wrong_count = one_marker(), none{};
  cut.packet.pop_back();
  longer.packet.assign(blob_stream::packet_words(blob_stream::max_blobs) + 8, 0x00640064);
  wrong_count.packet[wrong_count.packet.size() - 3] = 0xFFFF'FFFF;
  none.picture = one_marker().picture;
  none.packet = {1};
  const std::vector<std::pair<CameraFrame, Status>> ways = {{cut, Status::malformed_packet},
                                                            {longer, Status::packet_error},
                                                            {wrong_count, Status::malformed_packet},
                                                            {none, Status::malformed_packet}};
  for (const auto& [frame, status] : ways) {
    Fixture f;
    f.show({frame, one_marker()});
    BOOST_TEST(f.run() == 1);
    BOOST_TEST((f.result(0).status == status));
    BOOST_TEST((f.result(1).status == Status::ok));
    BOOST_TEST(f.result(1).found.count == 1u);
  }
}

BOOST_AUTO_TEST_CASE(blobs_outside_of_the_picture_are_counted) {
  CameraFrame frame = one_marker();
  frame.packet[3] = 0xFFFF'FFFF;
  show({frame});
  BOOST_TEST(run() == 0);
  BOOST_TEST(result(0).found.blobs.malformed == 1u);
}

BOOST_AUTO_TEST_CASE(a_frame_of_another_trigger_is_refused) {
  camera.wrong_from = 1;
  camera.number_offset = 1;
  show({one_marker(), one_marker(), one_marker()});
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(1).status == Status::wrong_frame));
  BOOST_TEST((result(2).status == Status::ok));
}

BOOST_AUTO_TEST_CASE(any_wrong_bit_of_a_packet_with_a_checksum_is_noticed) {
  const std::uint32_t bits = static_cast<std::uint32_t>(one_marker().packet.size()) * 32;
  const std::uint32_t is_checked = bits - 32 + 8;  // without it there is no checksum to look at
  for (std::uint32_t bit = 0; bit < bits; bit += 1 + bit % 7) {
    Fixture f;
    f.camera.checksum = true;
    f.camera.wrong_from = 1;
    f.camera.wrong_bit = bit;
    f.show({one_marker(), one_marker(), one_marker()});
    BOOST_TEST_CONTEXT("bit " << bit) {
      BOOST_TEST(f.run() == (bit == is_checked ? 0 : 1));
      BOOST_TEST((f.result(0).status == Status::ok));
      BOOST_TEST(f.result(0).found.count == 1u);
      BOOST_TEST((f.result(1).status == Status::ok) == (bit == is_checked));
      BOOST_TEST((f.result(2).status == Status::ok));
    }
  }
}

BOOST_AUTO_TEST_CASE(without_a_checksum_a_wrong_bit_of_a_blob_is_believed) {
  camera.wrong_from = 0;
  camera.wrong_bit = 4;
  show({one_marker()});
  BOOST_TEST(run() == 0);
  BOOST_TEST((result(0).status == Status::ok));
}

BOOST_AUTO_TEST_CASE(sizes_that_the_logic_or_the_dma_does_not_allow_are_refused) {
  camera.frames = {one_marker()};
  for (const auto& [width, height] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
           {0, 0}, {4096, 480}, {640, 4096}, {33, 17}, {2048, 2048}}) {
    camera.add_image(width, height);
  }
  camera.add_image(640, 480);
  BOOST_TEST(run() == 1);
  for (std::size_t i = 0; i < 5; ++i) BOOST_TEST((result(i).status == Status::unsupported_size));
  BOOST_TEST((result(5).status == Status::ok));
  BOOST_TEST(camera.triggers == 1u);
  BOOST_TEST(console_says("improved: frame 1: unsupported size, 4096 x 480 px\n"));
}

BOOST_AUTO_TEST_CASE(without_dma_memory_nothing_starts) {
  fake_hal::state().out_of_memory = true;
  show({one_marker()});
  BOOST_TEST(run() == 1);
  BOOST_TEST((result(0).status == Status::no_memory));
  BOOST_TEST(camera.triggers == 0u);
}

BOOST_AUTO_TEST_CASE(an_engine_that_stays_in_reset_ends_the_program) {
  camera.reset_hangs = true;
  show({one_marker()});
  BOOST_TEST(run() == 1);
  BOOST_TEST(fake_hal::state().publications.empty());
  BOOST_TEST(console_says("does not leave reset"));
}

BOOST_AUTO_TEST_CASE(annotations_balance_and_interrupts_are_masked_at_the_end) {
  show({ten_markers()});
  run();
  BOOST_TEST(fake_hal::state().function_stack.empty());
  BOOST_TEST(!fake_hal::state().enabled);
  BOOST_TEST((fake_hal::state().handler == nullptr));
}

BOOST_AUTO_TEST_SUITE_END()
