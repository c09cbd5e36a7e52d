// Sizes of frames, and parameters by name.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>

#include <set>

#include "naive_detector.h"
#include "pipeline.h"

namespace {

using harness::Pipeline;
using harness::Word;

std::string refusal(const std::vector<std::string>& settings) {
  try {
    Pipeline pipeline({}, settings);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(int width, int height) {
  return refusal(harness::frame_size(width, height));
}

std::vector<Word> words_with(const std::vector<std::string>& settings,
                             const harness::Image& image) {
  std::vector<std::string> all = harness::frame_size(128, 64);
  all.insert(all.end(), settings.begin(), settings.end());
  Pipeline pipeline({}, all);
  pipeline.load(image);
  return pipeline.run_frame();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(geometry)

// Corners and binary words by the plain definition, without pipeline and line buffers.
BOOST_AUTO_TEST_CASE(frames_of_any_size_give_what_the_definition_says) {
  const std::pair<int, int> sizes[] = {{32, 32},  {32, 64},   {64, 16},   {64, 32},    {96, 64},
                                       {128, 64}, {640, 480}, {1024, 16}, {1024, 512}, {1280, 720}};
  for (const auto& [width, height] : sizes) {
    BOOST_TEST_CONTEXT(width << "x" << height) {
      for (const harness::Image& image :
           {harness::noise(width, height, 51), harness::rectangles(width, height, 60, 52)}) {
        Pipeline pipeline({}, harness::frame_size(width, height));
        pipeline.load(image);
        std::vector<Word> words;
        for (const Word& word : pipeline.run_frame()) {
          if (word.kind != 'B') words.push_back(word);
        }
        BOOST_TEST(harness::first_difference(
                       words, harness::naive_words(image, width, height, 30, 127)) == "");
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(sizes_that_cannot_be_built_are_refused_with_the_reason) {
  BOOST_TEST(refusal(640, 480) == "accepted");
  BOOST_TEST(refusal(1920, 1080) == "accepted");
  BOOST_TEST(refusal(2048, 2048) == "accepted");
  BOOST_TEST(refusal(32, 32) == "accepted");
  BOOST_TEST(refusal(2080, 32) ==
             "frames of 2080x32 px cannot be built: pl.width must lie between 32 and 2048 px "
             "(the feature words have no bits for more)");
  BOOST_TEST(refusal(16, 64) ==
             "frames of 16x64 px cannot be built: pl.width must lie between 32 and 2048 px "
             "(the feature words have no bits for more)");
  BOOST_TEST(refusal(64, 2064) ==
             "frames of 64x2064 px cannot be built: pl.height must lie between 16 and 2048 px "
             "(the feature words have no bits for more)");
  BOOST_TEST(refusal(1024, 8) ==
             "frames of 1024x8 px cannot be built: pl.height must lie between 16 and 2048 px "
             "(the feature words have no bits for more)");
  BOOST_TEST(refusal(48, 64) ==
             "frames of 48x64 px cannot be built: pl.width must be a multiple of 32 px "
             "(whole binary words)");
  BOOST_TEST(refusal(96, 50) ==
             "frames of 96x50 px cannot be built: pl.width x pl.height must be a multiple of 1024 "
             "(whole bursts of 32 words; pl.burst_words=2 fits)");
  BOOST_TEST(refusal(0, 0).find("frames of 0x0 px cannot be built: ") == 0u);
}

BOOST_AUTO_TEST_CASE(the_corner_threshold_is_a_parameter) {
  const harness::Image image = harness::noise(128, 64, 53);
  for (const unsigned t : {0u, 60u, 255u}) {
    BOOST_TEST_CONTEXT("threshold " << t) {
      std::vector<Word> words =
          words_with({"pl.corner_detection.threshold=" + std::to_string(t)}, image);
      words.erase(std::remove_if(words.begin(), words.end(),
                                 [](const Word& word) { return word.kind == 'B'; }),
                  words.end());
      BOOST_TEST(harness::first_difference(words, harness::naive_words(image, 128, 64, t, 127)) ==
                 "");
    }
  }
}

BOOST_AUTO_TEST_CASE(the_smallest_blob_is_a_parameter) {
  const harness::Image image = harness::one_rectangle(128, 64, 10, 10, 30, 32);
  const auto blobs = [&image](const std::string& side) {
    return harness::count(words_with({"pl.blob_detection.minimum_side=" + side + " px"}, image),
                          'B');
  };
  BOOST_TEST(blobs("24") == 0u);
  BOOST_TEST(blobs("21") == 0u);  // Ex - Sx is 20
  BOOST_TEST(blobs("20") == 1u);
}

BOOST_AUTO_TEST_CASE(buffer_depths_and_labels_are_parameters) {
  Pipeline pipeline(
      {}, {"pl.width=128 px", "pl.height=64 px", "pl.blob_detection.label_count=8",
           "pl.feature_packaging.buffer_depth=10", "pl.axi_threshold_bridge.fifo_depth=3"});
  pipeline.load(harness::noise(128, 64, 54));
  pipeline.sink.accept(false);
  pipeline.reset();
  pipeline.raise_ena();
  pipeline.run_to_clock(pipeline.clocks_of_a_frame());
  BOOST_TEST(pipeline.pl.blob_detection.label_overflow.get() > 0u);
  BOOST_TEST(pipeline.pl.feature_packaging.corner_count.get() == 10u);
  BOOST_TEST(pipeline.pl.axi_threshold_bridge.bridge_overflow.get() == 256u - 4u);
}

BOOST_AUTO_TEST_CASE(wrong_keys_units_and_values_are_refused) {
  BOOST_TEST(refusal({"pl.corner_detection.treshold=30"}).find("threshold") != std::string::npos);
  BOOST_TEST(refusal({"pl.corner_detection.threshold=256"}) != "accepted");
  BOOST_TEST(refusal({"pl.corner_detection.threshold=-1"}) != "accepted");
  BOOST_TEST(refusal({"pl.width=640 MHz"}) != "accepted");
  BOOST_TEST(refusal({"pl.blob_detection.label_count=3"}) != "accepted");
  BOOST_TEST(refusal({"pl.feature_packaging.buffer_depth=1"}) != "accepted");
  for (const char* wrong : {"pl.corner_detection.threshold=256", "pl.width=640 MHz"}) {
    BOOST_TEST(refusal({wrong}).find('\n') == std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(bursts_that_cannot_be_built) {
  const auto refusal = [](const pl::Geometry& geometry) -> std::string {
    try {
      pl::check(geometry);
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  };
  for (std::uint32_t words : {2u, 4u, 8u, 16u, 32u, 64u, 128u})
    BOOST_TEST(refusal({640, 480, words}) == "");
  BOOST_TEST(refusal({1024, 512, 256}) == "");
  BOOST_TEST(
      refusal({640, 480, 256}) ==
      "frames of 640x480 px cannot be built: pl.width x pl.height must be a multiple of 8192 "
      "(whole bursts of 256 words; pl.burst_words=128 fits)");
  BOOST_TEST(refusal({32, 31, 2}) ==
             "frames of 32x31 px cannot be built: pl.width x pl.height must be a multiple of 64 "
             "(whole bursts of 2 words)");
  for (std::uint32_t pixels : {1u, 2u, 4u}) BOOST_TEST(refusal({640, 480, 2, pixels}) == "");
  for (std::uint32_t pixels : {0u, 3u, 8u}) {
    BOOST_TEST(refusal({640, 480, 2, pixels}) ==
               "pl.pixels_per_clock is " + std::to_string(pixels) +
                   ": the logic takes 1, 2 or 4 pixels a clock, whole parts of a word");
  }
  for (const auto& [words, nearest] : {std::pair<std::uint32_t, const char*>{3, "2"},
                                       {5, "4"},
                                       {24, "16"},
                                       {100, "128"},
                                       {192, "128"},
                                       {255, "256"}}) {
    const std::string text = refusal({640, 480, words});
    BOOST_TEST(text.find("pl.burst_words is " + std::to_string(words)) == 0u, text);
    BOOST_TEST(text.find("the nearest is " + std::string(nearest)) != std::string::npos, text);
  }
}

BOOST_AUTO_TEST_SUITE_END()
