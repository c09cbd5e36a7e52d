// The whole-frame functions against the reference RTL, word for word and clock for clock.
#include <pl/blob_detection/core.h>
#include <pl/corner_detection/core.h>
#include <pl/global_threshold/core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "golden.h"
#include "golden_sequence.h"
#include "reference.h"

namespace {

const std::string folder = MARKERVP_TEST_DATA "/golden/";
const pl::Geometry size{640, 480};

/// One run without a system reset: each frame's threshold comes from the frame before.
struct Frames {
  pl::CornerFrame corner{size, 30};
  pl::ThresholdFrame threshold{size};
  pl::BlobFrame blob{size, 128, 24};

  harness::Golden run(const harness::GoldenFrame& frame) {
    std::vector<pl::StampedWord> corners;
    corner.detect(frame.image.data(), corners);
    threshold.begin(frame.image.data());
    threshold.advance(size.pixels());
    std::vector<pl::StampedBlob> blobs;
    blob.reset();
    blob.begin();
    blob.advance(threshold.words().data(), size.pixels(), blobs);
    blob.finish(blobs);
    return {frame.name, sorted(corner_words(corners), blob_words(blobs)), threshold.end()};
  }

  std::vector<harness::Word> sorted(std::vector<harness::Word> words,
                                    const std::vector<harness::Word>& blobs) const {
    words.insert(words.end(), blobs.begin(), blobs.end());
    for (std::uint32_t w = 0; w < size.pixels() / 32; ++w) {
      words.push_back({'T', harness::detectors_begin + 32 * w + 31, threshold.words()[w], 0});
    }
    std::sort(words.begin(), words.end());
    return words;
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(golden_frame)

BOOST_AUTO_TEST_CASE(the_sequence_gives_the_words_of_the_reference) {
  Frames frames;
  std::vector<harness::Fingerprint> prints;
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    const harness::Golden result = frames.run(frame);
    BOOST_TEST_CONTEXT(frame.name) {
      if (frame.complete) {
        const auto golden = harness::read_golden(folder + frame.name + ".words");
        BOOST_REQUIRE(golden.size() == 1u);
        BOOST_TEST(harness::first_difference(result.words, golden[0].words) == "");
        BOOST_TEST(result.threshold == golden[0].threshold);
      } else {
        prints.push_back(harness::fingerprint(result));
      }
    }
  }
  BOOST_TEST(prints == harness::read_fingerprints(folder + "fingerprints.txt"),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
