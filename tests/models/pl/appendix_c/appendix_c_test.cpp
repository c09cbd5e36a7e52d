// Each worked example of the thesis' appendix C, with the numbers of its text.
#include <pl/blob_detection/core.h>
#include <pl/common/geometry.h>
#include <pl/corner_detection/core.h>
#include <pl/global_threshold/core.h>
#include <boost/test/unit_test.hpp>

#include "trace_reader.h"
#include "worked_corner.h"

using appendix_c::TraceOf;

namespace {

constexpr std::uint64_t clock_ps = 20'000;

}  // namespace

BOOST_AUTO_TEST_SUITE(appendix)

// C.1 is missing in the thesis: its equations 4.1 and 4.2.
BOOST_AUTO_TEST_CASE(c1_differences_and_bright_pixels_of_a_circle) {
  const TraceOf trace("c01_threshold_component");
  const std::uint64_t in = trace.when("poi", 40), out = in + clock_ps;
  BOOST_TEST(trace.at("t", in) == 30u);
  for (unsigned n = 0; n < 16; ++n) {
    const std::string index = "_" + std::to_string(n);
    const std::uint64_t circle = trace.at("circle" + index, in);
    const bool bright = circle > 40 + 30;
    BOOST_TEST((trace.at("bright", out) >> n & 1) == bright);
    BOOST_TEST(trace.at("difference" + index, out) == (bright ? circle - 70 : 0));
  }
  BOOST_TEST(trace.at("bright", out) == 33023u);
  BOOST_TEST(trace.at("bright", out - 1) == 0u);
  // The second circle climbs from 66 to 81: 70 is not bright, 71 is, by one.
  const std::uint64_t second = in + 2 * clock_ps;
  BOOST_TEST(trace.at("circle_4", second) == 70u);
  BOOST_TEST(trace.at("bright", second + clock_ps) == 0xFFE0u);
  BOOST_TEST(trace.at("difference_4", second + clock_ps) == 0u);
  BOOST_TEST(trace.at("difference_5", second + clock_ps) == 1u);
}

BOOST_AUTO_TEST_CASE(c2_33023_is_contiguous_one_clock_later) {
  BOOST_TEST(33023 == 0x80FF);
  BOOST_TEST(pl::fast::contiguous(33023));
  BOOST_TEST(!pl::fast::contiguous(33023 & ~1));
  const TraceOf trace("c02_contiguity");
  const std::uint64_t in = trace.when("bright", 33023);
  BOOST_TEST(trace.at("contiguous", in) == 0u);
  BOOST_TEST(trace.when("contiguous", 1) == in + clock_ps);
  BOOST_TEST(trace.at("contiguous", in + 2 * clock_ps) == 0u);  // 0x80FB has a gap
}

BOOST_AUTO_TEST_CASE(c3_most_bright_pixels_in_the_east_give_direction_2) {
  BOOST_TEST(pl::fast::direction(33023) == 2u);
  const TraceOf trace("c03_direction");
  const std::uint64_t in = trace.when("bright", 33023);
  BOOST_TEST(trace.when("dir", 2) == in + clock_ps);
  BOOST_TEST(trace.at("dir", in) == 1u);
  BOOST_TEST(trace.at("dir", in + 2 * clock_ps) == 3u);
}

BOOST_AUTO_TEST_CASE(c4_the_strength_is_the_sum_of_the_differences) {
  const TraceOf trace("c04_strength");
  const std::uint64_t out = trace.when("strength", 1372);
  const std::uint64_t in = out - clock_ps;
  std::uint64_t sum = 0;
  for (unsigned n = 0; n < 16; ++n) sum += trace.at("difference_" + std::to_string(n), in);
  BOOST_TEST(sum == 1372u);
  BOOST_TEST(trace.at("difference_8", in) == 0u);  // not bright: adds nothing
  BOOST_TEST(trace.at("strength", out - 1) == 0u);
}

