#include <marker/packet.h>

#include <boost/test/unit_test.hpp>

using marker::BoundingBox;
using marker::Corner;
using marker::Direction;
namespace packet = marker::packet;

BOOST_AUTO_TEST_SUITE(packets)

BOOST_AUTO_TEST_CASE(corner_word_of_hand_computed_fields) {
  // x 1, y 2, north-less code 3 (west), strength 343 = 1372 >> 2 (thesis C.1.1.2)
  const std::uint32_t word = 0x80000000u | 343u << 21 | 3u << 19 | 2u << 10 | 1u;
  BOOST_TEST((packet::kind(word) == packet::Kind::corner));
  const Corner corner = packet::corner(word);
  BOOST_TEST(corner.x == 1);
  BOOST_TEST(corner.y == 2);
  BOOST_TEST(corner.strength == 343);
  BOOST_TEST((corner.direction == Direction::west));
  BOOST_TEST(corner.assigned == 0);
  BOOST_TEST(packet::encode(corner) == word);
}

BOOST_AUTO_TEST_CASE(fields_lie_where_table_4_4_masks_them) {
  BOOST_TEST(packet::encode({0x3FF, 0, 0, Direction::north, 0}) == (0x80000000u | 0x3FF));
  BOOST_TEST(packet::encode({0, 0x1FF, 0, Direction::north, 0}) == (0x80000000u | 0x7FC00));
  BOOST_TEST(packet::encode({0, 0, 0, Direction::west, 0}) == (0x80000000u | 0x180000));
  BOOST_TEST(packet::encode({0, 0, 0x3FF, Direction::north, 0}) == (0x80000000u | 0x7FE00000));
  BOOST_TEST(packet::encode_end({0, 0, 0, 0, 0x7FF}) == 0x3FF80000u);
  BOOST_TEST(packet::encode_start({0, 0, 0, 0, 0}) == 0x40000000u);
}

BOOST_AUTO_TEST_CASE(direction_codes) {
  BOOST_TEST((packet::corner(0x80000000u).direction == Direction::north));
  BOOST_TEST((packet::corner(0x80000000u | 1u << 19).direction == Direction::south));
  BOOST_TEST((packet::corner(0x80000000u | 2u << 19).direction == Direction::east));
  BOOST_TEST((packet::corner(0x80000000u | 3u << 19).direction == Direction::west));
}

BOOST_AUTO_TEST_CASE(blob_words) {
  const BoundingBox box{100, 50, 639, 479, 2047};
  const std::uint32_t start = packet::encode_start(box);
  const std::uint32_t end = packet::encode_end(box);
  BOOST_TEST((packet::kind(start) == packet::Kind::blob_start));
  BOOST_TEST((packet::kind(end) == packet::Kind::blob_end));
  BOOST_TEST(packet::number(start) == 2047);
  BOOST_TEST(packet::number(end) == 2047);
  BOOST_TEST(packet::x(start) == 100);
  BOOST_TEST(packet::y(start) == 50);
  BOOST_TEST(packet::x(end) == 639);
  BOOST_TEST(packet::y(end) == 479);
}

BOOST_AUTO_TEST_CASE(end_word_is_no_corner) {
  BOOST_TEST((packet::kind(0xFFFFFFFFu) == packet::Kind::end));
  BOOST_TEST((packet::kind(0xFFFFFFFEu) == packet::Kind::corner));
}

BOOST_AUTO_TEST_CASE(encoders_cut_fields_to_their_width) {
  BOOST_TEST(packet::encode_end({0, 0, 0x400, 0x200, 0x800}) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
