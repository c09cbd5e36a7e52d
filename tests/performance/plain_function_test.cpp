// The plain function that the transaction level is compared with does the same work.
#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "golden_sequence.h"
#include "pipeline.h"
#include "plain_function.h"

namespace {

const marker::Camera camera{381.36, 381.36, 320, 240};

std::vector<harness::Word> words_of(const bench::Detected& detected) {
  std::vector<harness::Word> words;
  for (const pl::StampedWord& c : detected.corners)
    words.push_back({'C', harness::detectors_begin + c.clock, c.word, 0});
  for (const pl::StampedBlob& b : detected.blobs)
    words.push_back({'B', harness::blobs_begin + b.clock, b.start, b.end});
  std::sort(words.begin(), words.end());
  return words;
}

std::vector<harness::Word> without_binary(std::vector<harness::Word> words) {
  words.erase(std::remove_if(words.begin(), words.end(),
                             [](const harness::Word& word) { return word.kind == 'T'; }),
              words.end());
  return words;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plain_function)

BOOST_AUTO_TEST_CASE(it_finds_the_words_of_the_models_fast_and_pixel_by_pixel) {
  harness::Pipeline pipeline;
  bench::PlainFunction<bench::FrameDetector> fast{pl::Geometry{}};
  bench::PlainFunction<bench::PixelDetector> naive{pl::Geometry{}};
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    pipeline.load(frame.image);
    const auto expected = without_binary(pipeline.run_frame());
    fast.run(frame.image.data(), camera);
    naive.run(frame.image.data(), camera);
    BOOST_TEST_CONTEXT(frame.name) {
      BOOST_TEST(harness::first_difference(words_of(fast.detected()), expected) == "");
      BOOST_TEST(harness::first_difference(words_of(naive.detected()), expected) == "");
      BOOST_TEST(fast.feature_words() == naive.feature_words());
    }
  }
}

BOOST_AUTO_TEST_CASE(it_finds_the_marker_and_its_pose_in_the_demo_scene) {
  const harness::Image image = harness::golden_sequence().front().image;
  bench::PlainFunction<bench::FrameDetector> function{pl::Geometry{}};
  function.run(image.data(), camera);  // the threshold adapts
  const auto pose = function.run(image.data(), camera);
  BOOST_REQUIRE(pose.has_value());
  BOOST_TEST(pose->valid);
  BOOST_TEST(function.marker_id() == 99);
  BOOST_TEST(function.feature_words() == 110u);
}

BOOST_AUTO_TEST_CASE(it_finds_nothing_in_a_white_picture) {
  const harness::Image white(640 * 480, 255);
  bench::PlainFunction<bench::FrameDetector> function{pl::Geometry{}};
  BOOST_TEST(!function.run(white.data(), camera).has_value());
  BOOST_TEST(function.marker_id() == -1);
  BOOST_TEST(function.feature_words() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