BOOST_AUTO_TEST_CASE(c5_the_only_corner_of_the_array_has_1372_and_leaves_as_343) {
  const TraceOf trace("c05_non_maximum_suppression");
  const std::uint64_t in = trace.when("corners.contiguous_4", 1);
  for (unsigned i = 0; i < 9; ++i) {
    BOOST_TEST(trace.at("corners.contiguous_" + std::to_string(i), in) == (i == 4));
  }
  BOOST_TEST(trace.at("corners.strength_4", in) == 1372u);
  BOOST_TEST(trace.at("corners.strength_5", in) > 0u);  // not a corner: does not count
  BOOST_TEST(trace.at("corners.row_strength_0", in + clock_ps) == 0u);
  BOOST_TEST(trace.at("corners.row_strength_1", in + clock_ps) == 1372u);
  BOOST_TEST(trace.at("corners.row_strength_2", in + clock_ps) == 0u);
  const std::uint64_t out = trace.when("corner_detection.corner_out", 1);
  BOOST_TEST(out == in + 2 * clock_ps);
  BOOST_TEST(trace.at("corner_detection.corner_out", out + clock_ps) == 0u);
  BOOST_TEST(trace.at("packet_strength", out) == 343u);
  BOOST_TEST(1372 >> 2 == 343);
  BOOST_TEST(trace.at("packet_direction", out) == 2u);
  BOOST_TEST(trace.at("corner_detection.corner_data", out) ==
             pl::Geometry{}.words().corner(1372, 2, 20, 12));
}

BOOST_AUTO_TEST_CASE(c6_pixel_80_below_threshold_100_is_dark_and_counted_from_15_to_16) {
  const TraceOf trace("c06_pixel_threshold");
  const std::uint64_t out = trace.when("histogram_80", 16), in = out - clock_ps;
  BOOST_TEST(trace.at("pixel", in) == 80u);
  BOOST_TEST(trace.at("global_threshold.active_threshold", in) == 100u);
  BOOST_TEST(trace.at("histogram_80", in) == 15u);
  BOOST_TEST(trace.at("global_threshold.binary_out", in) == 0u);  // of the pixel before, 150
  BOOST_TEST(trace.at("global_threshold.binary_out", out) == 1u);
  BOOST_TEST(trace.at("global_threshold.binary_out", out + clock_ps) == 0u);  // 150
  // 100 itself is dark, 101 is not.
  const std::uint64_t at_limit = trace.when("pixel", 100);
  BOOST_TEST(trace.at("global_threshold.binary_out", at_limit + clock_ps) == 1u);
  BOOST_TEST(trace.at("global_threshold.binary_out", at_limit + 2 * clock_ps) == 0u);
}

BOOST_AUTO_TEST_CASE(c7_peaks_79_and_178_give_the_threshold_128) {
  const TraceOf trace("c07_next_threshold");
  const std::uint64_t known = trace.when("next_threshold", 128);
  BOOST_TEST(trace.at("black_peak", known) == 79u);
  BOOST_TEST(trace.at("white_peak", known) == 178u);
  BOOST_TEST(trace.at("next_threshold", known - 1) == (60u + 178u) / 2);
  BOOST_TEST(trace.at("global_threshold.active_threshold", known) == 127u);
  // frame_ena falls on one edge, and is seen low on the next one.
  const std::uint64_t loaded = trace.when("global_threshold.active_threshold", 128);
  BOOST_TEST(trace.at("frame_ena", loaded - clock_ps) == 0u);
  BOOST_TEST(trace.at("frame_ena", loaded - clock_ps - 1) == 1u);
  BOOST_TEST(trace.at("black_peak", loaded) == 0u);
  BOOST_TEST(trace.at("white_peak", loaded) == 255u);
}

BOOST_AUTO_TEST_CASE(c8_the_first_pixel_of_a_new_blob_takes_label_2_and_the_next_ones_too) {
  const TraceOf trace("c08_new_label");
  const std::uint64_t out = trace.when("label", 2), in = out - clock_ps;
  BOOST_TEST(trace.at("source.pixel", in) == 1u);
  BOOST_TEST(trace.at("source.x", in) == 11u);
  for (const char* neighbour :
       {"left_far", "left_near", "above_0", "above_1", "above_2", "above_3", "above_4"}) {
    BOOST_TEST(trace.at(std::string("window.") + neighbour, in) == 0u);
  }
  BOOST_TEST(trace.at("next_label", in) == 2u);
  BOOST_TEST(trace.at("next_label", out) == 3u);
  for (unsigned i = 1; i < 5; ++i) {
    BOOST_TEST(trace.at("window.left_near", in + i * clock_ps) == 2u);
    BOOST_TEST(trace.at("label", out + i * clock_ps) == 2u);
  }
  BOOST_TEST(trace.at("label", out + 5 * clock_ps) == 0u);
}

