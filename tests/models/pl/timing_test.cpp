// The clocks at which each module's outputs change. Clock n is the n-th pixel-clock edge; the edge
// that first samples ena is clock 1.
#include <boost/test/unit_test.hpp>

#include "change_log.h"
#include "pipeline.h"

namespace {

using harness::Change;
using harness::Image;
using Changes = std::vector<Change>;

struct Size {
  int width, height;
};
std::ostream& operator<<(std::ostream& out, Size size) {
  return out << size.width << 'x' << size.height;
}
const Size sizes[] = {{32, 32}, {64, 32}, {96, 64}, {640, 480}, {1024, 32}};

/// A frame that runs to its end; every change of the outputs is kept.
struct Frame {
  explicit Frame(const Image& image, Size size = {640, 480})
      : pipeline({}, harness::frame_size(size.width, size.height)),
        pixels(static_cast<std::uint64_t>(size.width * size.height)) {
    pipeline.load(image);
    pipeline.reset();
    pipeline.raise_ena();
    pipeline.run_to_clock(pixels + 300);
    words = pipeline.words();
  }
  std::uint64_t at(std::uint64_t clock) const { return pipeline.monitor.time_of(clock); }

  harness::Pipeline pipeline;
  std::uint64_t pixels;
  harness::ChangeLog frame_ena{pipeline.pl.sensor_input.frame_ena, pipeline.scheduler};
  harness::ChangeLog threshold{pipeline.pl.global_threshold.active_threshold, pipeline.scheduler};
  harness::ChangeLog busy{pipeline.pl.frame_status.busy, pipeline.scheduler};
  harness::ChangeLog feature{pipeline.pl.feature_packaging.feature, pipeline.scheduler};
  harness::ChangeLog corner_out{pipeline.pl.corner_detection.corner_out, pipeline.scheduler};
  harness::ChangeLog blob_out{pipeline.pl.blob_detection.blob_out, pipeline.scheduler};
  harness::ChangeLog thresh_out{pipeline.pl.global_threshold.thresh_out, pipeline.scheduler};
  harness::ChangeLog tvalid{pipeline.binary_link.tvalid, pipeline.scheduler};
  std::vector<harness::Word> words;
};

Image bright(Size size) {
  return Image(static_cast<std::size_t>(size.width * size.height), 200);
}

std::vector<harness::Word> of_kind(const std::vector<harness::Word>& words, char kind) {
  std::vector<harness::Word> found;
  for (const harness::Word& word : words) {
    if (word.kind == kind) found.push_back(word);
  }
  return found;
}

std::uint64_t x_of(std::uint32_t packet) {
  return packet & 0x3FF;
}
std::uint64_t y_of(std::uint32_t packet) {
  return packet >> 10 & 0x1FF;
}

constexpr std::uint64_t system_period_ps = 10'000, pixel_period_ps = 20'000;
constexpr std::uint64_t end_word = 0xFFFF'FFFF;

}  // namespace

BOOST_AUTO_TEST_SUITE(timing)

