// The local threshold against its definition, and both models against each other.
#include <pl/common/simd_target.h>
#include <pl/local_threshold/local_threshold.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include "threshold_bench.h"

using harness::Image;
using harness::Random;
using harness::Script;
using harness::ThresholdBench;

namespace {

bool dark_by_definition(const Image& image, const pl::Geometry& g, const pl::LocalRule& rule,
                        int column, int row) {
  const int radius = static_cast<int>(rule.radius), width = static_cast<int>(g.width);
  double sum = 0;
  int count = 0;
  for (int y = row - radius; y <= row + radius; ++y) {
    for (int x = column - radius; x <= column + radius; ++x) {
      if (x < 0 || y < 0 || x >= width || y >= static_cast<int>(g.height)) continue;
      sum += image[static_cast<std::size_t>(y * width + x)];
      ++count;
    }
  }
  const double pixel = image[static_cast<std::size_t>(row * width + column)];
  const double mean = sum / count;
  const double share = rule.relative == 0 ? 0 : std::floor(sum / (1 << rule.relative)) / count;
  return pixel <= rule.level || pixel + std::max<double>(rule.offset, share) <= mean;
}

/// Pixels of a binary image, and the edges behind which they stand.
struct Seen {
  std::vector<std::uint64_t> edges;
  std::vector<bool> dark;
  std::vector<std::uint32_t> level;  ///< as it stood then
  bool operator==(const Seen& other) const {
    return edges == other.edges && dark == other.dark && level == other.level;
  }
};

class Monitor final : public vp::Clocked {
 public:
  Monitor(sc_core::sc_module_name name, vp::Clock& clk, pl::GlobalThreshold& ip, bool whole)
      : Clocked(name, clk), ip_(ip), whole_(whole) {
    ena_(ip.binary_ena);
    level_(ip.active_threshold);
  }
  Seen seen;

 private:
  void edge() override {
    if (!ena_) {
      next_ = 0;
      return;
    }
    for (std::size_t lane = 0; lane <= ip_.more_binary.size(); ++lane) {
      const std::uint32_t place = next_++;
      seen.edges.push_back(clock().cycle());
      seen.dark.push_back(whole_ ? (ip_.binary_frames.data()[place / 32] >> place % 32 & 1) != 0
                                 : pin(lane));
      seen.level.push_back(level_);
    }
  }
  bool pin(std::size_t lane) const {
    return lane == 0 ? ip_.binary_out.get() : ip_.more_binary[lane - 1].get();
  }

