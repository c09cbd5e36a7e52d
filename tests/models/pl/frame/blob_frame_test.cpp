// BlobFrame against BlobCore: the same packets at the same clocks, the same labels free in the same
// order.
#include <pl/blob_detection/core.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "pictures.h"
#include "reference.h"

using harness::first_difference;
using harness::Random;

namespace {

/// Both, side by side.
struct Pair {
  Pair(const pl::Geometry& g, std::uint32_t labels, std::uint32_t minimum_side)
      : geometry(g), frame(g, labels, minimum_side), reference(g, labels, minimum_side) {}

  void begin() {
    frame.begin();
    reference.begin();
  }
  void advance(const std::vector<std::uint32_t>& words, std::uint32_t pixels) {
    frame.advance(words.data(), pixels, blobs);
    reference.advance(words, pixels);
    compare();
  }
  void rest(std::uint64_t clocks) {
    frame.rest(clocks, blobs);
    reference.rest(clocks);
    compare();
  }
  void finish() {
    frame.finish(blobs);
    reference.finish();
    reference.rest(1);  // numbers what retired last
    frame.rest(1, blobs);
    compare();
    BOOST_TEST(first_difference(blob_words(blobs), reference.words) == "");
  }
  void compare() {
    BOOST_TEST(frame.overflow() == reference.overflow());
    BOOST_TEST(frame.active_labels() == reference.active_labels());
  }
  void run(const std::vector<std::uint32_t>& words) {
    begin();
    advance(words, geometry.pixels());
    finish();
  }

