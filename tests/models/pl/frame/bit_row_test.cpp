#include <pl/common/bit_row.h>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(bit_row)

BOOST_AUTO_TEST_CASE(set_and_clear_bits_are_found_across_words) {
  pl::BitRow row(160);
  BOOST_TEST(row.capacity() == 192u);
  BOOST_TEST(row.next_set(0) == 192u);
  BOOST_TEST(row.next_clear(0) == 0u);
  for (std::uint32_t i = 60; i < 140; ++i) row.set(i);
  BOOST_TEST(row.count() == 80u);
  BOOST_TEST(row.next_set(0) == 60u);
  BOOST_TEST(row.next_set(61) == 61u);
  BOOST_TEST(row.next_clear(60) == 140u);
  BOOST_TEST(row.next_set(140) == 192u);
  BOOST_TEST(row.next_set(500) == 192u);
  row.reset(127);
  BOOST_TEST(!row[127]);
  BOOST_TEST(row.next_clear(60) == 127u);
}

BOOST_AUTO_TEST_CASE(an_odd_number_of_words_is_loaded_and_the_rest_cleared) {
  pl::BitRow row(160);
  for (std::uint32_t i = 0; i < 192; ++i) row.set(i);
  BOOST_TEST(row.next_clear(0) == 192u);
  const std::uint32_t words[] = {1, 0x8000'0000, 0, 2, 4};
  row.load(words, 5);
  BOOST_TEST(row.count() == 4u);
  BOOST_TEST(row.next_set(0) == 0u);
  BOOST_TEST(row.next_set(1) == 63u);
  BOOST_TEST(row.next_set(64) == 97u);
  BOOST_TEST(row.next_set(98) == 130u);
}

BOOST_AUTO_TEST_SUITE_END()
