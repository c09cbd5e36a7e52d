// The words of a blob packet, as logic and software agree on them.
#include <blob_stream.h>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(blob_packet)

BOOST_AUTO_TEST_CASE(a_point_keeps_both_coordinates_up_to_16_bits) {
  const std::uint32_t corner = blob_stream::point(1919, 1079);
  BOOST_TEST(corner == (1079u << 16 | 1919u));
  BOOST_TEST(blob_stream::x(corner) == 1919u);
  BOOST_TEST(blob_stream::y(corner) == 1079u);
  BOOST_TEST(blob_stream::x(blob_stream::point(0xFFFF, 0)) == 0xFFFFu);
  BOOST_TEST(blob_stream::y(blob_stream::point(0xFFFF, 0)) == 0u);
}

// Opposite directions stand four words apart, as all that goes around in eight steps.
BOOST_AUTO_TEST_CASE(extremes_go_clockwise_from_the_top) {
  using namespace blob_stream;
  BOOST_TEST(least_y == 0u);
  BOOST_TEST(greatest_x == 2u);
  BOOST_TEST(greatest_y == least_y + 4);
  BOOST_TEST(least_x == greatest_x + 4);
  BOOST_TEST(least_x_minus_y == greatest_x_minus_y + 4);
  BOOST_TEST(least_x_plus_y == greatest_x_plus_y + 4);
  BOOST_TEST(least_x_plus_y + 1 == words_per_blob);
}

BOOST_AUTO_TEST_CASE(the_length_of_a_packet_says_how_many_blobs_it_has) {
  using namespace blob_stream;
  for (const std::uint32_t blobs : {0u, 1u, 300u, max_blobs})
    BOOST_TEST(blobs_in(packet_words(blobs) * bytes_per_word) == blobs);
  for (const std::uint32_t bytes : {0u, 12u, 15u, 17u, 20u, 16u + 31u, max_packet_bytes + 32u, ~0u})
    BOOST_TEST(blobs_in(bytes) == no_packet, bytes << " bytes are no packet");
}

BOOST_AUTO_TEST_SUITE_END()
