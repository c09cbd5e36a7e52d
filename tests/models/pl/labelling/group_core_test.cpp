// GroupLabellingCore against a flood fill: two and four pixels a clock, and a FIFO that overflows.
#include <pl/blob_labelling/group_core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>

#include "core_bench.h"

using harness::Random;
using namespace labelling;

namespace {

constexpr std::uint32_t plenty = 4096;

class Bench final : public CoreBench {
 public:
  explicit Bench(const pl::Geometry& g, std::uint32_t fifo = plenty)
      : CoreBench(g, std::make_unique<pl::GroupLabellingCore>(g, labels, 0, fifo)) {}

 private:
  /// Of the runs that ended in the group that comes into the FIFO now, the last ones found no room.
  void note_losses(std::uint32_t now) override {
    std::uint32_t lost = core.overflow() - overflow;
    overflow += lost;
    now -= std::min(now, (pl::GroupLabellingCore::clocks_to_fifo - 1) * geometry.pixels_per_clock);
    for (std::uint32_t i = now; lost > 0 && i + geometry.pixels_per_clock > now; --i) {
      const bool row_ends = i % geometry.width == 0, row_begins = (i - 1) % geometry.width == 0;
      if (row_ends) lost -= remove_run(i);
      if (!row_begins && lost > 0 && kept.pixels[i - 1] == 0) lost -= remove_run(i - 1);
    }
    BOOST_TEST(lost == 0u);
  }
  /// The one whose last pixel is before `end`, in its row; the number of its pixels.
  std::uint32_t remove_run(std::uint32_t end) {
    std::uint32_t i = end;
    do {
      if (kept.pixels[i - 1] == 0) break;
      kept.pixels[--i] = 0;
    } while (i % geometry.width != 0);
    return end - i;
  }

  static constexpr std::uint32_t labels = 2048;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(group_core)

BOOST_AUTO_TEST_CASE(hard_shapes_give_what_a_flood_fill_gives) {
  for (const std::uint32_t group : {2u, 4u}) {
    int number = 0;
    for (const Binary& picture : hard_shapes()) {
      Bench bench({picture.width, picture.height, 64, group});
      BOOST_TEST(equal(bench.run(picture), flood_fill(picture)), "shape " << number);
      BOOST_TEST(bench.core.overflow() == 0u);
      ++number;
    }
  }
}

// Every picture of four by four, eight by two, and six by three pixels.
BOOST_AUTO_TEST_CASE(every_small_picture_gives_what_a_flood_fill_gives) {
  for (const auto& [width, height, group] :
       {std::tuple{4u, 4u, 2u}, {4u, 4u, 4u}, {8u, 2u, 4u}, {6u, 3u, 2u}}) {
    Bench({width, height, 64, group}).check_all_pictures();
  }
}

// A run that finds no room is as if it were bright: components fall apart, none are joined.
BOOST_AUTO_TEST_CASE(runs_without_room_are_counted_and_nothing_else_is_wrong) {
  Random random(2);
  std::uint32_t lost = 0;
  std::size_t whole = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::uint32_t group = 2 + 2 * random.below(2), width = 8 * (1 + random.below(10));
    Bench bench({width, 20, 64, group}, 4 + random.below(16));
    for (int frame = 0; frame < 2; ++frame) {
      const auto found = bench.run(random_picture(random, width, 20));
      BOOST_TEST(equal(found, flood_fill(bench.kept)), "round " << round);
    }
    BOOST_TEST(bench.core.open_components() == 0u);
    lost += bench.core.overflow();
    whole += bench.core.overflow() == 0;
  }
  BOOST_TEST(lost > 10'000u);
  BOOST_TEST(whole > 300u);
}

BOOST_AUTO_TEST_CASE(a_reset_at_any_group_forgets_the_frame) {
  Random random(6);
  Bench bench({40, 16, 64, 4});
  for (int round = 0; round < 500; ++round) {
    const Binary cut = random_picture(random, 40, 16);
    bench.feed(cut, 4 * random.below(161));
    bench.core.reset();
    BOOST_TEST(bench.core.idle());
    const Binary picture = random_picture(random, 40, 16);
    BOOST_TEST(equal(bench.run(picture), flood_fill(picture)), "round " << round);
  }
}

// Three groups a row. The first row's end is taken in clock 3, its runs are in the FIFO behind
// clocks 4, 4 and 5: two end within the first group. One thing a clock: the row's three runs and
// its end; then they pass, and are shown six clocks behind that, eight apart.
BOOST_AUTO_TEST_CASE(blobs_leave_at_these_clocks) {
  const Binary dots = drawn({"#.#.#.......", "............", "..........##"});
  Bench bench({dots.width, dots.height, 64, 4});
  BOOST_TEST(bench.run(dots).size() == 4u);
  // The second row's end is taken in clock 6: the first dot passes in clock 10, and is shown in 16.
  const std::vector<std::uint64_t> expected{16, 24, 32, 40};
  BOOST_TEST(bench.shown_at == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  Binary picture = hard_shapes()[5];
  Bench bench({picture.width, picture.height, 64, 4});
  const auto found = bench.run(picture);
  picture.pixels[47 * 64 + 31] ^= 1;  // of the comb's back
  BOOST_TEST(!equal(found, flood_fill(picture)));
}

BOOST_AUTO_TEST_SUITE_END()
