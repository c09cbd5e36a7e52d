#include <pl/common/simd_target.h>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(simd_target)

BOOST_AUTO_TEST_CASE(there_is_always_one_target) {
  BOOST_TEST(!pl::simd_targets().empty());
}

BOOST_AUTO_TEST_CASE(a_choice_does_not_shorten_the_list) {
  const std::vector<std::string> all = pl::simd_targets();
  BOOST_TEST(pl::use_simd_target(all.back()));
  BOOST_TEST(pl::simd_targets() == all, boost::test_tools::per_element());
  BOOST_TEST(pl::use_simd_target(""));
  BOOST_TEST(pl::simd_targets() == all, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_the_host_does_not_have_is_refused) {
  BOOST_TEST(!pl::use_simd_target("MMX"));
  BOOST_TEST(!pl::use_simd_target("avx2"));
}

BOOST_AUTO_TEST_SUITE_END()
