#include <apps/hybrid/application.h>

#include <boost/test/unit_test.hpp>
#include <set>
#include <string>

#include "fake_hal.h"

BOOST_AUTO_TEST_SUITE(options)

BOOST_AUTO_TEST_CASE(table_is_sound) {
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < hybrid::option_count; ++i) {
    const hal_option_info& option = hybrid::option_table[i];
    BOOST_TEST(names.insert(option.name).second);
    BOOST_TEST(option.minimum <= option.default_value);
    BOOST_TEST(option.default_value <= option.maximum);
    BOOST_TEST(!std::string(option.documentation).empty());
  }
}

BOOST_AUTO_TEST_CASE(values_are_read_by_their_place_in_the_table) {
  fake_hal::reset();
  for (std::uint32_t i = 0; i < hybrid::option_count; ++i) fake_hal::state().options[i] = 24 + i;
  const hybrid::Options options = hybrid::read_options();
  BOOST_TEST(options.margin == 24);
  BOOST_TEST(options.canonical_width == 24u);  // 25, rounded to whole cells
  BOOST_TEST(options.marker_side == 26);
  BOOST_TEST(options.reprojection_stop == 27);
  BOOST_TEST(options.iteration_limit == 28u);
  BOOST_TEST(options.upload);
  BOOST_TEST(options.burst_words == 30u);
  BOOST_TEST(options.timeout == 31);
  BOOST_TEST(options.binary_timeout == 32);
}

BOOST_AUTO_TEST_SUITE_END()
