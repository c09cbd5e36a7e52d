#include <ps/cpu/local_time.h>
#include <boost/test/unit_test.hpp>

using ps::LocalTime;

BOOST_AUTO_TEST_SUITE(local_time)

BOOST_AUTO_TEST_CASE(cycles_become_picoseconds) {
  LocalTime time;
  time.set_frequency(500'000'000);
  BOOST_TEST(time.empty());
  time.add_cycles(3 * LocalTime::one_cycle);
  BOOST_TEST(!time.empty());
  BOOST_TEST(time.take_ps() == 6'000u);
  BOOST_TEST(time.empty());
  BOOST_TEST(time.take_ps() == 0u);
}

BOOST_AUTO_TEST_CASE(what_is_cut_off_is_kept) {
  LocalTime time;
  time.set_frequency(3'000'000'000);  // a cycle is 333.3… ps
  std::uint64_t total = 0;
  for (int i = 0; i < 3'000; ++i) {
    time.add_cycles(LocalTime::one_cycle);
    total += time.take_ps();
  }
  BOOST_TEST(total == 1'000'000u);
}

BOOST_AUTO_TEST_CASE(stalls_are_kept_in_femtoseconds) {
  LocalTime time;
  time.set_frequency(1'000'000'000);
  std::uint64_t total = 0;
  for (int i = 0; i < 1'000; ++i) {
    time.add_stall_fs(1'001);
    total += time.take_ps();
  }
  BOOST_TEST(total == 1'001u);
}

BOOST_AUTO_TEST_CASE(absurd_amounts_saturate) {
  LocalTime time;
  time.set_frequency(1);
  time.add_cycles(~LocalTime::Wide{0});
  time.add_cycles(~LocalTime::Wide{0});
  time.add_stall_fs(~LocalTime::Wide{0});
  BOOST_TEST(time.take_ps() == std::uint64_t{1} << 62);
}

BOOST_AUTO_TEST_SUITE_END()
