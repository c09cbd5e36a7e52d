// From the stream of the DMA into the BRAM.
#include <pl/common/known_frames.h>
#include <pl/control_block/control_block.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>

#include <sstream>
#include <string>

#include "pipeline.h"

namespace {

using harness::Image;

namespace control_packet = pl::control_packet;

constexpr int width = 64, height = 32;

std::vector<std::uint32_t> packed(const Image& image) {
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < image.size(); i += 4) {
    words.push_back(image[i] | std::uint32_t{image[i + 1]} << 8 |
                    std::uint32_t{image[i + 2]} << 16 | std::uint32_t{image[i + 3]} << 24);
  }
  return words;
}

struct Store : harness::Pipeline {
  Store() : Pipeline({}, harness::frame_size(width, height)) {
    reset();
    source.send(packed(image), 32);
  }
  void enable(bool on) { driver.control(on ? control_packet::wr_en : 0); }
  void clocks(unsigned n) { run_for(n * 10'000u); }
  std::vector<std::uint8_t>& memory() { return pl.bram.contents(); }
  unsigned address() const { return pl.axi_image_store.address; }

  Image image = harness::noise(width, height, 41);
};

/// A picture's words, then those of the same picture while another one is written over it.
std::vector<harness::Word> words_of_two_frames(const Image& picture) {
  Store s;
  std::vector<harness::Word> words;
  for (const bool written_over : {false, true}) {
    s.load(picture);
    s.raise_ena();
    s.run_to_clock(900);
    if (written_over) s.driver.control(control_packet::ena | control_packet::wr_en);
    s.run_to_clock(s.clocks_of_a_frame());
    const std::vector<harness::Word> of_frame = s.words();
    BOOST_TEST((of_frame != words), "what is written over is seen");
    words.insert(words.end(), of_frame.begin(), of_frame.end());
    s.driver.control(0);
    s.run_for(s.driver.hold_ps);
  }
  return words;
}

/// Whether an edge reads and writes one word while a frame plays and, from `clock` on, words come
/// into the memory from its start on: a digit for each clock.
char collides(unsigned clock) {
  vp::ReportRouter reports;
  std::ostringstream text;
  reports.redirect(text);
  Store s;
  s.load(s.image);
  s.raise_ena();
  s.run_to_clock(clock);
  s.driver.control(control_packet::ena | control_packet::wr_en);
  s.run_to_clock(s.clocks_of_a_frame());
  return reports.count("/markervp/rule/BRAM_COLLISION") == 0 ? '0' : '1';
}

struct RememberFrames {
  RememberFrames() { pl::known_frame_bytes = 4 * width * height; }
  ~RememberFrames() { pl::known_frame_bytes = 0; }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(image_store)

BOOST_AUTO_TEST_CASE(the_leftmost_pixel_of_a_word_is_in_bits_7_to_0) {
  Store s;
  s.source.send({0x4433'2211, 0x8877'6655}, 32);
  s.enable(true);
  s.clocks(10);
  const std::vector<std::uint8_t> expected{0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88, 0};
  BOOST_TEST(std::vector<std::uint8_t>(s.memory().begin(), s.memory().begin() + 9) == expected,
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(it_takes_one_word_a_clock) {
  Store s;
  s.clocks(5);
  BOOST_TEST(s.image_link.tvalid.get());
  s.enable(true);
  s.clocks(1);  // tready
  BOOST_TEST(s.address() == 0u);
  s.clocks(1);
  BOOST_TEST(s.address() == 1u);
  s.clocks(511);
  BOOST_TEST(s.address() == 512u);
  BOOST_TEST((s.memory() == s.image));
  BOOST_TEST(s.image_link.packets.get() == 16u);
}

BOOST_AUTO_TEST_CASE(without_wr_en_the_master_waits) {
  Store s;
  s.clocks(100);
  BOOST_TEST(s.source.sent() == 0u);
  BOOST_TEST(s.address() == 0u);
  BOOST_TEST((s.memory() == Image(width * height, 0)));
  BOOST_TEST(!s.image_link.tready.get());
  s.enable(true);
  s.clocks(600);
  BOOST_TEST((s.memory() == s.image));
}

BOOST_AUTO_TEST_CASE(wr_en_low_in_the_middle_holds_the_stream_and_its_rise_starts_at_address_0) {
  Store s;
  s.enable(true);
  s.clocks(100);
  s.enable(false);
  s.clocks(50);
  const unsigned stored = s.address();
  BOOST_TEST(stored > 90u);
  BOOST_TEST(s.source.sent() == stored);
  s.clocks(50);
  BOOST_TEST(s.address() == stored);
  s.enable(true);
  s.clocks(2);
  BOOST_TEST(s.address() == 1u);
  const std::vector<std::uint32_t> words = packed(s.image);
  s.clocks(1);
  const std::uint32_t first = s.memory()[0] | s.memory()[1] << 8 | s.memory()[2] << 16 |
                              static_cast<std::uint32_t>(s.memory()[3]) << 24;
  BOOST_TEST(first == words[stored]);  // the stream continues where it stood
}

BOOST_AUTO_TEST_CASE(rst_returns_to_address_0) {
  Store s;
  s.enable(true);
  s.clocks(100);
  s.driver.control(control_packet::wr_en | control_packet::rst);
  s.clocks(10);
  BOOST_TEST(s.address() == 0u);
  BOOST_TEST(!s.image_link.tready.get());
  const std::size_t sent = s.source.sent();
  s.clocks(10);
  BOOST_TEST(s.source.sent() == sent);
}

BOOST_AUTO_TEST_CASE(an_uploaded_image_gives_the_words_of_a_loaded_one) {
  Store s;
  s.enable(true);
  s.clocks(600);
  s.enable(false);
  const std::vector<harness::Word> uploaded = s.run_frame();
  harness::Pipeline loaded({}, harness::frame_size(width, height));
  loaded.load(s.image);
  BOOST_TEST(harness::first_difference(uploaded, loaded.run_frame()) == "");
}

BOOST_AUTO_TEST_CASE(pictures_that_were_seen_before_give_the_same_words) {
  std::vector<Image> pictures;
  for (int seed = 0; seed < 6; ++seed) {  // more than are remembered
    pictures.push_back(harness::rectangles(width, height, 40, seed));
    pictures.push_back(pictures.back());
    pictures.back().back() ^= 0x80;
  }
  std::vector<std::vector<harness::Word>> expected;
  for (const Image& picture : pictures) expected.push_back(words_of_two_frames(picture));
  const RememberFrames remember;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      BOOST_TEST((words_of_two_frames(pictures[i]) == expected[i]));
      BOOST_TEST((words_of_two_frames(pictures[i]) == expected[i]), "seen a moment ago");
    }
  }
}

// Eight bytes are written while one is read, so the store comes past the sensor: at a distance of
// seven bytes for each clock that both go on, the words of four of them are met on one edge.
BOOST_AUTO_TEST_CASE(a_word_that_is_written_while_it_is_read_breaks_a_rule) {
  std::string met;
  for (unsigned clock = 40; clock < 54; ++clock) met += collides(clock);
  BOOST_TEST(met == "00011110001111");
}

BOOST_AUTO_TEST_SUITE_END()