BOOST_AUTO_TEST_CASE(frame_ena_is_high_from_clock_2_to_the_clock_after_the_last_pixel) {
  for (const Size size : sizes) {
    BOOST_TEST_CONTEXT(size) {
      const Frame frame(bright(size), size);
      BOOST_TEST(
          frame.frame_ena.changes == (Changes{{frame.at(2), 1}, {frame.at(frame.pixels + 2), 0}}),
          boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(clocks_are_these_simulation_times) {
  // ena rises just after 400 ns, so clock 1 falls at 420 ns.
  const Frame frame(bright({640, 480}));
  BOOST_TEST(frame.frame_ena.changes == (Changes{{440'000, 1}, {6'144'440'000, 0}}),
             boost::test_tools::per_element());
  BOOST_TEST(frame.threshold.changes == (Changes{{6'144'460'000, 100}}),
             boost::test_tools::per_element());
  BOOST_TEST(frame.busy.changes.back() == (Change{6'144'740'000, 0}));
  // Clock 307 217 and half a pixel clock; 6144.33 us after the edge that sampled ena.
  BOOST_TEST(frame.feature.changes == (Changes{{6'144'750'000, end_word}}),
             boost::test_tools::per_element());
  BOOST_TEST(6'144'750'000 == 420'000 + 307'216 * pixel_period_ps + pixel_period_ps / 2);
}

// The transaction level has the frame as a whole.
BOOST_AUTO_TEST_CASE(pixel_i_leaves_the_sensor_input_at_clock_2_plus_i,
                     *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                       return boost::test_tools::assertion_result(harness::fidelity_under_test() ==
                                                                  pl::Fidelity::clocked);
                     })) {
  const Image image = harness::noise(64, 32, 5);
  harness::Pipeline pipeline({}, harness::frame_size(64, 32));
  pipeline.load(image);
  pipeline.reset();
  pipeline.raise_ena();
  for (std::uint64_t i = 0; i < image.size(); ++i) {
    pipeline.run_to_clock(2 + i);
    BOOST_REQUIRE_EQUAL(pipeline.pl.sensor_input.pixel.get(), image[i]);
    BOOST_REQUIRE_EQUAL(pipeline.pl.sensor_input.pixel_x.get(), i % 64);
    BOOST_REQUIRE_EQUAL(pipeline.pl.sensor_input.pixel_y.get(), i / 64);
  }
}

BOOST_AUTO_TEST_CASE(the_next_threshold_is_loaded_three_clocks_after_the_last_pixel) {
  for (const Size size : sizes) {
    BOOST_TEST_CONTEXT(size) {
      Image image = bright(size);  // peaks 0 (none) and 200
      harness::draw(image, size.width, 0, 0, 9, 0, 60);
      const Frame frame(image, size);
      BOOST_TEST(frame.threshold.changes == (Changes{{frame.at(frame.pixels + 3), 130}}),
                 boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(busy_falls_when_the_pipeline_and_the_labels_have_drained) {
  const Size size{1024, 32};
  for (const int labels : {0, 1, 5, 11, 12, 13, 14, 40, 127}) {
    BOOST_TEST_CONTEXT(labels << " labels active at the end of the frame") {
      const Frame frame(harness::blobs_at_the_end(1024, 32, labels, 0), size);
      BOOST_TEST(frame.pipeline.pl.blob_detection.label_overflow.get() == 0u);
      const std::uint64_t fall =
          std::max(frame.pixels + 17, frame.pixels + 5 + static_cast<std::uint64_t>(labels));
      BOOST_TEST(frame.busy.changes.back() == (Change{frame.at(fall), 0}));
      BOOST_TEST(frame.busy.changes.size() == 2u);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_end_word_comes_half_a_pixel_clock_after_busy_falls) {
  for (const int labels : {0, 12, 13, 40}) {
    BOOST_TEST_CONTEXT(labels << " labels active, none reported") {
      harness::Pipeline pipeline({}, harness::frame_size(1024, 32));
      pipeline.load(harness::blobs_at_the_end(1024, 32, labels, 0));
      harness::ChangeLog busy(pipeline.pl.frame_status.busy, pipeline.scheduler);
      harness::ChangeLog feature(pipeline.pl.feature_packaging.feature, pipeline.scheduler);
      pipeline.run_frame();
      BOOST_TEST(feature.changes.back().value == end_word);
      BOOST_TEST(feature.changes.back().ps == busy.changes.back().ps + system_period_ps);
    }
  }
}

// The last label leaves in the clock in which busy falls: its blob is still on its way.
BOOST_AUTO_TEST_CASE(the_end_word_never_overtakes_the_last_blob) {
  for (const int labels : {12, 13, 20}) {
    BOOST_TEST_CONTEXT(labels << " labels active, the last one reported") {
      harness::Pipeline pipeline({}, harness::frame_size(1024, 32));
      pipeline.load(harness::blobs_at_the_end(1024, 32, labels, 1));
      harness::ChangeLog busy(pipeline.pl.frame_status.busy, pipeline.scheduler);
      harness::ChangeLog blob_out(pipeline.pl.blob_detection.blob_out, pipeline.scheduler);
      pipeline.run_frame();
      BOOST_TEST(busy.changes.back().ps == blob_out.changes.front().ps);
      const std::vector<std::uint32_t>& words = pipeline.driver.features;
      BOOST_REQUIRE(words.size() >= 3u);
      BOOST_TEST(words[words.size() - 3] >> 30 == 1u);
      BOOST_TEST(words[words.size() - 2] >> 30 == 0u);
      BOOST_TEST(words[words.size() - 1] == end_word);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_corner_leaves_at_its_clock) {
  for (const Size size : {Size{64, 64}, Size{640, 480}}) {
    BOOST_TEST_CONTEXT(size) {
      const Frame frame(harness::noise(size.width, size.height, 7), size);
      const std::vector<harness::Word> corners = of_kind(frame.words, 'C');
      BOOST_TEST(corners.size() > 100u);
      for (const harness::Word& word : corners) {
        const std::uint64_t x = x_of(word.first), y = y_of(word.first);
        BOOST_REQUIRE_EQUAL(word.clock,
                            7 + (y + 4) * static_cast<std::uint64_t>(size.width) + (x + 4));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_binary_word_leaves_at_the_clock_of_its_last_pixel) {
  for (const Size size : sizes) {
    BOOST_TEST_CONTEXT(size) {
      const Frame frame(harness::noise(size.width, size.height, 8), size);
      BOOST_TEST(harness::count(frame.words, 'T') == frame.pixels / 32);
      std::uint64_t last = 31;
      for (const harness::Word& word : of_kind(frame.words, 'T')) {
        BOOST_REQUIRE_EQUAL(word.clock, 3 + last);
        last += 32;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_blob_inside_the_frame_leaves_5_clocks_after_the_pixel_that_retired_it) {
  struct Case {
    int ex, ey;
    std::uint64_t retiring_x, retiring_y;
  };
  // Two right of its end in the line below; at the right border, the first pixel of the next line.
  const Case cases[] = {{30, 30, 33, 31}, {60, 40, 63, 41}, {61, 40, 0, 42}, {63, 40, 0, 42}};
  for (const Case& c : cases) {
    BOOST_TEST_CONTEXT("box ends at " << c.ex << ", " << c.ey) {
      const Frame frame(harness::one_rectangle(64, 64, c.ex - 26, c.ey - 26, c.ex, c.ey), {64, 64});
      const std::vector<harness::Word> blobs = of_kind(frame.words, 'B');
      BOOST_REQUIRE(blobs.size() == 1u);
      BOOST_TEST(blobs[0].clock == 5 + c.retiring_y * 64 + c.retiring_x);
      BOOST_TEST(x_of(blobs[0].second) == static_cast<std::uint64_t>(c.ex));
      BOOST_TEST(y_of(blobs[0].second) == static_cast<std::uint64_t>(c.ey));
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_flushed_at_the_end_leave_one_a_clock_filtered_ones_included) {
  // Labels 1 to 6 are too narrow: k = 0 to 5; the seven others follow.
  const Frame frame(harness::blobs_at_the_end(1024, 32, 13, 7), {1024, 32});
  std::uint64_t k = 6;
  for (const harness::Word& word : of_kind(frame.words, 'B')) {
    BOOST_TEST(word.clock == frame.pixels + 6 + k);
    BOOST_TEST((word.first >> 19 & 0x7FF) == k - 6);
    ++k;
  }
  BOOST_TEST(k == 13u);
  // The seven share one pulse of blob_out.
  BOOST_TEST(frame.blob_out.changes ==
                 (Changes{{frame.at(frame.pixels + 12), 1}, {frame.at(frame.pixels + 19), 0}}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(words_reach_the_system_clock_registers_4_system_clocks_after_they_left) {
  const Frame corner(harness::one_rectangle(64, 32, 20, 10, 21, 11), {64, 32});
  BOOST_REQUIRE(!corner.corner_out.changes.empty());
  BOOST_TEST(corner.feature.changes.front().ps ==
             corner.corner_out.changes.front().ps + 4 * system_period_ps);
  BOOST_TEST(corner.feature.changes.front().value == of_kind(corner.words, 'C')[0].first);

  // From border to border: no corner comes before the blob.
  const Frame blob(harness::one_rectangle(64, 64, 0, 0, 63, 30), {64, 64});
  BOOST_TEST(of_kind(blob.words, 'C').empty());
  BOOST_REQUIRE(!blob.blob_out.changes.empty());
  BOOST_TEST(blob.feature.changes.front() ==
             (Change{blob.blob_out.changes.front().ps + 4 * system_period_ps, 0x4000'0000}));

  const Changes& left = corner.thresh_out.changes;
  const Changes& valid = corner.tvalid.changes;
  BOOST_TEST(left.size() == 2u * 64u);
  BOOST_REQUIRE(valid.size() == left.size());
  for (std::size_t i = 0; i < left.size(); i += 2) {
    BOOST_REQUIRE_EQUAL(valid[i].ps, left[i].ps + 4 * system_period_ps);
    BOOST_REQUIRE_EQUAL(valid[i].value, 1u);
  }
}

BOOST_AUTO_TEST_CASE(a_change_of_ready_shows_the_next_word_2_system_clocks_later) {
  Frame frame(harness::noise(64, 32, 9), {64, 32});
  const std::vector<harness::Word> corners = of_kind(frame.words, 'C');
  BOOST_REQUIRE(corners.size() > 10u);
  BOOST_TEST(frame.feature.changes.size() == 1u);  // the first word, by itself
  for (std::size_t i = 1; i < 10; ++i) {
    const std::uint64_t edge = frame.pipeline.fclk_clk0.edge_at_or_after(kit::now_ps());
    frame.pipeline.run_to(edge);
    frame.pipeline.driver.toggle_ready();  // as a register of the system clock changes
    frame.pipeline.run_for(10 * system_period_ps);
    BOOST_TEST(frame.feature.changes.back() ==
               (Change{edge + 2 * system_period_ps, corners[i].first}));
    BOOST_TEST(frame.feature.changes.size() == i + 1);
  }
}

BOOST_AUTO_TEST_CASE(without_a_change_of_ready_no_further_word_comes) {
  Frame frame(harness::noise(64, 32, 9), {64, 32});
  frame.pipeline.run_for(1'000'000'000);
  BOOST_TEST(frame.feature.changes.size() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
