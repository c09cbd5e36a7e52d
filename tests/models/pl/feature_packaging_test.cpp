// Buffers, order, overflow and the end word of the feature packaging, at its ports.
#include <pl/common/geometry.h>
#include <pl/feature_packaging/clocked.h>
#include <boost/test/unit_test.hpp>

#include "change_log.h"
#include "pipeline.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t end_word = marker_logic::WordFormat::end_of_frame;

/// The module alone. Every method works through whole system clocks.
struct Packaging : kit::Simulation {
  explicit Packaging(const std::vector<std::string>& assignments = {}) : settings(assignments) {
    ip.ena(ena);
    ip.rst(rst);
    ip.ready(ready);
    ip.corner_in(corner_in);
    ip.corner_data(corner_data);
    ip.blob_in(blob_in);
    ip.blob_start(blob_start);
    ip.blob_end(blob_end);
    ip.done(done);
    pulse_rst();
  }
  void clocks(unsigned n) {
    sc_core::sc_start(vp::from_ps(n * 10'000u));  // is in the middle between two edges
  }
  void pulse_rst() {
    if (kit::now_ps() == 0) sc_core::sc_start(vp::from_ps(5'000));
    rst = true;
    corner_in = false;
    blob_in = false;
    clocks(1);
    rst = false;
  }
  void corner(std::uint32_t word) {
    corner_data = word;
    corner_in = !corner_in;
    clocks(1);
  }
  void blob(std::uint32_t start, std::uint32_t end) {
    blob_start = start;
    blob_end = end;
    blob_in = !blob_in;
    clocks(1);
  }
  void ask() {
    ready = ready ^ 1;
    clocks(2);
  }
  /// All words that come, including the present one.
  Words read_all() {
    Words words;
    for (std::uint32_t last = 0; ip.feature != last; ask()) {
      last = ip.feature;
      words.push_back(last);
      if (last == end_word) break;
    }
    return words;
  }
  std::uint32_t feature() const { return ip.feature; }
  std::uint32_t overflow() const { return ip.feature_overflow; }

  harness::Settings settings;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> ena{"ena", 1, true}, rst{"rst"};
  vp::Signal<std::uint8_t> ready{"ready", 2};
  vp::Signal<bool> corner_in{"corner_in"}, blob_in{"blob_in"}, done{"done"};
  vp::Signal<std::uint32_t> corner_data{"corner_data"};
  vp::Signal<std::uint32_t> blob_start{"blob_start"}, blob_end{"blob_end"};
  pl::FeaturePackagingClocked ip{"feature_packaging", {clk, {}}};
};

}  // namespace

BOOST_AUTO_TEST_SUITE(feature_packaging)

BOOST_AUTO_TEST_CASE(packets_have_the_fields_of_the_table) {
  BOOST_TEST(pl::Geometry{}.words().corner(1372, 2, 0x155, 0xAA) ==
             (1u << 31 | 343u << 21 | 2u << 19 | 0xAAu << 10 | 0x155u));
  BOOST_TEST(pl::Geometry{}.words().corner(4095, 3, 1023, 510) != end_word);
  BOOST_TEST(pl::Geometry{}.words().blob_start(5, 7, 9) == (1u << 30 | 5u << 19 | 9u << 10 | 7u));
  BOOST_TEST(pl::Geometry{}.words().blob_end(2047, 639, 479) == (2047u << 19 | 479u << 10 | 639u));
  BOOST_TEST(pl::Geometry{}.words().blob_start(2048, 0, 0) == 1u << 30);  // modulo 2048
}

BOOST_AUTO_TEST_CASE(the_first_word_after_rst_comes_by_itself) {
  Packaging p;
  BOOST_TEST(p.feature() == 0u);
  p.corner(0x8000'0001);
  BOOST_TEST(p.feature() == 0u);
  p.clocks(1);
  BOOST_TEST(p.feature() == 0x8000'0001u);
  p.corner(0x8000'0002);
  p.clocks(10);
  BOOST_TEST(p.feature() == 0x8000'0001u);  // the second one waits
  p.pulse_rst();
  BOOST_TEST(p.feature() == 0u);
  p.clocks(10);
  BOOST_TEST(p.feature() == 0u);
  p.corner(0x8000'0003);
  p.clocks(1);
  BOOST_TEST(p.feature() == 0x8000'0003u);
}

BOOST_AUTO_TEST_CASE(each_change_of_either_ready_bit_asks_for_one_word) {
  Packaging p;
  for (std::uint32_t i = 1; i <= 8; ++i) p.corner(0x8000'0000 + i);
  std::uint32_t shown = 1;
  for (const unsigned ready : {1u, 3u, 2u, 0u, 3u}) {
    p.ready = static_cast<std::uint8_t>(ready);
    p.clocks(1);
    BOOST_TEST(p.feature() == 0x8000'0000 + shown);
    p.clocks(1);
    BOOST_TEST(p.feature() == 0x8000'0000 + ++shown);
    p.clocks(5);
    BOOST_TEST(p.feature() == 0x8000'0000 + shown);
  }
}

BOOST_AUTO_TEST_CASE(asked_while_nothing_waits_the_next_word_comes_by_itself_once) {
  Packaging p;
  p.corner(0x8000'0001);
  p.clocks(1);
  p.ask();
  p.ask();  // nothing waits: both ask for the same word
  p.corner(0x8000'0002);
  p.clocks(1);
  BOOST_TEST(p.feature() == 0x8000'0002u);
  p.corner(0x8000'0003);
  p.clocks(10);
  BOOST_TEST(p.feature() == 0x8000'0002u);
}

BOOST_AUTO_TEST_CASE(a_hundred_corners_wait_besides_the_one_that_is_shown) {
  Packaging p;
  for (std::uint32_t i = 1; i <= 101; ++i) p.corner(0x8000'0000 + i);
  BOOST_TEST(p.ip.corner_count.get() == 100u);
  BOOST_TEST(p.overflow() == 0u);
  p.corner(0x8000'0000 + 102);
  p.corner(0x8000'0000 + 103);
  BOOST_TEST(p.ip.corner_count.get() == 100u);
  BOOST_TEST(p.overflow() == 2u);
  const Words words = p.read_all();
  BOOST_REQUIRE(words.size() == 101u);
  for (std::uint32_t i = 0; i < 101; ++i) BOOST_TEST(words[i] == 0x8000'0001 + i);
}

BOOST_AUTO_TEST_CASE(a_word_that_leaves_makes_room_from_the_next_clock_on) {
  Packaging p;
  for (std::uint32_t i = 1; i <= 101; ++i) p.corner(0x8000'0000 + i);
  p.ready = 1;
  p.clocks(1);
  p.corner(0x8000'0000 + 102);  // on the edge on which the second word is shown
  BOOST_TEST(p.feature() == 0x8000'0002u);
  BOOST_TEST(p.overflow() == 1u);
  p.corner(0x8000'0000 + 103);
  BOOST_TEST(p.overflow() == 1u);
  BOOST_TEST(p.ip.corner_count.get() == 100u);
}

BOOST_AUTO_TEST_CASE(a_blob_needs_two_free_words_or_both_are_dropped) {
  Packaging p;
  // The first start word goes to the register: 1 + 49 · 2 = 99 words wait, one is free.
  for (std::uint32_t i = 0; i < 50; ++i) p.blob(0x4000'0000 + i, 0x1000 + i);
  BOOST_TEST(p.ip.blob_count.get() == 99u);
  BOOST_TEST(p.overflow() == 0u);
  p.blob(0x4000'0000 + 50, 0x1000 + 50);
  BOOST_TEST(p.ip.blob_count.get() == 99u);
  BOOST_TEST(p.overflow() == 1u);  // one blob, not two words
  p.ask();
  p.blob(0x4000'0000 + 51, 0x1000 + 51);
  BOOST_TEST(p.overflow() == 1u);
  BOOST_TEST(p.ip.blob_count.get() == 100u);
  const Words words = p.read_all();
  BOOST_REQUIRE(words.size() == 101u);  // without the first start word, read before
  BOOST_TEST(words[0] == 0x1000u);
  for (std::uint32_t i = 1; i < 50; ++i) {
    BOOST_TEST(words[2 * i - 1] == 0x4000'0000 + i);
    BOOST_TEST(words[2 * i] == 0x1000 + i);
  }
  BOOST_TEST(words[99] == 0x4000'0000u + 51);
  BOOST_TEST(words[100] == 0x1000u + 51);
}

BOOST_AUTO_TEST_CASE(corners_go_first_even_between_the_two_words_of_a_blob) {
  Packaging p;
  p.corner(0x8000'0001);
  p.blob(0x4000'0001, 11);
  p.corner(0x8000'0002);
  p.blob(0x4000'0002, 12);
  BOOST_TEST(p.feature() == 0x8000'0001u);
  p.ask();
  BOOST_TEST(p.feature() == 0x8000'0002u);
  p.ask();
  BOOST_TEST(p.feature() == 0x4000'0001u);
  p.corner(0x8000'0003);
  p.ask();
  BOOST_TEST(p.feature() == 0x8000'0003u);
  p.ask();
  BOOST_TEST(p.feature() == 11u);
  p.ask();
  BOOST_TEST(p.feature() == 0x4000'0002u);
}

BOOST_AUTO_TEST_CASE(a_corner_and_a_blob_of_the_same_clock_are_both_kept_or_both_counted) {
  Packaging p({"feature_packaging.buffer_depth=2"});
  for (unsigned i = 0; i < 3; ++i) {
    p.corner_data = 0x8000'0001 + i;
    p.corner_in = !p.corner_in;
    p.blob(0x4000'0001 + i, i);
  }
  BOOST_TEST(p.ip.corner_count.get() == 2u);
  BOOST_TEST(p.ip.blob_count.get() == 2u);
  BOOST_TEST(p.overflow() == 2u);
  p.corner_data = 0x8000'0004;
  p.corner_in = !p.corner_in;
  p.blob(0x4000'0004, 4);
  BOOST_TEST(p.overflow() == 4u);
}

BOOST_AUTO_TEST_CASE(rst_clears_buffers_and_counter) {
  Packaging p;
  for (std::uint32_t i = 1; i <= 105; ++i) p.corner(0x8000'0000 + i);
  for (std::uint32_t i = 0; i < 55; ++i) p.blob(0x4000'0000 + i, i);
  BOOST_TEST(p.overflow() == 4u + 5u);
  p.pulse_rst();
  BOOST_TEST(p.overflow() == 0u);
  BOOST_TEST(p.ip.corner_count.get() == 0u);
  BOOST_TEST(p.ip.blob_count.get() == 0u);
  p.ask();
  BOOST_TEST(p.feature() == 0u);
}

BOOST_AUTO_TEST_CASE(the_end_word_comes_once_when_both_buffers_are_empty) {
  Packaging p;
  p.corner(0x8000'0001);
  p.blob(0x4000'0001, 11);
  p.done = true;
  p.clocks(20);
  const Words expected{0x8000'0001, 0x4000'0001, 11, end_word};
  BOOST_TEST(p.read_all() == expected, boost::test_tools::per_element());
  harness::ChangeLog feature(p.ip.feature, p.scheduler);
  for (int i = 0; i < 5; ++i) p.ask();
  BOOST_TEST(feature.changes.empty());
  // The next frame without rst: done falls and rises again, and a word was asked for.
  p.done = false;
  p.clocks(3);
  p.corner(0x8000'0002);
  p.clocks(1);
  BOOST_TEST(p.feature() == 0x8000'0002u);
  p.done = true;
  p.ask();
  BOOST_TEST(p.feature() == end_word);
}

BOOST_AUTO_TEST_CASE(the_end_word_waits_for_a_word_that_arrives_on_the_same_clock) {
  Packaging p;
  p.done = true;
  p.blob(0x4000'0001, 11);  // done and the toggle are seen on one edge
  p.clocks(1);
  BOOST_TEST(p.feature() == 0x4000'0001u);
  p.ask();
  BOOST_TEST(p.feature() == 11u);
  p.ask();
  BOOST_TEST(p.feature() == end_word);
}

BOOST_AUTO_TEST_CASE(without_done_there_is_no_end_word) {
  Packaging p;
  p.corner(0x8000'0001);
  p.clocks(1);
  for (int i = 0; i < 5; ++i) p.ask();
  BOOST_TEST(p.feature() == 0x8000'0001u);
}

BOOST_AUTO_TEST_CASE(overflow_of_a_whole_frame_without_a_reader) {
  harness::Pipeline pipeline({}, harness::frame_size(128, 64));
  pipeline.load(harness::noise(128, 64, 31));
  pipeline.reset();
  pipeline.raise_ena();
  pipeline.run_to_clock(pipeline.clocks_of_a_frame());
  const std::vector<harness::Word> words = pipeline.words();
  const std::size_t corners = harness::count(words, 'C'), blobs = harness::count(words, 'B');
  BOOST_TEST(corners > 101u);
  BOOST_TEST(pipeline.pl.feature_packaging.feature_overflow.get() == corners - 101);
  BOOST_TEST(pipeline.pl.feature_packaging.blob_count.get() == 2 * blobs);
  pipeline.reset();
  BOOST_TEST(pipeline.pl.feature_packaging.feature_overflow.get() == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
