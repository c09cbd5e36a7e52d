#include <marker/feature_set.h>

#include <boost/test/unit_test.hpp>

using marker::BoundingBox;
using marker::Corner;
using marker::Direction;
namespace packet = marker::packet;

BOOST_AUTO_TEST_SUITE(packets)

BOOST_AUTO_TEST_CASE(corner_word_of_hand_computed_fields) {
  // x 1, y 2, north-less code 3 (west), strength 343 = 1372 >> 2 (thesis C.1.1.2)
  const std::uint32_t word = 0x80000000u | 343u << 21 | 3u << 19 | 2u << 10 | 1u;
  BOOST_TEST((packet::WordFormat::kind(word) == packet::WordFormat::Kind::corner));
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
  BOOST_TEST((packet::WordFormat::kind(start) == packet::WordFormat::Kind::blob_start));
  BOOST_TEST((packet::WordFormat::kind(end) == packet::WordFormat::Kind::blob_end));
  BOOST_TEST(packet::usual_format.number(start) == 2047);
  BOOST_TEST(packet::usual_format.number(end) == 2047);
  BOOST_TEST(packet::usual_format.x(start) == 100);
  BOOST_TEST(packet::usual_format.y(start) == 50);
  BOOST_TEST(packet::usual_format.x(end) == 639);
  BOOST_TEST(packet::usual_format.y(end) == 479);
}

BOOST_AUTO_TEST_CASE(end_word_is_no_corner) {
  BOOST_TEST((packet::WordFormat::kind(0xFFFFFFFFu) == packet::WordFormat::Kind::end));
  BOOST_TEST((packet::WordFormat::kind(0xFFFFFFFEu) == packet::WordFormat::Kind::corner));
}

BOOST_AUTO_TEST_CASE(encoders_cut_fields_to_their_width) {
  BOOST_TEST(packet::encode_end({0, 0, 0x400, 0x200, 0x800}) == 0u);
}

// Strength and number give way to wider coordinates; what is sent is what arrives.
BOOST_AUTO_TEST_CASE(larger_frames_keep_their_features_in_one_word) {
  struct Size {
    std::uint32_t width, height;
    unsigned strength_bits, number_bits;
  };
  for (const Size& size : {Size{640, 480, 10, 11},
                           {1024, 512, 10, 11},
                           {1024, 513, 9, 10},
                           {1280, 720, 8, 9},
                           {1920, 1080, 7, 8},
                           {2048, 2048, 7, 8}}) {
    BOOST_TEST_CONTEXT(size.width << "x" << size.height) {
      const packet::WordFormat format(size.width, size.height);
      BOOST_TEST(format.strength_bits() == size.strength_bits);
      BOOST_TEST(format.number_bits() == size.number_bits);
      const std::uint32_t x = size.width - 5, y = size.height - 5;
      const std::uint32_t corner = format.corner(4080, 3, x, y);
      BOOST_TEST((format.kind(corner) == packet::WordFormat::Kind::corner));
      BOOST_TEST(format.x(corner) == x);
      BOOST_TEST(format.y(corner) == y);
      BOOST_TEST(format.direction(corner) == 3u);
      const std::uint32_t lost = 10 - size.strength_bits;
      BOOST_TEST(format.strength(corner) == (1020u >> lost << lost));
      const std::uint32_t end = format.blob_end(2047, size.width - 1, size.height - 1);
      BOOST_TEST((format.kind(end) == packet::WordFormat::Kind::blob_end));
      BOOST_TEST(format.x(end) == size.width - 1);
      BOOST_TEST(format.y(end) == size.height - 1);
      BOOST_TEST(format.number(end) == (1u << size.number_bits) - 1);
      BOOST_TEST((format.kind(format.blob_start(0, 0, 0)) == packet::WordFormat::Kind::blob_start));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
