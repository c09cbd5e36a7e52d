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

// Sums of any size, taken in any steps, are those of 128-bit arithmetic.
BOOST_AUTO_TEST_CASE(little_and_much_are_exact) {
  using Wide = LocalTime::Wide;
  std::uint64_t chance = 1;
  const auto draw = [&](unsigned bits) {
    chance = chance * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return bits == 0 ? 0 : chance >> (64 - bits);
  };
  for (const std::uint64_t hertz : {1ull, 3ull, 666'666'687ull, 999'999'999'989ull}) {
    const bool slow = hertz < 1'000;  // fewer cycles, so that nothing saturates
    LocalTime time;
    time.set_frequency(hertz);
    Wide cycles = 0, stall_fs = 0, taken = 0;
    for (int i = 0; i < 2'000; ++i) {
      const std::uint64_t some_cycles = draw(static_cast<unsigned>(draw(6)) % (slow ? 24 : 50));
      const std::uint64_t some_fs = draw(static_cast<unsigned>(draw(6)) % 60);
      time.add_cycles(some_cycles);
      time.add_stall_fs(some_fs);
      cycles += some_cycles;
      stall_fs += some_fs;
      const std::uint64_t more = draw(static_cast<unsigned>(draw(6)) % (slow ? 4 : 30));
      const auto ps_of = [&](Wide all) {
        return (all * 30'517'578'125u / (Wide{hertz} << 5) + stall_fs) / LocalTime::fs_per_ps;
      };
      BOOST_TEST((time.ps_after(more) == ps_of(cycles + (Wide{more} << 20)) - taken));
      if (i % 3 != 0) taken += time.take_ps();
      if (i % 3 != 0) BOOST_TEST((taken == ps_of(cycles)));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