  pl::Geometry geometry;
  pl::BlobFrame frame;
  BlobReference reference;
  std::vector<pl::StampedBlob> blobs;
};

/// Two frames without reset, so that the second starts with the labels in another order.
void check(const Picture& picture, std::uint32_t labels, std::uint32_t minimum_side) {
  BOOST_TEST_CONTEXT(picture.name << ' ' << picture.geometry.width << 'x' << picture.geometry.height
                                  << " labels " << labels << " side " << minimum_side) {
    Pair pair(picture.geometry, labels, minimum_side);
    for (std::uint8_t threshold : {127, 60}) pair.run(pack(picture.image, threshold));
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(blob_frame)

BOOST_AUTO_TEST_CASE(scenes_give_the_words_of_the_core) {
  for (const Picture& picture : scenes()) {
    check(picture, 128, 24);
    check(picture, 128, 1);
  }
}

// A minimum side of 0 reports every box.
BOOST_AUTO_TEST_CASE(every_size_gives_the_words_of_the_core) {
  for (const pl::Geometry& size : small_sizes()) {
    for (const Picture& picture : patterns(size)) check(picture, 128, 0);
  }
  for (const Picture& picture : patterns({1024, 512})) check(picture, 128, 0);
  for (const Picture& picture : patterns({640, 480})) check(picture, 128, 1);
}

BOOST_AUTO_TEST_CASE(labels_that_run_out_give_the_words_of_the_core) {
  for (std::uint32_t labels : {4u, 5u, 7u, 16u, 40u, 1024u}) {
    for (const pl::Geometry& size : {pl::Geometry{32, 64}, {160, 32}, {640, 48}}) {
      for (const Picture& picture : patterns(size)) check(picture, labels, 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_do_run_out) {
  const Picture picture{"dots", {640, 48}, dots({640, 48}, 80, 1)};
  Pair pair(picture.geometry, 16, 0);
  pair.run(pack(picture.image, 127));
  BOOST_TEST(pair.frame.overflow() > 100u);
}

BOOST_AUTO_TEST_CASE(bands_that_end_at_any_pixel_give_the_words_of_the_whole_frame) {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    const pl::Geometry size{96, 32};
    Pair pair(size, 4 + random.below(40), 0);
    for (int frame = 0; frame < 3; ++frame) {
      const auto words = pack(dots(size, random.below(1000), random.below(1'000'000)), 127);
      pair.begin();
      const std::uint32_t step = 1 + random.below(random.below(2) == 0 ? 20 : 400);
      for (std::uint32_t pixels = 0; pixels < size.pixels();) {
        pixels = std::min(size.pixels(), pixels + random.below(step + 1));
        pair.advance(words, pixels);
      }
      pair.finish();
    }
  }
}

// A frame may start while the last one's labels are flushed: its own are flushed with them.
BOOST_AUTO_TEST_CASE(a_frame_that_starts_during_the_flush_gives_the_words_of_the_core) {
  Random random(2);
  for (int round = 0; round < 300; ++round) {
    const pl::Geometry size{64, 32};
    Pair pair(size, 4 + random.below(100), 0);
    for (int frame = 0; frame < 5; ++frame) {
      const auto words = pack(dots(size, random.below(1000), random.below(1'000'000)), 127);
      pair.begin();
      for (std::uint32_t pixels = 0; pixels < size.pixels();) {
        pixels = std::min(size.pixels(), pixels + random.below(1500));
        pair.advance(words, pixels);
      }
      pair.rest(1 + random.below(30));
    }
    pair.finish();
  }
}

// No label is free at the frame's end, some wait for their turn to retire, and the next frame wants
// one in its first clocks.
BOOST_AUTO_TEST_CASE(a_frame_that_finds_no_label_free_gives_the_words_of_the_core) {
  Random random(5);
  for (int round = 0; round < 1500; ++round) {
    const pl::Geometry size{32, 32};
    Pair pair(size, 4 + random.below(20), 0);
    for (int frame = 0; frame < 4; ++frame) {
      harness::Image image = dots(size, 100 + random.below(500), random.below(1'000'000));
      const std::uint32_t bright_from = 32 * random.below(30), bright_to = 32 * random.below(32);
      for (std::uint32_t i = bright_from; i < bright_to; ++i) image[i] = 200;
      if (random.below(2) == 0) image[0] = 20;
      pair.begin();
      pair.advance(pack(image, 127), size.pixels());
      pair.rest(1 + random.below(4));
    }
    pair.finish();
  }
}

// Two labels expire with the last pixel: one retires with it, the other one is flushed, once.
BOOST_AUTO_TEST_CASE(a_label_that_waits_for_its_turn_at_the_end_of_the_frame_is_flushed) {
  const pl::Geometry size{64, 32};
  harness::Image image(size.pixels(), 200);
  for (int k = 0; k < 9; ++k) harness::draw(image, 64, 60 - 2 * k, 22 + k, 60 - 2 * k, 22 + k, 20);
  harness::draw(image, 64, 60, 28, 60, 30, 20);
  Pair pair(size, 128, 0);
  for (int frame = 0; frame < 2; ++frame) {
    pair.begin();
    pair.advance(pack(image, 127), size.pixels());
    BOOST_TEST(pair.frame.active_labels() == 1u);
    pair.finish();
  }
  BOOST_TEST(pair.blobs.size() == 4u);
}

BOOST_AUTO_TEST_CASE(a_reset_at_any_pixel_forgets_the_frame) {
  Random random(3);
  const pl::Geometry size{96, 32};
  Pair pair(size, 20, 0);
  for (int round = 0; round < 200; ++round) {
    const auto words = pack(dots(size, random.below(1000), random.below(1'000'000)), 127);
    pair.begin();
    pair.advance(words, random.below(size.pixels() + 1));
    if (random.below(2) == 0) pair.rest(random.below(20));
    pair.frame.reset();
    pair.reference.reset();
    pair.compare();
    pair.blobs.clear();
    pair.reference.words.clear();
    pair.run(words);
    pair.blobs.clear();
    pair.reference.words.clear();
  }
}

// What an engine does when the future changes: it keeps a copy, and tries again from there.
BOOST_AUTO_TEST_CASE(a_copy_takes_back_what_was_tried) {
  Random random(4);
  const pl::Geometry size{96, 32};
  const auto words = pack(dots(size, 80, 1), 127), others = pack(dots(size, 300, 2), 127);
  Pair pair(size, 20, 0);
  pair.begin();
  for (std::uint32_t pixels = 0; pixels < size.pixels();) {
    const pl::BlobFrame before = pair.frame;
    std::vector<pl::StampedBlob> tried;
    pair.frame.advance(others.data(), size.pixels(), tried);
    pair.frame = before;
    pixels = std::min(size.pixels(), pixels + random.below(200));
    pair.advance(words, pixels);
  }
  pair.finish();
}

// Specification: the k-th flushed label leaves k + 2 clocks behind the last pixel, small ones
// counted.
BOOST_AUTO_TEST_CASE(labels_leave_one_a_clock_after_the_frame) {
  const pl::Geometry size{640, 480};
  pl::BlobFrame frame(size, 128, 24);
  std::vector<pl::StampedBlob> blobs;
  const auto words = pack(harness::blobs_at_the_end(640, 480, 16, 4), 127);
  frame.begin();
  frame.advance(words.data(), size.pixels(), blobs);
  BOOST_TEST(frame.active_labels() == 16u);
  BOOST_TEST(blobs.empty());
  frame.finish(blobs);
  BOOST_REQUIRE(blobs.size() == 4u);
  for (const pl::StampedBlob& blob : blobs) {
    BOOST_TEST(blob.clock > 640u * 480 + 1);
    BOOST_TEST(blob.clock < 640u * 480 + 2 + 16);
  }
}

BOOST_AUTO_TEST_CASE(one_wrong_pixel_is_noticed) {
  const pl::Geometry size{640, 480};
  auto words = pack(harness::one_rectangle(640, 480, 100, 100, 150, 150), 127);
  Pair pair(size, 128, 24);
  pair.begin();
  pair.reference.advance(words, size.pixels());
  words[151 * 20 + 4] |= 1;  // below the rectangle
  pair.frame.advance(words.data(), size.pixels(), pair.blobs);
  pair.frame.finish(pair.blobs);
  pair.reference.finish();
  BOOST_TEST(first_difference(blob_words(pair.blobs), pair.reference.words) != "");
}

BOOST_AUTO_TEST_SUITE_END()