  vp::In<bool> ena_{"ena", this};
  vp::In<std::uint8_t> level_{"level", this};
  pl::GlobalThreshold& ip_;
  const bool whole_;
  std::uint32_t next_ = 0;
};

constexpr pl::Geometry size{64, 16};

/// Darker by ten levels, whatever the light.
const std::vector<std::string> by_offset{"local_threshold.radius=3px", "local_threshold.relative=0",
                                         "local_threshold.offset=10"};

Seen run(const std::string& model, const Script& script,
         const std::vector<std::string>& settings = by_offset, std::uint32_t pixels_per_clock = 1) {
  pl::Geometry geometry = size;
  geometry.pixels_per_clock = pixels_per_clock;
  ThresholdBench b(pl::LocalThreshold::models(), model, geometry, script, settings);
  Monitor monitor{"monitor", b.clk, *b.ip, model == "tlm"};
  b.run();
  return monitor.seen;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(local_threshold)

BOOST_AUTO_TEST_CASE(both_ways_to_find_it_are_the_definition_on_every_simd_target) {
  Random random(1);
  for (int round = 0; round < 40; ++round) {
    const pl::Geometry g{32 * (1 + random.below(3)), 16 + random.below(20)};
    const pl::LocalRule rule{1 + random.below(7), 1 + random.below(40),
                             random.below(2) * (1 + random.below(7)),
                             static_cast<std::uint8_t>(random.below(2) * random.below(60))};
    const Image image = harness::noise(g.width, g.height, random.below(1000));
    std::vector<std::uint32_t> words, others;
    pl::find_dark(image.data(), g, rule, words);
    for (const std::string& target : pl::simd_targets()) {
      BOOST_REQUIRE(pl::use_simd_target(target));
      pl::find_dark(image.data(), g, rule, others);
      BOOST_TEST((others == words), target);
    }
    pl::use_simd_target("");
    pl::LocalThresholdCore core(g, rule.radius);
    core.begin(rule);
    for (std::uint32_t i = 0; i < g.pixels() + core.lag(); ++i) {
      if (i < g.pixels()) {
        core.push(image[i]);
      } else {
        core.push_nothing();
      }
      if (i < core.lag()) continue;
      const std::uint32_t place = i - core.lag();
      const bool dark = dark_by_definition(image, g, rule, static_cast<int>(place % g.width),
                                           static_cast<int>(place / g.width));
      BOOST_REQUIRE_EQUAL(core.dark(), dark);
      BOOST_REQUIRE_EQUAL((words[place / 32] >> place % 32 & 1) != 0, dark);
    }
  }
}

// Light that falls off to a fifth from left to right: what is darker than its surroundings is
// found everywhere, and nothing else is.
BOOST_AUTO_TEST_CASE(uneven_light_does_not_matter) {
  const pl::Geometry g{640, 32};
  const auto is_black = [](std::uint32_t x, std::uint32_t y) {
    return x / 8 % 2 == 1 && y / 8 % 2 == 1 && x < 624;
  };
  Image image(g.pixels());
  for (std::uint32_t i = 0; i < g.pixels(); ++i) {
    const std::uint32_t x = i % g.width, light = 240 - 190 * x / g.width;
    image[i] = static_cast<std::uint8_t>(is_black(x, i / g.width) ? light / 8 : light);
  }
  std::vector<std::uint32_t> words;
  pl::find_dark(image.data(), g, {6, 10, 0}, words);
  std::uint32_t wrong = 0;
  for (std::uint32_t i = 0; i < g.pixels(); ++i)
    wrong += ((words[i / 32] >> i % 32 & 1) != 0) != is_black(i % g.width, i / g.width);
  BOOST_TEST(wrong == 0u);
}

// Pixel 0 is taken on edge 11. Three rows, three pixels and three registers later it stands.
BOOST_AUTO_TEST_CASE(the_image_leaves_at_these_clocks) {
  Script script;
  script.frames[10] = harness::noise(size.width, size.height, 5);
  script.end = 3000;
  for (const char* model : {"clocked", "tlm"}) {
    const Seen seen = run(model, script);
    BOOST_REQUIRE_EQUAL(seen.edges.size(), size.pixels());
    BOOST_TEST(seen.edges.front() == 11 + 3 * size.width + 3 + 3 + 1);
    BOOST_TEST(seen.edges.back() == seen.edges.front() + size.pixels() - 1);
    for (std::uint32_t i = 0; i < size.pixels(); ++i) {
      const bool dark =
          dark_by_definition(script.frames[10], size, {3, 10, 0}, static_cast<int>(i % size.width),
                             static_cast<int>(i / size.width));
      BOOST_REQUIRE_EQUAL(seen.dark[i], dark);
    }
  }
}

// As it is by default: the share of the mean takes a register more.
BOOST_AUTO_TEST_CASE(a_share_of_the_mean_leaves_a_clock_later) {
  Script script;
  script.frames[10] = harness::noise(size.width, size.height, 5);
  script.end = 3000;
  for (const char* model : {"clocked", "tlm"}) {
    const Seen seen = run(model, script, {"local_threshold.radius=3px"});
    BOOST_REQUIRE_EQUAL(seen.edges.size(), size.pixels());
    BOOST_TEST(seen.edges.front() == 11 + 3 * size.width + 3 + 4 + 1);
    for (std::uint32_t i = 0; i < size.pixels(); ++i) {
      const bool dark =
          dark_by_definition(script.frames[10], size, {3, 2, 3, 0},
                             static_cast<int>(i % size.width), static_cast<int>(i / size.width));
      BOOST_REQUIRE_EQUAL(seen.dark[i], dark);
    }
  }
}

// A marker of reflectance 0.1 on 0.8 in a fifteenth of the light: 1 grey level on 14.
BOOST_AUTO_TEST_CASE(a_share_of_the_mean_sees_in_dim_light) {
  const pl::LocalRule fixed{5, 10, 0, 0}, relative{5, 2, 3, 0};
  const std::uint32_t count = 121, sum = 61 * 14 + 60 * 1;
  BOOST_TEST(!fixed.dark(1, sum, count));
  BOOST_TEST(relative.dark(1, sum, count));
  BOOST_TEST(!relative.dark(14, sum, count));
  // In bright light noise of 10 levels is no longer dark.
  BOOST_TEST(fixed.dark(190, 200 * count, count));
  BOOST_TEST(!relative.dark(190, 200 * count, count));
  BOOST_TEST(relative.dark(175, 200 * count, count));
}

// Four pixels a clock: those that lag are made whole clocks.
BOOST_AUTO_TEST_CASE(the_image_of_groups_leaves_at_these_clocks) {
  Script script;
  script.frames[10] = harness::noise(size.width, size.height, 5);
  script.end = 3000;
  for (const char* model : {"clocked", "tlm"}) {
    const Seen seen = run(model, script, by_offset, 4);
    BOOST_REQUIRE_EQUAL(seen.edges.size(), size.pixels());
    BOOST_TEST(seen.edges.front() == 11 + 3 * size.width / 4 + 1 + 3 + 1);
    BOOST_TEST(seen.edges.back() == seen.edges.front() + size.pixels() / 4 - 1);
    for (std::uint32_t i = 0; i < size.pixels(); ++i) {
      const bool dark =
          dark_by_definition(script.frames[10], size, {3, 10, 0}, static_cast<int>(i % size.width),
                             static_cast<int>(i / size.width));
      BOOST_REQUIRE_EQUAL(seen.dark[i], dark);
    }
  }
}

BOOST_AUTO_TEST_CASE(frames_resets_and_loads_at_any_clock_are_equal_in_both_models) {
  Random random(2);
  std::size_t pixels = 0;
  for (int round = 0; round < 90; ++round) {
    Script script;
    const std::uint32_t radius = 1 + random.below(6), group = 1u << round % 3;
    const std::uint32_t relative = random.below(2) * (1 + random.below(7));
    const std::uint64_t lag =
        (std::uint64_t{radius} * size.width + radius + group - 1) / group + (relative == 0 ? 3 : 4);
    const std::uint32_t clocks = size.pixels() / group;
    std::uint64_t cycle = 3 + random.below(20);
    for (int frame = 0; frame < 6; ++frame) {
      script.frames[cycle] = harness::noise(size.width, size.height, random.below(1000));
      const std::uint64_t begin = cycle;
      cycle += clocks + lag + random.below(3) * random.below(300);
      if (random.below(3) == 0) {
        const std::uint64_t at = begin + random.below(clocks + 500);
        auto& reset = random.below(2) == 0 ? script.rst : script.por;
        reset[at] = true;
        reset[at + 2] = false;
        cycle = std::max(cycle, at + 20);
      }
      if (random.below(3) == 0) {
        const std::uint64_t at = begin + random.below(clocks + 400);
        script.loads[at] = static_cast<int>(random.below(120));
        script.loads[at + 1 + random.below(20)] = -1;
      }
    }
    script.end = cycle + 1000;
    const std::vector<std::string> settings{
        "local_threshold.radius=" + std::to_string(radius) + "px",
        "local_threshold.relative=" + std::to_string(relative)};
    const Seen clocked = run("clocked", script, settings, group),
               tlm = run("tlm", script, settings, group);
    BOOST_TEST((clocked == tlm), "round " << round);
    pixels += clocked.dark.size();
  }
  BOOST_TEST(pixels > 200 * size.pixels());
}

BOOST_AUTO_TEST_CASE(a_frame_too_early_is_refused) {
  const std::uint64_t lag = 3 * size.width + 3 + 3;
  Script script;
  script.frames[10] = harness::noise(size.width, size.height, 5);
  script.frames[10 + size.pixels() + lag - 1] = harness::noise(size.width, size.height, 6);
  script.end = 4000;
  for (const char* model : {"clocked", "tlm"}) {
    BOOST_CHECK_EXCEPTION(run(model, script), sc_core::sc_report, [](const sc_core::sc_report& e) {
      const std::string what = e.what();
      return what.find("local_threshold") != std::string::npos &&
             what.find(
                 "a frame begins before the one before has left: a frame takes 1222 clocks") !=
                 std::string::npos;
    });
  }
}

BOOST_AUTO_TEST_CASE(a_window_larger_than_the_frame_is_refused) {
  const Script none;
  for (const char* model : {"clocked", "tlm"}) {
    BOOST_CHECK_EXCEPTION(
        run(model, none, {"local_threshold.radius=8px"}), vp::InputError,
        [](const vp::InputError& e) {
          return std::string(e.what()) ==
                 "local_threshold.radius: a window of 17 px does not fit into frames of 64x16: "
                 "7 px at most";
        });
  }
  // What comes beside the last pixel of a row must not reach into the window.
  pl::Geometry narrow{32, 64, 64, 4};
  BOOST_CHECK_THROW(ThresholdBench(pl::LocalThreshold::models(), "clocked", narrow, none,
                                   {"local_threshold.radius=14px"}),
                    vp::InputError);
  narrow.pixels_per_clock = 2;
  ThresholdBench(pl::LocalThreshold::models(), "clocked", narrow, none,
                 {"local_threshold.radius=14px"});
}

BOOST_AUTO_TEST_SUITE_END()
