// Otsu's threshold against its definition in floating point, and both models against each other.
#include <pl/otsu_threshold/otsu_threshold.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>

#include "threshold_bench.h"

using harness::Image;
using harness::Random;
using harness::Script;
using harness::ThresholdBench;

namespace {

/// The variance between both classes if `threshold` is the greatest dark level; 0 if one is empty.
double variance_at(const pl::Histogram& histogram, unsigned threshold) {
  double n[2] = {}, sum[2] = {};
  for (unsigned level = 0; level < 256; ++level) {
    const bool bright = level > threshold;
    n[bright] += histogram[level];
    sum[bright] += static_cast<double>(level) * histogram[level];
  }
  if (n[0] == 0 || n[1] == 0) return 0;
  const double difference = sum[0] / n[0] - sum[1] / n[1];
  return n[0] * n[1] * difference * difference;
}

pl::Histogram bumps(Random& random, unsigned count) {
  pl::Histogram histogram{};
  for (; count > 0; --count) {
    const unsigned middle = random.below(256), spread = 1 + random.below(40);
    for (unsigned pixels = random.below(20'000); pixels > 0; --pixels) {
      const unsigned level = middle + random.below(spread) + random.below(spread);
      ++histogram[std::min(level, 255u)];
    }
  }
  return histogram;
}

/// Changes of the threshold, and words, with their edges.
using Log = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

class Monitor final : public vp::Clocked {
 public:
  Monitor(sc_core::sc_module_name name, vp::Clock& clk, pl::GlobalThreshold& ip)
      : Clocked(name, clk) {
    thresh_out_(ip.thresh_out);
    thresh_data_(ip.thresh_data);
    active_threshold_(ip.active_threshold);
  }
  Log words, thresholds;

 private:
  void edge() override {
    if (thresh_out_) words.emplace_back(clock().cycle(), thresh_data_);
    if (thresholds.empty() || thresholds.back().second != active_threshold_)
      thresholds.emplace_back(clock().cycle(), active_threshold_);
  }
  vp::In<bool> thresh_out_{"thresh_out", this};
  vp::In<std::uint32_t> thresh_data_{"thresh_data", this};
  vp::In<std::uint8_t> active_threshold_{"active_threshold", this};
};

struct Outcome {
  Log words, thresholds;
};

Outcome run(const std::string& model, const pl::Geometry& geometry, const Script& script) {
  ThresholdBench b(pl::OtsuThreshold::models(), model, geometry, script);
  Monitor monitor{"monitor", b.clk, *b.ip};
  b.run();
  return {monitor.words, monitor.thresholds};
}

Log check(const pl::Geometry& geometry, const Script& script) {
  const Outcome clocked = run("clocked", geometry, script), tlm = run("tlm", geometry, script);
  BOOST_TEST((tlm.words == clocked.words));
  BOOST_TEST((tlm.thresholds == clocked.thresholds));
  BOOST_TEST(!clocked.words.empty());
  return clocked.thresholds;
}

/// Levels around `dark` and `bright`, about as many of both.
Image two_levels(Random& random, const pl::Geometry& g, unsigned dark, unsigned bright) {
  Image image(g.pixels());
  for (std::uint8_t& pixel : image)
    pixel = static_cast<std::uint8_t>((random.below(2) ? dark : bright) + random.below(9));
  return image;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(otsu)

BOOST_AUTO_TEST_CASE(the_logarithm_is_that_of_the_first_eleven_bits) {
  for (const std::uint64_t value : {1ull, 2ull, 3ull, 1000ull, 1024ull, 307'200ull, 1ull << 50}) {
    const double exact = std::log2(static_cast<double>(value)) * 16384;
    BOOST_TEST(pl::coarse_log2(value) <= exact);
    BOOST_TEST(pl::coarse_log2(value) >= exact - 16384 * std::log2(1 + 1.0 / 1024) - 1);
  }
  for (std::uint64_t value = 1; value < 100'000; ++value)
    BOOST_REQUIRE(pl::coarse_log2(value) <= pl::coarse_log2(value + 1));
}

// The split is never worse than the best one by more than 0.5 %.
BOOST_AUTO_TEST_CASE(it_is_the_threshold_of_the_definition) {
  Random random(1);
  for (int round = 0; round < 500; ++round) {
    const pl::Histogram histogram = bumps(random, 1 + random.below(4));
    double best = 0;
    for (unsigned t = 0; t < 256; ++t) best = std::max(best, variance_at(histogram, t));
    const auto found = pl::find_otsu_threshold(histogram);
    BOOST_REQUIRE(found.has_value() == (best > 0));
    if (found) BOOST_TEST(variance_at(histogram, *found) >= 0.995 * best, "round " << round);
  }
}

BOOST_AUTO_TEST_CASE(a_gap_between_both_levels_is_cut_in_its_middle) {
  pl::Histogram histogram{};
  histogram[40] = 1000;
  histogram[200] = 300'000;
  BOOST_TEST(*pl::find_otsu_threshold(histogram) == (40 + 199) / 2);
}

BOOST_AUTO_TEST_CASE(no_pixels_or_one_level_have_no_threshold) {
  pl::Histogram histogram{};
  BOOST_TEST(!pl::find_otsu_threshold(histogram));
  histogram[255] = 307'200;
  BOOST_TEST(!pl::find_otsu_threshold(histogram));
}

// 2048x2048 pixels: nothing is too wide.
BOOST_AUTO_TEST_CASE(the_largest_frames_are_cut_right) {
  pl::Histogram histogram{};
  histogram[0] = 1u << 21;
  histogram[255] = 1u << 21;
  BOOST_TEST(*pl::find_otsu_threshold(histogram) == 127);
}

// The frame is taken on edges 11 to 522; 523 is the edge behind it, and the threshold follows
// edge 523 + 272: seen one edge later. 40 to 48 and 190 to 198 are cut at (48 + 189) / 2.
BOOST_AUTO_TEST_CASE(the_threshold_is_loaded_at_this_clock) {
  Random random(2);
  const pl::Geometry size{32, 16};
  Script script;
  script.frames[10] = two_levels(random, size, 40, 190);
  script.end = 1000;
  const Log expected{{1, 127}, {523 + 272 + 1, 118}};
  BOOST_TEST((check(size, script) == expected));
}

// Four pixels a clock: edges 11 to 138, and the edge behind them.
BOOST_AUTO_TEST_CASE(the_threshold_of_groups_is_loaded_at_this_clock) {
  Random random(2);
  const pl::Geometry size{32, 16, 64, 4};
  Script script;
  script.frames[10] = two_levels(random, size, 40, 190);
  script.end = 1000;
  const Log expected{{1, 127}, {139 + 272 + 1, 118}};
  BOOST_TEST((check(size, script) == expected));
}

// The second frame begins before the search has ended: its own pixels see the threshold of before.
BOOST_AUTO_TEST_CASE(a_frame_that_begins_before_is_not_changed_within) {
  Random random(3);
  const pl::Geometry size{32, 16};
  Script script;
  script.frames[10] = two_levels(random, size, 40, 190);
  script.frames[600] = two_levels(random, size, 100, 220);
  script.end = 2500;
  const std::uint64_t behind_second = 601 + size.pixels();
  const Log expected{
      {1, 127}, {behind_second + 1, 118}, {behind_second + 272 + 1, (108 + 219) / 2}};
  BOOST_TEST((check(size, script) == expected));
}

BOOST_AUTO_TEST_CASE(frames_resets_and_loads_at_any_clock_are_equal_in_both_models) {
  Random random(4);
  const std::uint32_t groups[] = {1, 2, 4};
  for (int round = 0; round < 90; ++round) {
    const pl::Geometry size{32 * (1 + random.below(2)), 16, 64, groups[round % 3]};
    Script script;
    std::uint64_t cycle = 3 + random.below(20);
    for (int frame = 0; frame < 6; ++frame) {
      script.frames[cycle] = two_levels(random, size, random.below(120), 120 + random.below(120));
      const std::uint64_t begin = cycle;
      cycle += size.clocks() + 9 + random.below(500);
      if (random.below(3) == 0) {
        const std::uint64_t at = begin + random.below(size.clocks() + 300);
        auto& reset = random.below(2) == 0 ? script.rst : script.por;
        reset[at] = true;
        reset[at + 2] = false;
        cycle = std::max(cycle, at + 20);
      }
      if (random.below(3) == 0) {
        const std::uint64_t at = begin + random.below(size.clocks() + 400);
        script.loads[at] = static_cast<int>(random.below(256));
        script.loads[at + 1 + random.below(20)] = -1;
      }
    }
    script.end = cycle + 1000;
    check(size, script);
  }
}

BOOST_AUTO_TEST_SUITE_END()
