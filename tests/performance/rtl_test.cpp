// The RTL that the models' speed is compared with computes what they compute.
#include <boost/test/unit_test.hpp>

// Before SystemC, of which Verilator would take the time.
#include "rtl_pipeline.h"

#include "golden_sequence.h"
#include "pipeline.h"

namespace {

struct Words {
  std::vector<harness::Word> words;
  int threshold;
};

/// One frame after the other, without a system reset between.
class Models {
 public:
  Words run(const harness::Image& image) {
    pipeline_.load(image);
    auto words = pipeline_.run_frame();
    return {std::move(words), pipeline_.pl.global_threshold.active_threshold};
  }

 private:
  harness::Pipeline pipeline_;
};

template <class Rtl>
Words run(Rtl& rtl, const harness::Image& image) {
  rtl.load(image);
  rtl.run_frame();
  return {rtl.words(), rtl.threshold()};
}

void check_equal(const Words& a, const Words& b) {
  BOOST_TEST(harness::first_difference(a.words, b.words) == "");
  BOOST_TEST(a.threshold == b.threshold);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(rtl)

BOOST_AUTO_TEST_CASE(both_structures_give_the_words_of_the_models_clock_for_clock) {
  Models models;
  bench::ThesisRtl thesis;
  bench::LeanRtl lean;
  for (const harness::GoldenFrame& frame : harness::golden_sequence()) {
    const Words expected = models.run(frame.image);
    BOOST_TEST_CONTEXT(frame.name) {
      BOOST_TEST(harness::count(expected.words, 'T') == 9600u);
      check_equal(run(thesis, frame.image), expected);
      check_equal(run(lean, frame.image), expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  harness::Image image = harness::golden_sequence().front().image;
  bench::ThesisRtl rtl;
  const Words right = run(rtl, image);
  std::uint8_t& pixel = image[200 * 640 + 300];
  pixel = pixel > 127 ? 0 : 255;
  bench::ThesisRtl other;
  const Words wrong = run(other, image);
  BOOST_TEST(harness::first_difference(right.words, wrong.words) != "");
}

BOOST_AUTO_TEST_SUITE_END()
