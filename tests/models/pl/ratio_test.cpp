// Any ratio of the system clock to the pixel clock, and clocks that change while a frame runs.
#include <boost/test/unit_test.hpp>

#include "change_log.h"
#include "pipeline.h"

namespace {

using harness::Change;
using harness::Clocks;
using harness::Image;
using harness::Pipeline;
using harness::Word;
using Changes = std::vector<Change>;

constexpr std::uint64_t MHz = 1'000'000;
constexpr int width = 128, height = 64;

std::vector<Word> run(Pipeline& pipeline, const Image& image) {
  pipeline.load(image);
  return pipeline.run_frame();
}

std::vector<Word> words_at_100_and_50(const Image& image) {
  Pipeline pipeline({}, harness::frame_size(width, height));
  return run(pipeline, image);
}

/// What happened to the words that left the detectors in the last frame.
struct Balance {
  explicit Balance(Pipeline& pipeline, const std::vector<Word>& words, std::size_t beats_before)
      : left(words.size()),
        lost_in_crossing(pipeline.pl.clock_crossing.crossing_overflow),
        dropped_features(pipeline.pl.feature_packaging.feature_overflow),
        dropped_words(pipeline.pl.axi_threshold_bridge.bridge_overflow),
        beats(pipeline.sink.beats.size() - beats_before) {
    for (const std::uint32_t word : pipeline.driver.features) {
      if (word >> 30 != 0 && word != 0xFFFF'FFFF) ++features;  // corners and blob starts
    }
  }
  std::size_t left, features = 0, lost_in_crossing, dropped_features, dropped_words, beats;
  std::size_t accounted_for() const {
    return features + beats + lost_in_crossing + dropped_features + dropped_words;
  }
};

struct Ratio {
  const char* name;
  Clocks clocks;
  bool loses;  ///< the system clock is too slow for words that leave in successive pixel clocks
};

const Ratio ratios[] = {
    {"27 to 55 MHz", {27 * MHz, 55 * MHz}, true},
    {"55 to 27 MHz", {55 * MHz, 27 * MHz}, false},
    {"100 to 50 MHz", {100 * MHz, 50 * MHz}, false},
    {"50 to 100 MHz", {50 * MHz, 100 * MHz}, true},
    {"100 to 100 MHz", {100 * MHz, 100 * MHz}, false},
    {"148.5 to 74.25 MHz", {148'500'000, 74'250'000}, false},
    {"74.25 to 148.5 MHz", {74'250'000, 148'500'000}, true},
    {"10 to 100 MHz", {10 * MHz, 100 * MHz}, true},
    {"333.333333 to 1 MHz", {333'333'333, 1 * MHz}, false},
};

}  // namespace

BOOST_AUTO_TEST_SUITE(ratio)

BOOST_AUTO_TEST_CASE(the_same_words_leave_at_the_same_pixel_clocks) {
  const Image frames[] = {harness::noise(width, height, 11),
                          harness::blobs_at_the_end(width, height, 14, 2),
                          harness::rectangles(width, height, 30, 12)};
  for (const Image& image : frames) {
    const std::vector<Word> expected = words_at_100_and_50(image);
    for (const Ratio& ratio : ratios) {
      BOOST_TEST_CONTEXT(ratio.name) {
        Pipeline pipeline(ratio.clocks, harness::frame_size(width, height));
        BOOST_TEST(harness::first_difference(run(pipeline, image), expected) == "");
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_was_delivered_and_what_was_lost_is_what_left) {
  for (const Ratio& ratio : ratios) {
    BOOST_TEST_CONTEXT(ratio.name) {
      Pipeline pipeline(ratio.clocks, harness::frame_size(width, height));
      std::size_t losses = 0;
      for (const Image& image : {harness::noise(width, height, 13), harness::stripes(width, height),
                                 harness::blobs_at_the_end(width, height, 4, 4)}) {
        const std::size_t before = pipeline.sink.beats.size();
        const std::vector<Word> words = run(pipeline, image);
        const Balance balance(pipeline, words, before);
        BOOST_TEST(balance.left > 200u);
        BOOST_TEST(balance.accounted_for() == balance.left);
        losses += balance.lost_in_crossing;
      }
      BOOST_TEST((losses > 0) == ratio.loses);
    }
  }
}

// Blobs leave in successive pixel clocks; the newest is the one that is seen.
BOOST_AUTO_TEST_CASE(a_slow_system_clock_sees_the_newest_word) {
  Pipeline pipeline({10 * MHz, 100 * MHz}, harness::frame_size(width, height));
  const std::vector<Word> words = run(pipeline, harness::blobs_at_the_end(width, height, 4, 4));
  BOOST_TEST(harness::count(words, 'B') == 4u);
  std::uint32_t last_blob = 0;
  for (const Word& word : words) {
    if (word.kind == 'B') last_blob = word.first;
  }
  const std::vector<std::uint32_t>& seen = pipeline.driver.features;
  BOOST_TEST(std::count(seen.begin(), seen.end(), last_blob) == 1);
  BOOST_TEST(pipeline.pl.clock_crossing.crossing_overflow.get() >= 3u);
}

BOOST_AUTO_TEST_CASE(rst_clears_the_count_of_lost_crossings) {
  Pipeline pipeline({10 * MHz, 100 * MHz}, harness::frame_size(width, height));
  run(pipeline, harness::noise(width, height, 13));
  BOOST_TEST(pipeline.pl.clock_crossing.crossing_overflow.get() > 0u);
  pipeline.reset();
  BOOST_TEST(pipeline.pl.clock_crossing.crossing_overflow.get() == 0u);
}

// Equal clocks: each word is sampled on the very edge on which the next one may replace it.
BOOST_AUTO_TEST_CASE(coincident_edges_see_each_word_once) {
  Pipeline pipeline({100 * MHz, 100 * MHz}, harness::frame_size(width, height));
  run(pipeline, harness::blobs_at_the_end(width, height, 4, 4));
  std::vector<std::uint32_t> starts;
  for (const std::uint32_t word : pipeline.driver.features) {
    if (word >> 30 == 1) starts.push_back(word >> 19 & 0x7FF);
  }
  BOOST_TEST(starts == (std::vector<std::uint32_t>{0, 1, 2, 3}), boost::test_tools::per_element());
  BOOST_TEST(pipeline.pl.clock_crossing.crossing_overflow.get() == 0u);
}

// One pixel clock to the toggle, the system edge after it, one more to the feature register.
BOOST_AUTO_TEST_CASE(a_crossing_takes_one_pixel_clock_and_two_system_edges_at_any_ratio) {
  for (const Ratio& ratio : ratios) {
    BOOST_TEST_CONTEXT(ratio.name) {
      Pipeline pipeline(ratio.clocks, harness::frame_size(64, 32));
      harness::ChangeLog left(pipeline.pl.corner_detection.corner_out, pipeline.scheduler);
      harness::ChangeLog feature(pipeline.pl.feature_packaging.feature, pipeline.scheduler);
      run(pipeline, harness::one_rectangle(64, 32, 20, 10, 21, 11));
      BOOST_REQUIRE(!left.changes.empty());
      BOOST_REQUIRE(!feature.changes.empty());
      const vp::Clock &pixel = pipeline.fclk_clk1, &system = pipeline.fclk_clk0;
      const std::uint64_t toggle = pixel.edge_at_or_after(left.changes[0].ps + 1);
      const std::uint64_t sampled = system.edge_at_or_after(toggle + 1);
      BOOST_TEST(feature.changes[0].ps == system.edge_at_or_after(sampled + 1));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_crossing_takes_these_times) {
  struct Case {
    Clocks clocks;
    std::uint64_t delay_ps;  ///< from corner_out to the feature register
  };
  const Case cases[] = {
      {{100 * MHz, 50 * MHz}, 40'000},
      {{100 * MHz, 100 * MHz}, 30'000},
      {{200 * MHz, 50 * MHz}, 30'000},
  };
  for (const Case& c : cases) {
    BOOST_TEST_CONTEXT(c.clocks.system_hz << " to " << c.clocks.pixel_hz) {
      Pipeline pipeline(c.clocks, harness::frame_size(64, 32));
      harness::ChangeLog left(pipeline.pl.corner_detection.corner_out, pipeline.scheduler);
      harness::ChangeLog feature(pipeline.pl.feature_packaging.feature, pipeline.scheduler);
      run(pipeline, harness::one_rectangle(64, 32, 20, 10, 21, 11));
      BOOST_REQUIRE(!left.changes.empty());
      BOOST_TEST(feature.changes.at(0).ps - left.changes[0].ps == c.delay_ps);
    }
  }
}

struct Running : Pipeline {
  Running()
      : Pipeline({}, harness::frame_size(width, height)), image(harness::noise(width, height, 14)) {
    load(image);
    reset();
    raise_ena();
  }
  Image image;
  harness::ChangeLog frame_ena{pl.sensor_input.frame_ena, scheduler};
  static constexpr std::uint64_t pixels = width * height;
};

BOOST_AUTO_TEST_CASE(a_new_pixel_clock_within_a_frame_moves_times_but_not_clocks) {
  const std::vector<Word> expected = words_at_100_and_50(harness::noise(width, height, 14));
  for (const std::uint64_t hertz : {25 * MHz, 55 * MHz, 100 * MHz}) {
    BOOST_TEST_CONTEXT(hertz << " Hz") {
      Running p;
      p.run_to_clock(1000);
      const std::uint64_t changed = kit::now_ps();
      p.fclk_clk1.set_frequency(hertz);
      p.run_to_clock(p.clocks_of_a_frame());
      BOOST_TEST(harness::first_difference(p.words(), expected) == "");
      // Edge n after the change falls n new periods after it, rounded.
      const std::uint64_t n = p.pixels + 2 - 1000;
      const std::uint64_t fall = changed + (n * 1'000'000'000'000 + hertz / 2) / hertz;
      BOOST_TEST(p.frame_ena.changes == (Changes{{440'000, 1}, {fall, 0}}),
                 boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_pixel_clock_that_stands_still_for_a_while_changes_no_word) {
  const std::vector<Word> expected = words_at_100_and_50(harness::noise(width, height, 14));
  Running p;
  p.run_to_clock(2000);
  p.fclk_clk1.set_frequency(0);
  p.run_for(50'000'000);
  BOOST_TEST(p.pl.sensor_input.frame_ena.get());
  p.fclk_clk1.set_frequency(50 * MHz);
  p.run_to_clock(p.clocks_of_a_frame());
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
}

BOOST_AUTO_TEST_CASE(a_new_system_clock_within_a_frame_changes_no_word) {
  const std::vector<Word> expected = words_at_100_and_50(harness::noise(width, height, 14));
  Running p;
  for (const std::uint64_t hertz : {33 * MHz, 71 * MHz, 200 * MHz}) {
    p.run_for(30'000'000);
    p.fclk_clk0.set_frequency(hertz);
  }
  p.run_to_clock(p.clocks_of_a_frame());
  BOOST_TEST(harness::first_difference(p.words(), expected) == "");
  BOOST_TEST(p.sink.beats.size() + p.pl.clock_crossing.crossing_overflow.get() >= p.pixels / 32);
}

/// The crossing states which side samples first at coincident edges.
BOOST_AUTO_TEST_CASE(the_system_clock_runs_first_though_it_was_made_later) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock pixel{"pixel", scheduler, 50 * MHz}, system{"system", scheduler, 100 * MHz};
  pl::ClockCrossingClocked crossing{"crossing", {pixel, {}}};
  crossing.cross_to(system);
  vp::Signal<bool> low{"low"};
  vp::Signal<std::uint32_t> word{"word"};
  for (auto* in : {&crossing.rst, &crossing.corner_out, &crossing.blob_out, &crossing.thresh_out}) {
    in->bind(low);
  }
  for (auto* in :
       {&crossing.corner_data, &crossing.blob_start, &crossing.blob_end, &crossing.thresh_data}) {
    in->bind(word);
  }
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
  BOOST_TEST((scheduler.clocks() == std::vector<vp::Clock*>{&system, &pixel}));
}

BOOST_AUTO_TEST_SUITE_END()
