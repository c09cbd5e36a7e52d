#include <vp/power_meter.h>

#include <boost/test/unit_test.hpp>
#include <stdexcept>

using namespace vp;

namespace {

constexpr std::uint64_t ms = 1'000'000'000;

struct Fixture {
  PiecewiseConstant always{1};
  PiecewiseConstant hz{50e6};
  double events = 3;
  PowerMeter meter;

  Fixture() {
    meter.add({"ps", "ps", "Vccpint", PowerKind::state, "test", {1, 2, 3}, &always, nullptr});
    meter.add({"pl", "pl", "Vccint", PowerKind::clock, "test", {0, 1e-9, 0}, &hz, nullptr});
    meter.add({"bram", "pl", "Vccbram", PowerKind::event, "test", {0, 1e-6, 0}, nullptr, [this] {
                 return events;
               }});
  }
  double joules(const std::vector<Interval>& intervals, const std::string& module) const {
    return meter.measure(intervals).by_module().at(module).nominal;
  }
};

const auto near = boost::test_tools::tolerance(1e-12);

}  // namespace

BOOST_FIXTURE_TEST_SUITE(power_meter, Fixture)

BOOST_AUTO_TEST_CASE(a_state_takes_its_watts) {
  BOOST_TEST(joules({{0, 10 * ms}}, "ps") == 0.020, near);
  BOOST_TEST(meter.measure({{0, 10 * ms}}).by_module().at("ps").high == 0.030, near);
}

BOOST_AUTO_TEST_CASE(a_clock_takes_energy_per_clock) {
  BOOST_TEST(joules({{0, 10 * ms}}, "pl") == 0.0005, near);
}

BOOST_AUTO_TEST_CASE(a_clock_that_changes_is_integrated) {
  hz.set(4 * ms, 100e6);
  hz.set(6 * ms, 0);
  BOOST_TEST(joules({{0, 10 * ms}}, "pl") == 1e-9 * (50e6 * 0.004 + 100e6 * 0.002), near);
}

BOOST_AUTO_TEST_CASE(power_is_linear_in_the_clock) {
  PiecewiseConstant twice(100e6);
  PowerMeter other;
  other.add({"pl", "pl", "Vccint", PowerKind::clock, "test", {0, 1e-9, 0}, &twice, nullptr});
  BOOST_TEST(other.watts(0) == 2 * meter.watts(0, "pl"), near);
}

BOOST_AUTO_TEST_CASE(intervals_may_have_gaps) {
  BOOST_TEST(joules({{0, 2 * ms}, {7 * ms, 8 * ms}}, "ps") == 0.006, near);
}

BOOST_AUTO_TEST_CASE(events_count_from_the_mark) {
  BOOST_TEST(joules({}, "bram") == 0.0);  // those before the source was declared
  events = 10;
  BOOST_TEST(joules({}, "bram") == 7e-6, near);
  meter.mark();
  BOOST_TEST(joules({}, "bram") == 0.0);
  events = 11;
  BOOST_TEST(joules({}, "bram") == 1e-6, near);
}

BOOST_AUTO_TEST_CASE(watts_are_those_of_the_moment) {
  hz.set(5 * ms, 10e6);
  BOOST_TEST(meter.watts(4 * ms) == 2 + 0.05, near);
  BOOST_TEST(meter.watts(5 * ms, "pl") == 0.01, near);
  BOOST_TEST(meter.watts(5 * ms, "none") == 0.0);
  BOOST_TEST(meter.power(5 * ms).low == 1.0);
  BOOST_TEST(meter.power(5 * ms).nominal == meter.watts(5 * ms), near);
  BOOST_TEST(meter.power(5 * ms).high == 3.0);
}

BOOST_AUTO_TEST_CASE(a_source_is_a_state_or_events) {
  BOOST_CHECK_THROW(meter.add({"x", "x", "x", PowerKind::event, "test", {}, nullptr, nullptr}),
                    std::logic_error);
  BOOST_CHECK_THROW(
      meter.add({"x", "x", "x", PowerKind::event, "test", {}, &hz, [] { return 0.0; }}),
      std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()
