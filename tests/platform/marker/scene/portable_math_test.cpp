#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include <marker/scene/portable_math.h>

using namespace platform;

BOOST_AUTO_TEST_SUITE(noise)

BOOST_AUTO_TEST_CASE(portable_functions_agree_with_the_library) {
  double worst_log = 0;
  double worst_exp = 0;
  double worst_angle = 0;
  for (int i = 1; i <= 100000; ++i) {
    const double unit = i / 100000.0;
    const double log = std::log(unit);
    worst_log = std::max(worst_log, std::abs(portable_log(unit) - log) / std::max(-log, 1e-5));
    worst_exp =
        std::max(worst_exp, std::abs(portable_exp_negative(-20 * unit) / std::exp(-20 * unit) - 1));
    const SinCos turn = portable_sin_cos_turn(unit);
    const double angle = 2 * 3.14159265358979323846 * unit;
    worst_angle = std::max(
        {worst_angle, std::abs(turn.sin - std::sin(angle)), std::abs(turn.cos - std::cos(angle))});
  }
  BOOST_TEST(worst_log < 1e-14);
  BOOST_TEST(worst_exp < 1e-12);
  BOOST_TEST(worst_angle < 2e-15);
  BOOST_TEST(std::abs(portable_log(0x1p-53) / std::log(0x1p-53) - 1) < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_generator_is_splitmix64) {
  // Published test vector of the reference implementation, seed 1234567.
  vp::RandomBits bits(1234567);
  BOOST_TEST(bits.next() == 6457827717110365317u);
  BOOST_TEST(bits.next() == 3203168211198807973u);
  BOOST_TEST(bits.next() == 9817491932198370423u);
}

BOOST_AUTO_TEST_CASE(uniform_numbers_are_never_zero) {
  vp::RandomBits bits(1);
  double low = 1;
  double high = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = bits.next_unit();
    low = std::min(low, value);
    high = std::max(high, value);
  }
  BOOST_TEST(low > 0);
  BOOST_TEST(low < 1e-3);
  BOOST_TEST(high <= 1);
  BOOST_TEST(high > 1 - 1e-3);
}

BOOST_AUTO_TEST_CASE(moments_of_a_normal_distribution) {
  constexpr int count = 1000000;
  GaussianNoise noise(42);
  double sum = 0;
  double squares = 0;
  double fourth = 0;
  double products = 0;
  double last = 0;
  int beyond_two = 0;
  for (int i = 0; i < count; ++i) {
    const double value = noise.next();
    sum += value;
    squares += value * value;
    fourth += value * value * value * value;
    products += value * last;
    last = value;
    if (std::abs(value) > 2) ++beyond_two;
  }
  BOOST_TEST(std::abs(sum / count) < 0.004);  // four deviations of the mean
  BOOST_TEST(std::abs(squares / count - 1) < 0.006);
  BOOST_TEST(std::abs(fourth / count - 3) < 0.05);
  BOOST_TEST(std::abs(products / count) < 0.004);
  BOOST_TEST(std::abs(beyond_two / double{count} - 0.0455) < 0.001);
}

BOOST_AUTO_TEST_CASE(seeds_decide) {
  GaussianNoise a(7);
  GaussianNoise b(7);
  GaussianNoise c(8);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const double value = a.next();
    BOOST_TEST(value == b.next());
    differs = differs || value != c.next();
  }
  BOOST_TEST(differs);
}

BOOST_AUTO_TEST_SUITE_END()
