// Rules of the blob detection that need a picture of their own.
#include <pl/blob_detection/core.h>
#include <boost/test/unit_test.hpp>

#include "detection_kit.h"

using namespace detection_kit;

BOOST_AUTO_TEST_SUITE(blob_rules)

BOOST_AUTO_TEST_CASE(both_sides_must_reach_24) {
  BOOST_TEST(
      blobs(harness::one_rectangle(64, 64, 5, 6, 29, 30)) == (std::vector<Box>{{5, 6, 29, 30}}),
      boost::test_tools::per_element());
  BOOST_TEST(blobs(harness::one_rectangle(64, 64, 5, 6, 28, 40)).empty());
  BOOST_TEST(blobs(harness::one_rectangle(64, 64, 5, 6, 40, 29)).empty());
}

BOOST_AUTO_TEST_CASE(pixels_two_apart_in_a_line_or_two_columns_off_below_are_neighbours) {
  Image line = plain(200);
  bar(line, 10, 10, 12, 12);
  bar(line, 14, 10, 16, 12);  // one bright column between: the left neighbours reach over it
  BOOST_TEST(blobs(line, every_blob).size() == 1u);
  Image apart = plain(200);
  bar(apart, 10, 10, 12, 12);
  bar(apart, 15, 10, 17, 12);
  BOOST_TEST(blobs(apart, every_blob).size() == 2u);
  Image below = plain(200);
  bar(below, 10, 10, 12, 12);
  bar(below, 14, 13, 16, 15);
  BOOST_TEST(blobs(below, every_blob) == (std::vector<Box>{{10, 10, 16, 15}}),
             boost::test_tools::per_element());
  Image farther = plain(200);
  bar(farther, 10, 10, 12, 12);
  bar(farther, 15, 13, 17, 15);
  BOOST_TEST(blobs(farther, every_blob).size() == 2u);
}

BOOST_AUTO_TEST_CASE(lines_do_not_wrap_around_the_border) {
  Image image = plain(200);
  bar(image, 60, 10, 63, 14);
  bar(image, 0, 11, 3, 15);
  BOOST_TEST(blobs(image, every_blob).size() == 2u);
}

BOOST_AUTO_TEST_CASE(the_widest_neighbour_wins_and_of_equal_ones_the_first) {
  // Two bars and a pixel below, between them: above it left 12, above it right 16.
  const auto with_right_end = [](int ex) {
    Image image = plain(200);
    bar(image, 10, 10, 12, 13);
    bar(image, 16, 10, ex, 13);
    bar(image, 14, 14, 14, 18);
    return blobs(image, every_blob);
  };
  BOOST_TEST(with_right_end(18) == (std::vector<Box>{{16, 10, 18, 13}, {10, 10, 14, 18}}),
             boost::test_tools::per_element());
  BOOST_TEST(with_right_end(19) == (std::vector<Box>{{10, 10, 12, 13}, {14, 10, 19, 18}}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(blobs_are_numbered_from_0_in_the_order_in_which_they_leave) {
  Image image = plain(200);
  for (int i = 0; i < 5; ++i) bar(image, 2 + i * 12, 5 + 3 * i, 8 + i * 12, 12 + 3 * i);
  unsigned number = 0;
  for (const Word& w : run(image, every_blob)) {
    if (w.kind != 'B') continue;
    BOOST_TEST((w.first >> 19 & 0x7FF) == number);
    BOOST_TEST((w.second >> 19 & 0x7FF) == number);
    BOOST_TEST(w.first >> 30 == 1u);
    BOOST_TEST(w.second >> 30 == 0u);
    ++number;
  }
  BOOST_TEST(number == 5u);
}

// Three labels besides the background's.
BOOST_AUTO_TEST_CASE(a_pixel_without_a_free_label_stays_unlabelled_and_is_counted) {
  std::vector<std::string> settings = harness::frame_size(width, height);
  settings.insert(settings.end(),
                  {"pl.blob_detection.label_count=4", "pl.blob_detection.minimum_side=1 px"});
  harness::Pipeline pipeline({}, settings);
  Image image = plain(200);
  for (int i = 0; i < 5; ++i) bar(image, 2 + i * 10, 10, 4 + i * 10, 11);
  pipeline.load(image);
  const std::vector<Word> words = pipeline.run_frame();
  BOOST_TEST(harness::count(words, 'B') == 3u);
  BOOST_TEST(pipeline.pl.blob_detection.label_overflow.get() == 2u * 3u * 2u);
  pipeline.reset();
  BOOST_TEST(pipeline.pl.blob_detection.label_overflow.get() == 0u);
}

BOOST_AUTO_TEST_CASE(a_freed_label_is_usable_two_clocks_later) {
  pl::BlobCore core({64, 32}, 4);
  const auto step = [&core](unsigned x, unsigned y, bool dark) {
    core.step(true, dark, x, y);
    return core.label();
  };
  // Line 0: three dots use up the labels 1, 2, 3. They retire in line 1, two right of each.
  for (unsigned x = 0; x < 64; ++x) {
    const pl::BlobCore::Label label = step(x, 0, x == 10 || x == 20 || x == 30);
    BOOST_TEST(label == (x == 10 ? 1u : x == 20 ? 2u : x == 30 ? 3u : 0u));
  }
  BOOST_TEST(core.next_label() == 0u);
  for (unsigned x = 0; x < 13; ++x) step(x, 1, false);
  BOOST_TEST(core.active(1));
  // Dark from here on: at x = 13 label 1 is freed, at 14 it is read ahead, at 15 a pixel has it.
  BOOST_TEST(step(13, 1, true) == 0u);
  BOOST_TEST(!core.active(1));
  BOOST_TEST(step(14, 1, true) == 0u);
  BOOST_TEST(core.next_label() == 1u);
  BOOST_TEST(step(15, 1, true) == 1u);
  BOOST_TEST(core.overflow() == 2u);
  BOOST_TEST(core.box(1).sx == 15u);
}

BOOST_AUTO_TEST_CASE(of_two_labels_that_expire_the_lower_leaves_first_one_a_clock) {
  pl::BlobCore core({64, 32}, 16);
  for (unsigned x = 0; x < 64; ++x) core.step(true, x == 58 || x == 61 || x == 10, x, 0);
  std::vector<std::pair<unsigned, unsigned>> retired;  // label, raster position
  for (unsigned y = 1; y < 4; ++y) {
    for (unsigned x = 0; x < 64; ++x) {
      if (core.step(true, false, x, y)) retired.emplace_back(core.retired_label(), y * 64 + x);
    }
  }
  // Label 3 ends at column 61: no pixel of line 1 lies two right of it.
  const std::vector<std::pair<unsigned, unsigned>> expected{
      {1, 64 + 13}, {2, 64 + 61}, {3, 2 * 64}};
  BOOST_TEST((retired == expected));
}

BOOST_AUTO_TEST_SUITE_END()
