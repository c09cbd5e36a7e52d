// Packets of blobs, at the ports of the stream.
#include <boost/test/unit_test.hpp>

#include "stream.h"
#include "stream_bench.h"

namespace {

using namespace streams;
using blob_stream::words_per_blob;

/// The module alone: the test is camera and labelling, a sink takes the words.
struct BlobBench : kit::Simulation {
  explicit BlobBench(const std::vector<std::string>& assignments = {}) : settings(assignments) {
    ip.rst(rst);
    ip.frame_ena(frame_ena);
    ip.frame_number(frame_number);
    ip.threshold(threshold);
    ip.idle(idle);
    ip.blob_out(blob_out);
    for (std::size_t i = 0; i < words_per_blob; ++i) {
      extremes[i] = std::make_unique<vp::Signal<std::uint32_t>>(("e" + std::to_string(i)).c_str());
      ip.extreme[i](*extremes[i]);
    }
    ip.label_overflow(label_overflow);
    ip.m(link);
    sink.s(link);
    sink.accept(true);
    sc_core::sc_start(vp::from_ps(5'000));
    rst = true;
    clocks(1);
    rst = false;
    clocks(2);
  }
  void clocks(std::uint64_t n) { sc_core::sc_start(vp::from_ps(n * period)); }
  void begin(std::uint32_t number) {
    frame_number = number;
    frame_ena = true;
    clocks(3);
    idle = false;
    clocks(20);
  }
  /// Shows a blob for one clock, `gap` clocks before the next one.
  void blob(std::uint32_t first, std::uint64_t gap = 8) {
    for (std::uint32_t i = 0; i < words_per_blob; ++i) *extremes[i] = first + i;
    blob_out = true;
    clocks(1);
    blob_out = false;
    clocks(gap - 1);
  }
  void end() {
    frame_ena = false;
    clocks(10);
    idle = true;
  }
  std::vector<std::uint32_t> packet() {
    std::vector<std::uint32_t> words;
    std::size_t at = 0;
    while (at < sink.beats.size() && !sink.beats[at].last) words.push_back(sink.beats[at++].data);
    BOOST_REQUIRE(at < sink.beats.size());
    words.push_back(sink.beats[at++].data);
    sink.beats.erase(sink.beats.begin(), sink.beats.begin() + static_cast<std::ptrdiff_t>(at));
    return words;
  }
  std::vector<std::uint32_t> trailer() {
    const std::vector<std::uint32_t> words = packet();
    return {words.end() - blob_stream::trailer_words, words.end()};
  }

  harness::Settings settings;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> rst{"rst"}, frame_ena{"frame_ena"}, idle{"idle", 1, true}, blob_out{"blob_out"};
  vp::Signal<std::uint32_t> frame_number{"frame_number"}, label_overflow{"label_overflow"};
  vp::Signal<std::uint8_t> threshold{"threshold", 8, 77};
  std::array<std::unique_ptr<vp::Signal<std::uint32_t>>, words_per_blob> extremes;
  vp::AxiStream link{"link"};
  pl::BlobStreamClocked ip{"blob_stream", {clk, small_frame}};
  harness::StreamSink sink{"sink", clk};
};

using Words = std::vector<std::uint32_t>;

}  // namespace

BOOST_AUTO_TEST_SUITE(blob_stream_ip)

BOOST_AUTO_TEST_CASE(a_packet_is_blobs_and_trailer_at_exact_times) {
  BlobBench b;
  b.begin(5);
  const std::uint64_t shown = kit::now_ps() + 5'000;  // the edge that samples blob_out
  b.blob(100);
  b.blob(200);
  b.end();
  const std::uint64_t ended = kit::now_ps() + 5'000;  // the edge that samples idle
  b.clocks(20);
  BOOST_REQUIRE(b.sink.beats.size() == 20u);
  // One clock each in the sender, the FIFO and the register.
  for (std::uint32_t i = 0; i < 16; ++i) {
    BOOST_TEST(b.sink.beats[i].data == (i < 8 ? 100 + i : 200 + i - 8));
    BOOST_TEST(b.sink.beats[i].ps == shown + (3 + i) * period);
  }
  BOOST_TEST(b.sink.beats[16].ps == ended + 3 * period);
  BOOST_TEST(b.trailer() == (Words{5, 2, 0, 77}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_checksum_takes_no_clock) {
  BlobBench b({"blob_stream.checksum=true"});
  for (const std::uint32_t number : {5u, 6u}) {
    b.begin(number);
    b.blob(100);
    b.end();
    const std::uint64_t ended = kit::now_ps() + 5'000;
    b.clocks(20);
    BOOST_TEST(b.sink.beats[8].ps == ended + 3 * period);
    const Words words = b.packet();
    BOOST_REQUIRE(words.size() == blob_stream::packet_words(1));
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) sum = blob_stream::add_to_sum(sum, words[i]);
    BOOST_TEST(words.back() == blob_stream::checked_word(sum, 77));
    BOOST_TEST((words.back() & (blob_stream::Checked | 0xFF)) == (blob_stream::Checked | 77u));
  }
}

BOOST_AUTO_TEST_CASE(a_frame_without_blobs_has_a_trailer) {
  BlobBench b;
  b.begin(0);
  BOOST_TEST(b.ip.busy.get());
  b.end();
  b.clocks(10);
  BOOST_TEST(!b.ip.busy.get());
  BOOST_TEST(b.packet() == (Words{0, 0, 0, 77}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_has_no_label_or_no_room_is_told) {
  BlobBench b({"blob_stream.fifo_depth=8"});
  b.label_overflow = 10;  // of frames before
  b.begin(1);
  b.sink.accept(false);
  b.blob(0);        // its first word moves on to the register, the others wait
  b.blob(100, 20);  // no room for all of it
  b.sink.accept(true);
  b.clocks(20);
  b.blob(200);
  b.label_overflow = 17;
  b.end();
  b.clocks(20);
  BOOST_TEST(b.ip.dropped_blobs.get() == 1u);
  const Words words = b.packet();
  BOOST_REQUIRE(blob_stream::blobs_in(static_cast<std::uint32_t>(words.size()) * 4) == 2u);
  BOOST_TEST(words[8] == 200u);
  BOOST_TEST((Words{words.end() - 4, words.end()}) == (Words{1, 2, 8, 77}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(blobs_too_close_to_each_other_are_lost_whole) {
  BlobBench b;
  b.begin(1);
  b.blob(0, 7);
  b.blob(100, 8);
  b.end();
  b.clocks(20);
  BOOST_TEST(b.trailer() == (Words{1, 1, 1, 77}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_packet_has_so_many_blobs_at_most) {
  BlobBench b;
  b.begin(1);
  for (std::uint32_t i = 0; i < blob_stream::max_blobs + 3; ++i) b.blob(i);
  b.end();
  b.clocks(20);
  const Words words = b.packet();
  BOOST_TEST(words.size() * 4 == blob_stream::max_packet_bytes);
  BOOST_TEST((Words{words.end() - 4, words.end()}) == (Words{1, blob_stream::max_blobs, 3, 77}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_frame_without_a_ready_slave_is_dropped_with_its_blobs) {
  BlobBench b;
  b.sink.accept(false);
  b.begin(0);
  b.sink.accept(true);  // too late
  b.blob(0);
  b.end();
  b.clocks(20);
  BOOST_TEST(b.sink.beats.empty());
  BOOST_TEST(!b.ip.busy.get());
  BOOST_TEST(b.ip.dropped_frames.get() == 1u);
  b.begin(1);
  b.blob(8);
  b.end();
  b.clocks(20);
  BOOST_TEST(b.packet() == (Words{8, 9, 10, 11, 12, 13, 14, 15, 1, 1, 0, 77}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_frame_that_begins_too_early_spoils_no_packet) {
  BlobBench b;
  b.begin(0);
  b.blob(0);
  b.frame_ena = false;
  b.clocks(2);
  b.begin(1);  // while blobs of frame 0 may still come
  b.blob(100);
  b.end();
  b.clocks(20);
  BOOST_TEST(b.ip.dropped_frames.get() == 1u);
  const Words words = b.packet();
  BOOST_TEST(words.size() == 12u);
  BOOST_TEST((Words{words.end() - 4, words.end()}) == (Words{0, 1, 1, 77}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_reset_empties_it) {
  BlobBench b;
  b.begin(0);
  b.sink.accept(false);
  b.blob(0);
  b.rst = true;
  b.frame_ena = false;
  b.idle = true;
  b.clocks(1);
  b.rst = false;
  b.clocks(1);
  BOOST_TEST(!b.link.tvalid.get());
  BOOST_TEST(!b.ip.busy.get());
  BOOST_TEST(b.ip.fifo_count.get() == 0u);
  b.sink.accept(true);
  b.begin(9);
  b.end();
  b.clocks(20);
  BOOST_TEST(b.packet() == (Words{9, 0, 0, 77}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