BOOST_AUTO_TEST_CASE(c9_of_the_labels_7_and_12_the_wider_blob_wins) {
  const TraceOf trace("c09_existing_label");
  const std::uint64_t in = trace.when("source.pixel", 1);
  BOOST_TEST(trace.at("window.above_0", in) == 7u);
  BOOST_TEST(trace.at("window.above_4", in) == 12u);
  for (const char* other : {"left_far", "left_near", "above_1", "above_2", "above_3"}) {
    BOOST_TEST(trace.at(std::string("window.") + other, in) == 0u);
  }
  BOOST_TEST(trace.at("label_7.x_width", in) < trace.at("label_12.x_width", in));
  BOOST_TEST(trace.at("label", in) == 0u);
  BOOST_TEST(trace.at("label", in + clock_ps) == 12u);
  BOOST_TEST(trace.at("label_12.sx", in + clock_ps) == 34u);
  BOOST_TEST(trace.at("label_7.ex", in + clock_ps) == 32u);
}

BOOST_AUTO_TEST_CASE(c10_the_box_of_label_3_starts_at_a_point_and_grows_and_4_is_next) {
  const TraceOf trace("c10_bounding_box");
  const std::uint64_t start = trace.when("label_3.active", 1);
  BOOST_TEST(trace.at("label", start) == 3u);
  BOOST_TEST(trace.at("next_label", start - 1) == 3u);
  BOOST_TEST(trace.at("next_label", start) == 4u);
  const auto box = [&trace](std::uint64_t ps) {
    std::vector<std::uint64_t> sides;
    for (const char* side : {"sx", "sy", "ex", "ey"}) {
      sides.push_back(trace.at(std::string("label_3.") + side, ps));
    }
    return sides;
  };
  using Box = std::vector<std::uint64_t>;
  BOOST_TEST(box(start) == (Box{13, 1, 13, 1}), boost::test_tools::per_element());
  BOOST_TEST(box(start + clock_ps) == (Box{13, 1, 14, 1}), boost::test_tools::per_element());
  BOOST_TEST(box(start + 3 * clock_ps) == (Box{13, 1, 16, 1}), boost::test_tools::per_element());
  BOOST_TEST(box(trace.when("label_3.ey", 2)) == (Box{12, 1, 16, 2}),
             boost::test_tools::per_element());
  BOOST_TEST(box(trace.vcd().end_ps()) == (Box{12, 1, 18, 3}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(c11_label_4_is_deactivated_and_its_box_goes_to_the_filter) {
  const TraceOf trace("c11_deactivated_label");
  const std::uint64_t out = trace.when("retired_label", 4);
  BOOST_TEST(trace.when("label_4.active", 0) == out);
  BOOST_TEST(trace.at("label_4.active", out - 1) == 1u);
  // The box ends at (24, 2): two right of it in the line below.
  BOOST_TEST(trace.at("source.x", out - clock_ps) == 27u);
  BOOST_TEST(trace.at("source.y", out - clock_ps) == 3u);
  BOOST_TEST(trace.at("retired_sx", out) == 20u);
  BOOST_TEST(trace.at("retired_sy", out) == 1u);
  BOOST_TEST(trace.at("retired_ex", out) == 24u);
  BOOST_TEST(trace.at("retired_ey", out) == 2u);
  BOOST_TEST(trace.at("free_labels", out) == trace.at("free_labels", out - 1) + 1);
  BOOST_TEST(trace.at("blob_detection.blob_out", out + clock_ps) == 0u);  // too small
}

BOOST_AUTO_TEST_CASE(c12_sides_of_79_and_45_pass_the_filter) {
  BOOST_TEST((pl::BoundingBox{0, 0, 79, 45}.at_least(24)));
  BOOST_TEST((!pl::BoundingBox{0, 0, 79, 23}.at_least(24)));
  BOOST_TEST((!pl::BoundingBox{0, 0, 23, 45}.at_least(24)));
  const TraceOf trace("c12_blob_filter");
  const std::uint64_t in = trace.when("retired_label", 1);
  BOOST_TEST(trace.at("side_x", in) == 79u);
  BOOST_TEST(trace.at("side_y", in) == 45u);
  BOOST_TEST(trace.at("blob_detection.blob_out", in) == 0u);
  const std::uint64_t out = trace.when("blob_detection.blob_out", 1);
  BOOST_TEST(out == in + clock_ps);
  BOOST_TEST(trace.at("packet_sx", out) == 0u);
  BOOST_TEST(trace.at("packet_sy", out) == 0u);
  BOOST_TEST(trace.at("packet_ex", out) == 79u);
  BOOST_TEST(trace.at("packet_ey", out) == 45u);
  BOOST_TEST(trace.at("blob_detection.blob_start", out) ==
             pl::Geometry{}.words().blob_start(0, 0, 0));
  BOOST_TEST(trace.at("blob_detection.blob_end", out) ==
             pl::Geometry{}.words().blob_end(0, 79, 45));
  BOOST_TEST(trace.at("blob_detection.blob_out", out + clock_ps) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
