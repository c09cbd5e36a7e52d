#include <boost/test/unit_test.hpp>
#include <set>

#include <scene/dictionary.h>

#include "scene_kit.h"

using namespace platform;
using scene_kit::check_refused;

BOOST_AUTO_TEST_SUITE(dictionary_of_markers)

BOOST_AUTO_TEST_CASE(known_words) {
  BOOST_TEST(dictionary().size() == 250u);
  BOOST_TEST(marker_word(0) == 0x4ACD);
  BOOST_TEST(marker_word(42) == 0xCD73);
  BOOST_TEST(marker_word(99) == 0x8F38);
}

BOOST_AUTO_TEST_CASE(all_words_differ) {
  const std::set<std::uint16_t> different(dictionary().begin(), dictionary().end());
  BOOST_TEST(different.size() == 250u);
}

BOOST_AUTO_TEST_CASE(the_top_left_cell_is_the_highest_bit) {
  BOOST_TEST(is_black(0x8000, 0, 0));
  BOOST_TEST(is_black(0x1000, 0, 3));
  BOOST_TEST(is_black(0x0001, 3, 3));
  BOOST_TEST(!is_black(0x7FFF, 0, 0));
}

BOOST_AUTO_TEST_CASE(unknown_ids_are_refused) {
  check_refused([] { marker_word(-1); }, "marker ID -1");
  check_refused([] { marker_word(250); }, "give 0 to 249");
}

BOOST_AUTO_TEST_SUITE_END()
