#include <marker/feature_set.h>
#include <marker/work.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <vector>

#include "fake_hal.h"

namespace packet = marker::packet;
using marker::BoundingBox;
using marker::Corner;
using marker::Direction;
using marker::FeatureSet;

namespace {

struct Decoded {
  Decoded() { fake_hal::reset(); }
  const FeatureSet& operator()(const std::vector<std::uint32_t>& words) {
    marker::decode(words.data(), static_cast<std::uint32_t>(words.size()), packet::usual_format,
                   *features);
    return *features;
  }
  std::unique_ptr<FeatureSet> features = std::make_unique<FeatureSet>();
};

const Corner corner_a{10, 20, 300, Direction::north, 0};
const Corner corner_b{11, 21, 301, Direction::east, 0};
const BoundingBox box_0{5, 6, 50, 60, 0};
const BoundingBox box_1{105, 106, 150, 160, 1};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(feature_set, Decoded)

BOOST_AUTO_TEST_CASE(corners_keep_the_order_of_arrival) {
  const auto& f = (*this)(
      {packet::encode(corner_a), packet::encode(corner_b), packet::WordFormat::end_of_frame});
  BOOST_REQUIRE(f.corner_count == 2u);
  BOOST_TEST(f.corners[0].x == 10);
  BOOST_TEST(f.corners[1].x == 11);
  BOOST_TEST(f.blob_count == 0u);
  BOOST_TEST(f.malformed == 0u);
  BOOST_TEST(fake_hal::state().work[static_cast<std::uint32_t>(marker::Work::packets_decoded)] ==
             2u);
  BOOST_TEST(fake_hal::state().function_stack.empty());
}

BOOST_AUTO_TEST_CASE(blob_halves_are_paired_by_number_across_a_corner) {
  const auto& f = (*this)({packet::encode_start(box_0), packet::encode(corner_a),
                           packet::encode_start(box_1), packet::encode_end(box_1),
                           packet::encode_end(box_0), packet::WordFormat::end_of_frame});
  BOOST_REQUIRE(f.blob_count == 2u);
  BOOST_TEST(f.blobs[0].sx == 105);
  BOOST_TEST(f.blobs[0].ey == 160);
  BOOST_TEST(f.blobs[0].number == 1);
  BOOST_TEST(f.blobs[1].sx == 5);
  BOOST_TEST(f.blobs[1].sy == 6);
  BOOST_TEST(f.blobs[1].ex == 50);
  BOOST_TEST(f.blobs[1].ey == 60);
  BOOST_TEST(f.corner_count == 1u);
}

BOOST_AUTO_TEST_CASE(end_word_only) {
  const auto& f = (*this)({packet::WordFormat::end_of_frame});
  BOOST_TEST(f.corner_count == 0u);
  BOOST_TEST(f.blob_count == 0u);
}

BOOST_AUTO_TEST_CASE(nothing_at_all) {
  BOOST_TEST((*this)({}).corner_count == 0u);
}

BOOST_AUTO_TEST_CASE(words_after_the_end_word_do_not_count) {
  BOOST_TEST((*this)({packet::WordFormat::end_of_frame, packet::encode(corner_a)}).corner_count ==
             0u);
}

BOOST_AUTO_TEST_CASE(end_without_start_is_malformed) {
  const auto& f = (*this)({packet::encode_end(box_0), packet::WordFormat::end_of_frame});
  BOOST_TEST(f.blob_count == 0u);
  BOOST_TEST(f.malformed == 1u);
}

BOOST_AUTO_TEST_CASE(start_without_end_is_malformed) {
  const auto& f = (*this)({packet::encode_start(box_0), packet::WordFormat::end_of_frame});
  BOOST_TEST(f.blob_count == 0u);
  BOOST_TEST(f.malformed == 1u);
}

BOOST_AUTO_TEST_CASE(second_start_of_a_number_replaces_the_first) {
  const BoundingBox again{7, 8, 50, 60, 0};
  const auto& f = (*this)(
      {packet::encode_start(box_0), packet::encode_start(again), packet::encode_end(box_0)});
  BOOST_REQUIRE(f.blob_count == 1u);
  BOOST_TEST(f.blobs[0].sx == 7);
  BOOST_TEST(f.malformed == 1u);
}

BOOST_AUTO_TEST_CASE(box_whose_end_lies_before_its_start_is_malformed) {
  const auto& f =
      (*this)({packet::encode_start({50, 6, 0, 0, 3}), packet::encode_end({0, 0, 49, 60, 3})});
  BOOST_TEST(f.blob_count == 0u);
  BOOST_TEST(f.malformed == 1u);
}

BOOST_AUTO_TEST_CASE(many_open_starts_forget_the_oldest) {
  std::vector<std::uint32_t> words;
  for (std::uint16_t n = 0; n < 20; ++n) words.push_back(packet::encode_start({1, 1, 0, 0, n}));
  for (std::uint16_t n = 0; n < 20; ++n) words.push_back(packet::encode_end({0, 0, 9, 9, n}));
  const auto& f = (*this)(words);
  BOOST_TEST(f.blob_count == 8u);
  BOOST_TEST(f.malformed == 24u);  // 12 starts forgotten, 12 ends without start
  BOOST_TEST(f.blobs[0].number == 12);
}

BOOST_AUTO_TEST_CASE(corners_beyond_capacity_are_counted) {
  const std::vector<std::uint32_t> words(marker::max_corners + 3, packet::encode(corner_a));
  const auto& f = (*this)(words);
  BOOST_TEST(f.corner_count == marker::max_corners);
  BOOST_TEST(f.lost_corners == 3u);
}

BOOST_AUTO_TEST_CASE(blobs_beyond_capacity_are_counted) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < marker::max_blobs + 2; ++i) {
    const BoundingBox box{1, 1, 30, 30, static_cast<std::uint16_t>(i % 2048)};
    words.push_back(packet::encode_start(box));
    words.push_back(packet::encode_end(box));
  }
  const auto& f = (*this)(words);
  BOOST_TEST(f.blob_count == marker::max_blobs);
  BOOST_TEST(f.lost_blobs == 2u);
  BOOST_TEST(f.malformed == 0u);
}

BOOST_AUTO_TEST_CASE(word_store_counts_what_it_cannot_hold) {
  auto store = std::make_unique<marker::WordStore>();
  store->clear();
  for (std::uint32_t i = 0; i < marker::max_words + 5; ++i) store->push(i);
  BOOST_TEST(store->count == marker::max_words + 5);
  BOOST_TEST(store->stored() == marker::max_words);
  BOOST_TEST(store->lost() == 5u);
  BOOST_TEST(store->words[marker::max_words - 1] == marker::max_words - 1);
}

BOOST_AUTO_TEST_SUITE_END()
