#include <vp/power_meter.h>

#include <boost/test/unit_test.hpp>

using vp::PiecewiseConstant;

BOOST_AUTO_TEST_SUITE(piecewise)

constexpr std::uint64_t second = 1'000'000'000'000;

BOOST_AUTO_TEST_CASE(a_constant_is_value_times_time) {
  const PiecewiseConstant hz(50e6);
  BOOST_TEST(hz.integral(0, second) == 50e6);
  BOOST_TEST(hz.integral(second, 3 * second) == 100e6);
  BOOST_TEST(hz.integral(second, second) == 0.0);
  BOOST_TEST(hz.integral(2 * second, second) == 0.0);
}

BOOST_AUTO_TEST_CASE(intervals_of_constant_value_add_up) {
  PiecewiseConstant hz(100);
  hz.set(2 * second, 10);
  hz.set(3 * second, 0);
  hz.set(5 * second, 40);
  BOOST_TEST(hz.integral(0, 6 * second) == 200.0 + 10 + 0 + 40);
  BOOST_TEST(hz.integral(second, 2 * second) == 100.0);
  BOOST_TEST(hz.integral(3 * second / 2, 5 * second / 2) == 50.0 + 5);
  BOOST_TEST(hz.integral(7 * second, 8 * second) == 40.0);
}

BOOST_AUTO_TEST_CASE(any_cut_of_an_interval_gives_the_same_sum) {
  PiecewiseConstant w(1);
  w.set(3, 2);
  w.set(8, 5);
  for (std::uint64_t cut = 0; cut <= 20; ++cut) {
    BOOST_TEST(w.integral(0, cut) + w.integral(cut, 20) == w.integral(0, 20),
               boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(of_an_instant_the_last_value_counts) {
  PiecewiseConstant w(1);
  w.set(second, 7);
  w.set(second, 2);
  BOOST_TEST(w.steps().size() == 2u);
  BOOST_TEST(w.at(second) == 2.0);
  BOOST_TEST(w.at(second - 1) == 1.0);
  BOOST_TEST(w.integral(second, 2 * second) == 2.0);
}

BOOST_AUTO_TEST_CASE(no_change_is_no_step) {
  PiecewiseConstant w(1);
  w.set(5, 1);
  BOOST_TEST(w.steps().size() == 1u);
}

BOOST_AUTO_TEST_CASE(what_is_forgotten_changes_nothing_later) {
  PiecewiseConstant w(1);
  w.set(2 * second, 4);
  w.set(4 * second, 6);
  const double later = w.integral(3 * second, 9 * second);
  w.forget_before(3 * second);
  BOOST_TEST(w.steps().size() == 2u);
  BOOST_TEST(w.integral(3 * second, 9 * second) == later);
  BOOST_TEST(w.value() == 6.0);
}

BOOST_AUTO_TEST_SUITE_END()
