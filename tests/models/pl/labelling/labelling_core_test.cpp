// LabellingCore against a flood fill: one record for each component, whatever its shape.
#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_labelling/core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>

#include "core_bench.h"

using harness::Random;
using namespace labelling;

namespace {

constexpr std::uint32_t plenty = 512;

class Bench final : public CoreBench {
 public:
  explicit Bench(const pl::Geometry& g, std::uint32_t labels = plenty, std::uint32_t side = 0)
      : CoreBench(g, std::make_unique<pl::LabellingCore>(g, labels, side)) {}

 private:
  /// A run that found no label was looked at in the clock that takes pixel `now`: four pixels
  /// behind its last one, three at the end of a row.
  void note_losses(std::uint32_t now) override {
    const std::uint32_t lost = core.overflow() - overflow;
    overflow += lost;
    if (lost == 0) return;
    const bool at_edge =
        (now - 2) % kept.width == 0 && now - 3 < kept.count() && kept.pixels[now - 3] != 0;
    const std::uint32_t end = at_edge ? now - 2 : now - 3;
    for (std::uint32_t i = end - lost; i < end; ++i) {
      BOOST_TEST(kept.pixels[i] == 1);
      kept.pixels[i] = 0;
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(labelling_core)

BOOST_AUTO_TEST_CASE(hard_shapes_give_what_a_flood_fill_gives) {
  int number = 0;
  for (const Binary& picture : hard_shapes()) {
    Bench bench(picture.geometry());
    BOOST_TEST(equal(bench.run(picture), flood_fill(picture)), "shape " << number);
    BOOST_TEST(bench.core.overflow() == 0u);
    ++number;
  }
}

// Every picture of five by four, four by five and seven by three pixels.
BOOST_AUTO_TEST_CASE(every_small_picture_gives_what_a_flood_fill_gives) {
  for (const auto& [width, height] : {std::pair{5u, 4u}, {4u, 5u}, {7u, 3u}}) {
    Bench(pl::Geometry{width, height}).check_all_pictures();
  }
}

// Lines of twelve rows that end together, three pixels apart, and then points: of what is shown
// little leaves in a row. BlobLabelling::never_runs_out() promises that more is never in use.
BOOST_AUTO_TEST_CASE(the_most_labels_that_a_picture_takes) {
  constexpr std::uint32_t width = 640, height = 40, rows = 12, side = 10;
  constexpr std::uint32_t lines = width / 4;
  Binary picture{width, height, std::vector<std::uint8_t>(width * height)};
  const auto set = [&](std::uint32_t x, std::uint32_t y) { picture.pixels[y * width + x] = 1; };
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t line = 0; line < lines; ++line) set(3 * line + row, row);
  }
  for (std::uint32_t x = 3 * lines + rows; x < width; x += 2) set(x, rows - 1);
  for (std::uint32_t x = 0; x < width; x += 2) set(x, rows + 1);
  for (std::uint32_t x = 0; x < width; x += 2) set(x, rows + 3);
  const std::uint32_t enough = width * 3 / 4 + 9;
  BOOST_TEST(pl::BlobLabelling::never_runs_out(1, width, enough, side));
  BOOST_TEST(!pl::BlobLabelling::never_runs_out(1, width, enough - 1, side));
  BOOST_TEST(!pl::BlobLabelling::never_runs_out(2, width, enough, side));
  BOOST_TEST(!pl::BlobLabelling::never_runs_out(1, width, enough, side - 1));
  Bench least(picture.geometry(), enough, side), few(picture.geometry(), 380, side);
  least.run(picture);
  few.run(picture);
  BOOST_TEST(least.core.overflow() == 0u);
  BOOST_TEST(few.core.overflow() > 0u);
}

// Frames follow each other without reset: labels come back, and no other state is left.
BOOST_AUTO_TEST_CASE(random_pictures_give_what_a_flood_fill_gives) {
  Random random(1);
  std::size_t components = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::uint32_t width = 8 + random.below(90), height = 1 + random.below(24);
    Bench bench(pl::Geometry{width, height});
    for (int frame = 0; frame < 2; ++frame) {
      const Binary picture = random_picture(random, width, height);
      const auto expected = flood_fill(picture);
      components += expected.size();
      BOOST_TEST(equal(bench.run(picture), expected), "round " << round);
    }
    BOOST_TEST(bench.core.overflow() == 0u);
    BOOST_TEST(bench.core.open_components() == 0u);
    bench.clock(false);
    bench.clock(false);
    BOOST_TEST(bench.core.free_labels() == plenty - 1);
  }
  BOOST_TEST(components > 100'000u);
}

// A run without a label is as if it were bright: components fall apart, none are joined.
BOOST_AUTO_TEST_CASE(runs_without_a_label_are_counted_and_nothing_else_is_wrong) {
  Random random(2);
  std::uint32_t lost = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::uint32_t width = 8 + random.below(60), labels = 4 + random.below(20);
    Bench bench(pl::Geometry{width, 20}, labels);
    for (int frame = 0; frame < 2; ++frame) {
      const auto found = bench.run(random_picture(random, width, 20));
      BOOST_TEST(equal(found, flood_fill(bench.kept)), "round " << round);
    }
    bench.clock(false);
    bench.clock(false);
    BOOST_TEST(bench.core.free_labels() == labels - 1);
    lost += bench.core.overflow();
  }
  BOOST_TEST(lost > 10'000u);
}

// Noise of any density, and every other pixel of every other row. Small blobs that are not shown do
// not wait; where each is shown, eight clocks are not enough for one in four pixels.
BOOST_AUTO_TEST_CASE(no_picture_of_640_px_exhausts_512_labels) {
  Random random(3);
  std::vector<Binary> pictures;
  for (const std::uint32_t share : {50u, 150u, 250u, 500u}) {
    pictures.push_back({640, 60, {}});
    for (std::uint32_t i = 0; i < 640 * 60; ++i)
      pictures.back().pixels.push_back(random.below(1000) < share);
  }
  pictures.push_back({640, 60, {}});
  for (std::uint32_t i = 0; i < 640 * 60; ++i)
    pictures.back().pixels.push_back(i % 2 == 0 && i / 640 % 2 == 0);
  for (const Binary& picture : pictures) {
    Bench bench(picture.geometry(), plenty, 10);
    bench.run(picture);
    BOOST_TEST(bench.core.overflow() == 0u);
  }
  Bench all(pictures.back().geometry(), plenty, 0);
  all.run(pictures.back());
  BOOST_TEST(all.core.overflow() > 1000u);
}

BOOST_AUTO_TEST_CASE(pauses_between_pixels_change_nothing) {
  Random random(4);
  for (int round = 0; round < 300; ++round) {
    const Binary picture = random_picture(random, 40, 20);
    Bench bench(picture.geometry());
    for (std::uint32_t i = 0; i < picture.count(); ++i) {
      const bool row_ends = i % 40 == 0;
      for (std::uint32_t pause = random.below(row_ends ? 20 : 2); pause > 0; --pause)
        bench.clock(false, random.below(2) != 0, random.below(800));
      bench.clock(true, picture.pixels[i], i);
    }
    bench.drain();
    std::sort(bench.shown.begin(), bench.shown.end());
    BOOST_TEST(equal(bench.shown, flood_fill(picture)), "round " << round);
  }
}

// The next frame may begin width + 1 clocks behind the last pixel, while blobs still wait.
BOOST_AUTO_TEST_CASE(frames_may_follow_as_soon_as_the_core_is_ready) {
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    Bench bench(pl::Geometry{48, 16});
    std::vector<pl::Extremes> expected;
    for (int frame = 0; frame < 4; ++frame) {
      const Binary picture = random_picture(random, 48, 16);
      bench.feed(picture, picture.count());
      for (std::uint32_t pause = 0; pause < 49; ++pause) bench.clock(false);
      BOOST_TEST(bench.core.ready());
      const auto found = flood_fill(picture);
      expected.insert(expected.end(), found.begin(), found.end());
    }
    bench.drain();
    std::sort(bench.shown.begin(), bench.shown.end());
    std::sort(expected.begin(), expected.end());
    BOOST_TEST(equal(bench.shown, expected), "round " << round);
  }
}

BOOST_AUTO_TEST_CASE(a_reset_at_any_pixel_forgets_the_frame) {
  Random random(6);
  Bench bench(pl::Geometry{40, 16}, 30);
  for (int round = 0; round < 500; ++round) {
    bench.feed(random_picture(random, 40, 16), random.below(40 * 16 + 1));
    for (std::uint32_t pause = random.below(60); pause > 0; --pause) bench.clock(false);
    bench.core.reset();
    bench.overflow = 0;
    BOOST_TEST(bench.core.idle());
    BOOST_TEST(bench.core.overflow() == 0u);
    BOOST_TEST(bench.core.free_labels() == 29u);
    const auto found = bench.run(random_picture(random, 40, 16));
    BOOST_TEST(equal(found, flood_fill(bench.kept)), "round " << round);
  }
}

// The filter looks at the bounding box; each extreme is the first in raster order among its equals.
BOOST_AUTO_TEST_CASE(a_square_and_a_diamond_have_these_extremes) {
  const Binary square = drawn({"......", ".####.", ".####.", ".####.", ".####.", "......"});
  Bench bench(square.geometry(), plenty, 3);
  BOOST_TEST(bench.run(square).size() == 1u);
  const std::vector<std::uint32_t> corners{1, 4, 4, 4, 1, 1, 1, 1}, rows{1, 1, 1, 4, 4, 4, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) {
    BOOST_TEST(blob_stream::x(bench.shown[0].point(i)) == corners[i], i);
    BOOST_TEST(blob_stream::y(bench.shown[0].point(i)) == rows[i], i);
  }
  Bench strict(square.geometry(), plenty, 4);
  BOOST_TEST(strict.run(square).empty());

  const Binary diamond = drawn({"..#...", ".###..", "#####.", ".###..", "..#..."});
  Bench second(diamond.geometry());
  BOOST_TEST(second.run(diamond).size() == 1u);
  const std::vector<std::uint32_t> tips{2, 2, 4, 4, 2, 0, 0, 2}, heights{0, 0, 2, 2, 4, 2, 2, 0};
  for (std::size_t i = 0; i < 8; ++i) {
    BOOST_TEST(blob_stream::x(second.shown[0].point(i)) == tips[i], i);
    BOOST_TEST(blob_stream::y(second.shown[0].point(i)) == heights[i], i);
  }
}

// Nine clocks behind the pixel below its last one; the next ones follow eight clocks apart, and
// the frame is over one clock behind the last.
BOOST_AUTO_TEST_CASE(blobs_leave_at_these_clocks) {
  const Binary dots = drawn({"#.#.#.......", "............", "..........##"});
  Bench bench(dots.geometry());
  BOOST_TEST(bench.run(dots).size() == 4u);
  // Pixel (0, 1) is taken in clock 13, the others two later each; the last in clock 36, and the
  // row behind the frame follows: its pixel (11, 3) in clock 48.
  const std::vector<std::uint64_t> expected{22, 30, 38, 57};
  BOOST_TEST(bench.shown_at == expected, boost::test_tools::per_element());
  BOOST_TEST(bench.clocks == 58u);
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  Binary picture = hard_shapes()[5];
  Bench bench(picture.geometry());
  const auto found = bench.run(picture);
  picture.pixels[47 * 64 + 31] ^= 1;  // of the comb's back
  BOOST_TEST(!equal(found, flood_fill(picture)));
}

BOOST_AUTO_TEST_SUITE_END()
