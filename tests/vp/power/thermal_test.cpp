#include <vp/power_meter.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include <vp/error.h>

using namespace vp;

namespace {

constexpr LeakageCurve leakage{0.0634, 0.0399, 0.0342};

}  // namespace

BOOST_AUTO_TEST_SUITE(thermal)

BOOST_AUTO_TEST_CASE(the_curve_goes_through_what_it_was_fitted_to) {
  const auto near = boost::test_tools::tolerance(0.005);
  BOOST_TEST(leakage.watts(25) == 0.103, near);
  BOOST_TEST(leakage.watts(44.5) == 0.141, near);
  BOOST_TEST(leakage.watts(60) == 0.195, near);
  BOOST_TEST(leakage.watts(85) == 0.374, near);
}

BOOST_AUTO_TEST_CASE(temperature_and_power_agree) {
  for (const double dynamic_w : {0.0, 0.5, 1.53, 2.1, 6.0}) {
    const ThermalPath path{25, 11.5};
    const StaticPoint point = find_static_point(leakage, path, dynamic_w);
    BOOST_TEST(point.static_w == leakage.watts(point.junction_c));
    BOOST_TEST(std::abs(point.junction_c - 25 - 11.5 * (dynamic_w + point.static_w)) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(more_power_and_a_hotter_room_heat) {
  const StaticPoint cool = find_static_point(leakage, {25, 11.5}, 1.5);
  BOOST_TEST(find_static_point(leakage, {25, 11.5}, 2.0).junction_c > cool.junction_c);
  BOOST_TEST(find_static_point(leakage, {40, 11.5}, 1.5).static_w > cool.static_w);
  BOOST_TEST(find_static_point(leakage, {25, 5}, 1.5).junction_c < cool.junction_c);
}

BOOST_AUTO_TEST_CASE(a_perfect_heat_sink_leaves_the_ambient_temperature) {
  BOOST_TEST(find_static_point(leakage, {25, 0}, 3).junction_c == 25.0);
}

// Where the curve rises faster than the path carries heat away there is no fixed point.
BOOST_AUTO_TEST_CASE(a_runaway_is_refused) {
  for (const ThermalPath& path : {ThermalPath{25, 60}, ThermalPath{90, 30}}) {
    try {
      find_static_point(leakage, path, 2.1);
      BOOST_FAIL("no runaway at " + std::to_string(path.theta_ja) + " C/W");
    } catch (const InputError& error) {
      const std::string text = error.what();
      BOOST_TEST(text.find("thermal runaway") != std::string::npos, text);
      BOOST_TEST(text.find("power.theta_ja") != std::string::npos, text);
      BOOST_TEST(text.find('\n') == std::string::npos);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
