// Corner, blob and binary words against the reference RTL, word for word and clock for clock.
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>

#include "change_log.h"
#include "golden.h"
#include "golden_sequence.h"
#include "pipeline.h"

namespace {

const std::string folder = MARKERVP_TEST_DATA "/golden/";

harness::Golden run(harness::Pipeline& pipeline, const harness::GoldenFrame& frame) {
  pipeline.load(frame.image);
  harness::Golden result{frame.name, pipeline.run_frame(), 0};
  result.threshold = pipeline.pl.global_threshold.active_threshold;
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(golden)

// One run without a system reset: each frame's threshold comes from the frame before.
BOOST_AUTO_TEST_CASE(the_sequence_gives_the_words_of_the_reference) {
  harness::Pipeline pipeline;
  std::vector<harness::Fingerprint> prints;
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    const harness::Golden result = run(pipeline, frame);
    BOOST_TEST_CONTEXT(frame.name) {
      if (frame.complete) {
        const auto golden = harness::read_golden(folder + frame.name + ".words");
        BOOST_REQUIRE(golden.size() == 1u);
        BOOST_TEST(harness::first_difference(result.words, golden[0].words) == "");
        BOOST_TEST(result.threshold == golden[0].threshold);
        BOOST_TEST(harness::count(result.words, 'T') == 9600u);
      } else {
        prints.push_back(harness::fingerprint(result));
      }
    }
  }
  BOOST_TEST(prints == harness::read_fingerprints(folder + "fingerprints.txt"),
             boost::test_tools::per_element());
}

// What the frames are there for really happens in them.
BOOST_AUTO_TEST_CASE(the_frames_reach_the_limits_they_are_made_for) {
  harness::Pipeline pipeline;
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    const harness::Golden result = run(pipeline, frame);
    BOOST_TEST(pipeline.pl.clock_crossing.crossing_overflow.get() == 0u);
    if (frame.name == "noise") BOOST_TEST(harness::count(result.words, 'C') > 18'000u);
    if (frame.name == "stripes")
      BOOST_TEST(pipeline.pl.blob_detection.label_overflow.get() > 1000u);
    if (frame.name == "cut_blobs") BOOST_TEST(harness::count(result.words, 'B') == 16u);
    if (frame.name == "squares15") BOOST_TEST(harness::count(result.words, 'B') >= 15u);
  }
}

// And half a pixel clock, if a reader has taken the last blobs by then: those that the last line
// cuts off leave 11 clocks before.
BOOST_AUTO_TEST_CASE(the_end_word_of_a_scene_comes_at_clock_307_217) {
  harness::Pipeline pipeline;
  pipeline.driver.acknowledge_after_ps = 10'000;
  harness::ChangeLog feature(pipeline.pl.feature_packaging.feature, pipeline.scheduler);
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    if (!frame.complete) continue;
    run(pipeline, frame);
    BOOST_TEST_CONTEXT(frame.name) {
      const harness::Change end{pipeline.monitor.time_of(307'217) + 10'000, 0xFFFF'FFFF};
      BOOST_TEST(feature.changes.back() == end);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_system_reset_between_two_frames_changes_the_words) {
  const std::vector<harness::GoldenFrame> sequence = harness::golden_sequence();
  harness::Pipeline pipeline;
  const harness::Golden first = run(pipeline, sequence[1]);
  const auto golden = harness::read_golden(folder + sequence[1].name + ".words");
  // 127, not what the demo before it gave.
  BOOST_TEST(harness::first_difference(first.words, golden[0].words) != "");
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  harness::GoldenFrame frame = harness::golden_sequence().front();
  const std::vector<harness::Golden> golden = harness::read_golden(folder + frame.name + ".words");
  std::uint8_t& pixel = frame.image[200 * 640 + 300];
  pixel = pixel > 127 ? 0 : 255;
  harness::Pipeline pipeline;
  BOOST_TEST(harness::first_difference(run(pipeline, frame).words, golden[0].words) != "");
}

BOOST_AUTO_TEST_CASE(differences_of_word_clock_kind_and_number_are_found) {
  const std::vector<harness::Word> words{{'T', 34, 1, 0}, {'B', 40, 2, 3}, {'C', 41, 4, 0}};
  BOOST_TEST(harness::first_difference(words, words) == "");
  const auto changed = [&words](std::size_t i, harness::Word word) {
    std::vector<harness::Word> other = words;
    other[i] = word;
    BOOST_TEST(harness::hash(other) != harness::hash(words));
    return harness::first_difference(words, other);
  };
  BOOST_TEST(changed(0, {'T', 35, 1, 0}) == "word 0: T 34 1 against T 35 1");
  BOOST_TEST(changed(1, {'B', 40, 2, 4}) == "word 1: B 40 2 3 against B 40 2 4");
  BOOST_TEST(changed(2, {'T', 41, 4, 0}) == "word 2: C 41 4 against T 41 4");
  std::vector<harness::Word> shorter = words;
  shorter.pop_back();
  BOOST_TEST(harness::first_difference(words, shorter) == "word 2: C 41 4 against nothing");
  BOOST_TEST(harness::hash(shorter) != harness::hash(words));
}

BOOST_AUTO_TEST_CASE(a_golden_file_comes_back_as_it_was_written) {
  harness::Golden frame{"name", {}, 99};
  for (std::uint64_t i = 0; i < 40; ++i) {
    frame.words.push_back({'T', 34 + 32 * i, i == 7 ? 5u : 0xFFFF'FFFFu, 0});
  }
  frame.words.push_back({'C', 2000, 0x8000'0001, 0});
  frame.words.push_back({'B', 2001, 0x4000'0001, 0x0000'0002});
  frame.words.push_back({'T', 2010, 5, 0});
  const auto file = std::filesystem::temp_directory_path() / "markervp_golden_test.words";
  {
    std::ofstream out(file);
    harness::write_golden(out, frame);
  }
  const std::vector<harness::Golden> read = harness::read_golden(file.string());
  std::filesystem::remove(file);
  BOOST_REQUIRE(read.size() == 1u);
  BOOST_TEST(read[0].name == "name");
  BOOST_TEST(read[0].threshold == 99);
  BOOST_TEST(harness::first_difference(read[0].words, frame.words) == "");
}

BOOST_AUTO_TEST_SUITE_END()
