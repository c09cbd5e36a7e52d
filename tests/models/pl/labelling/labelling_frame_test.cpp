// LabellingFrame against LabellingCore and GroupLabellingCore: the same blobs at the same clocks,
// the same losses, the same end.
#include <pl/blob_labelling/core.h>
#include <pl/blob_labelling/frame.h>
#include <pl/blob_labelling/group_core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <memory>

#include "random_pictures.h"

using harness::Random;
using namespace labelling;

namespace {

constexpr std::uint32_t plenty = 4096;

std::unique_ptr<pl::RunLabeller> make_core(const pl::Geometry& g, std::uint32_t labels,
                                           std::uint32_t side, std::uint32_t fifo) {
  if (g.pixels_per_clock == 1) return std::make_unique<pl::LabellingCore>(g, labels, side);
  return std::make_unique<pl::GroupLabellingCore>(g, labels, side, fifo);
}

struct Pair {
  Pair(const pl::Geometry& g, std::uint32_t labels, std::uint32_t side, std::uint32_t fifo = plenty)
      : geometry(g), made(make_core(g, labels, side, fifo)), queue(labels), frame(g, side, fifo) {}

  void clock(bool ena, std::uint32_t dark = 0, std::uint32_t x = 0, std::uint32_t y = 0) {
    core.clock(ena, dark, x, y);
    if (core.shows()) shown.push_back({now, core.shown()});
    if (core.overflow() != overflow) {
      overflow = core.overflow();
      lost.push_back({now, overflow});
    }
    if (!core.idle()) idle_from = now + 1;
    ++now;
  }
  /// A frame, and so many clocks more than must lie behind it.
  void run(const Binary& picture, std::uint32_t pause) {
    begin = now;
    frame.find(picture.words().data(), begin, queue, blobs, losses);
    for (std::uint32_t i = 0; i < picture.count(); i += geometry.pixels_per_clock)
      clock(true, group_at(picture, i, geometry.pixels_per_clock), i % picture.width,
            i / picture.width);
    over = frame.done_from();
    while (now < frame.next_from()) {
      if (geometry.pixels_per_clock != 1) BOOST_REQUIRE(!core.ready());
      clock(false);
    }
    BOOST_TEST(core.ready());
    for (std::uint32_t i = 0; i < pause; ++i) clock(false);
  }
  void finish() {
    while (!core.idle()) clock(false);
    BOOST_TEST(idle_from == std::max(over, queue.empty_from()));
  }
  bool equal() const {
    return std::equal(shown.begin(), shown.end(), blobs.begin(), blobs.end(),
                      [](const auto& a, const auto& b) {
                        return a.clock == b.clock && a.extremes == b.extremes;
                      }) &&
           std::equal(
               lost.begin(), lost.end(), losses.begin(), losses.end(),
               [](const auto& a, const auto& b) { return a.clock == b.clock && a.lost == b.lost; });
  }

  const pl::Geometry geometry;
  const std::unique_ptr<pl::RunLabeller> made;
  pl::RunLabeller& core = *made;
  pl::LabelQueue queue;
  pl::LabellingFrame frame;
  std::uint64_t now = 1, begin = 0, over = 0, idle_from = 0;
  std::uint32_t overflow = 0;
  std::vector<pl::StampedExtremes> shown, blobs;
  std::vector<pl::StampedLoss> lost, losses;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(labelling_frame)

BOOST_AUTO_TEST_CASE(hard_shapes_give_the_blobs_of_the_core) {
  for (const Binary& picture : hard_shapes()) {
    for (std::uint32_t labels : {512u, 9u}) {
      Pair pair(picture.geometry(), labels, 0);
      pair.run(picture, 0);
      pair.run(picture, 100);
      pair.finish();
      BOOST_TEST(pair.equal());
    }
  }
}

BOOST_AUTO_TEST_CASE(random_pictures_give_the_blobs_of_the_core) {
  Random random(1);
  std::size_t blobs = 0, losses = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::uint32_t width = 32 * (1 + random.below(3)), height = 1 + random.below(24);
    const std::uint32_t labels[] = {4 + random.below(20), 20 + random.below(60), 512};
    Pair pair({width, height}, labels[round % 3], random.below(2) * random.below(8));
    for (int frame = 0; frame < 3; ++frame)
      pair.run(random_picture(random, width, height), random.below(2) * random.below(300));
    pair.finish();
    BOOST_TEST(pair.equal(), "round " << round);
    blobs += pair.shown.size();
    losses += pair.lost.size();
  }
  BOOST_TEST(blobs > 50'000u);
  BOOST_TEST(losses > 10'000u);
}

// A FIFO that overflows, and one that does not.
BOOST_AUTO_TEST_CASE(random_pictures_of_groups_give_the_blobs_of_the_core) {
  Random random(3);
  std::size_t blobs = 0, losses = 0;
  for (int round = 0; round < 6000; ++round) {
    const pl::Geometry size{32 * (1 + random.below(3)), 1 + random.below(24), 64,
                            2 + 2 * random.below(2)};
    const std::uint32_t labels[] = {4 + random.below(20), 20 + random.below(60), 512};
    Pair pair(size, labels[round % 3], random.below(2) * random.below(8),
              random.below(2) == 0 ? plenty : 4 + random.below(20));
    for (int frame = 0; frame < 3; ++frame) {
      pair.run(random_picture(random, size.width, size.height),
               random.below(2) * random.below(300));
    }
    pair.finish();
    BOOST_TEST(pair.equal(), "round " << round);
    blobs += pair.shown.size();
    losses += pair.lost.size();
  }
  BOOST_TEST(blobs > 50'000u);
  BOOST_TEST(losses > 10'000u);
}

BOOST_AUTO_TEST_CASE(large_frames_give_the_blobs_of_the_core) {
  Random random(2);
  for (const auto& [width, height] : {std::pair{640u, 40u}, {1280u, 24u}, {2048u, 17u}}) {
    Pair pair({width, height}, 512, 0);
    for (int frame = 0; frame < 6; ++frame) pair.run(random_picture(random, width, height), 0);
    pair.finish();
    BOOST_TEST(pair.equal());
    Pair groups({width, height, 64, 4}, 512, 0, 64);
    for (int frame = 0; frame < 6; ++frame) groups.run(random_picture(random, width, height), 0);
    groups.finish();
    BOOST_TEST(groups.equal());
  }
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  const Binary picture = hard_shapes()[3];
  Binary other = picture;
  other.pixels[20 * 64 + 5] ^= 1;  // between two dots
  Pair pair(picture.geometry(), 512, 0);
  pair.run(picture, 0);
  pair.finish();
  pair.blobs.clear();
  pl::LabelQueue queue(512);
  pair.frame.find(other.words().data(), 1, queue, pair.blobs, pair.losses);
  BOOST_TEST(!pair.equal());
}

BOOST_AUTO_TEST_SUITE_END()
