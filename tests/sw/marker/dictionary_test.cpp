#include <marker/dictionary.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>

using marker::Code;
using marker::dictionary;
using marker::hamming_distance;
using marker::rotate_clockwise;

BOOST_AUTO_TEST_SUITE(dictionary_of_markers)

BOOST_AUTO_TEST_CASE(words_of_the_thesis) {
  BOOST_TEST(dictionary[99] == 0x8F38);  // 1000 1111 0011 1000, table 3.2
  BOOST_TEST(dictionary[42] == 0xCD73);
  BOOST_TEST(dictionary[0] == 0x4ACD);
}

BOOST_AUTO_TEST_CASE(rotations_of_table_3_2) {
  const Code upright = 0b1000'1111'0011'1000;
  const Code by_90 = rotate_clockwise(upright);
  const Code by_180 = rotate_clockwise(by_90);
  const Code by_270 = rotate_clockwise(by_180);
  BOOST_TEST(by_90 == 0b1011'0010'0110'0110);
  BOOST_TEST(by_180 == 0b0001'1100'1111'0001);
  BOOST_TEST(by_270 == 0b0110'0110'0100'1101);
  BOOST_TEST(rotate_clockwise(by_270) == upright);
}

BOOST_AUTO_TEST_CASE(distances_of_table_3_3) {
  Code code = 0b0110'0110'0100'1101;  // the table's candidate at 0°
  const unsigned to_99[] = {10, 0, 10, 12};
  const unsigned to_42[] = {10, 6, 10, 6};
  for (unsigned turn = 0; turn < 4; ++turn) {
    if (turn < 3) BOOST_TEST(hamming_distance(code, dictionary[99]) == to_99[turn]);
    BOOST_TEST(hamming_distance(code, dictionary[42]) == to_42[turn]);
    code = rotate_clockwise(code);
  }
}

BOOST_AUTO_TEST_CASE(distance_limits) {
  BOOST_TEST(hamming_distance(0x1234, 0x1234) == 0u);
  BOOST_TEST(hamming_distance(0x0000, 0xFFFF) == 16u);
  BOOST_TEST(hamming_distance(0x8000, 0x0000) == 1u);
}

BOOST_AUTO_TEST_CASE(no_word_equals_a_rotation_of_itself_or_another) {
  for (unsigned a = 0; a < marker::dictionary_size; ++a) {
    Code turned = dictionary[a];
    for (unsigned turn = 0; turn < 4; ++turn) {
      const auto hits = std::count(dictionary.begin(), dictionary.end(), turned);
      BOOST_TEST(hits == (turn == 0 ? 1 : 0));
      turned = rotate_clockwise(turned);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
