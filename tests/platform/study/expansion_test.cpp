#include <study/expansion.h>

#include <cmath>
#include <set>

#include "sweep_kit.h"

using namespace platform::study;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

ParameterKind hertz() {
  return {ParameterKind::Kind::quantity, vp::Unit::frequency};
}

ParameterKind plain() {
  return {ParameterKind::Kind::quantity, vp::Unit::none};
}

Axis list(const std::string& path, const std::vector<std::string>& values) {
  return {path, "s.yaml:1", values, {}};
}

Axis range(const std::string& path, const ValueRange& values) {
  return {path, "s.yaml:1", {}, values};
}

bool everything(const Assignment&) {
  return true;
}

Spec sampled(Sampling::Method method, std::uint64_t points) {
  Spec spec;
  spec.sampling.method = method;
  spec.sampling.points = points;
  return spec;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(expansions)

BOOST_AUTO_TEST_CASE(equal_values_are_written_equally) {
  const AxisValues axis(list("f", {"50 MHz", "50000kHz", "0.05 GHz"}), hertz());
  for (const std::string& value : axis.values()) BOOST_TEST(value == "50 MHz");
}

BOOST_AUTO_TEST_CASE(ranges_reach_both_ends) {
  const AxisValues steps(range("f", {"25 MHz", "200 MHz", "25 MHz", {}, false}), hertz());
  BOOST_TEST(steps.values().size() == 8u);
  BOOST_TEST(steps.values().back() == "200 MHz");
  const AxisValues tenths(range("x", {"0.0", "1.0", "0.1", {}, false}), plain());
  BOOST_TEST(tenths.values().size() == 11u);
  BOOST_TEST(tenths.values()[3] == "0.3");
  const AxisValues logarithmic(range("f", {"1 MHz", "8 MHz", {}, 4, true}), hertz());
  BOOST_TEST(logarithmic.values() == (std::vector<std::string>{"1 MHz", "2 MHz", "4 MHz", "8 MHz"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(wrong_values_are_refused) {
  BOOST_TEST(contains(complaint([] { AxisValues(list("f", {"50"}), hertz()); }), "no unit"));
  BOOST_TEST(contains(complaint([] { AxisValues(list("f", {"50 ms"}), hertz()); }), "wrong unit"));
  BOOST_TEST(contains(complaint([] {
                        AxisValues(range("x", {"5", "1", "1", {}, false}), plain());
                      }),
                      "behind"));
  BOOST_TEST(contains(complaint([] {
                        AxisValues(range("x", {"1", "5", "0", {}, false}), plain());
                      }),
                      "above 0"));
  BOOST_TEST(contains(complaint([] {
                        AxisValues(range("x", {"0", "5", {}, 3, true}), plain());
                      }),
                      "above 0"));
  BOOST_TEST(contains(complaint([] {
                        AxisValues(range("s", {"a", "b", {}, 2, false}), {});
                      }),
                      "takes no range"));
}

BOOST_AUTO_TEST_CASE(a_grid_is_every_combination) {
  const std::vector<AxisGroup> groups{{AxisValues(list("a", {"1", "2"}), plain())},
                                      {AxisValues(list("b", {"3", "4", "5"}), plain())}};
  BOOST_TEST(point_count(Spec{}, groups) == 6);
  const Expansion all = expand(Spec{}, groups, everything, 100);
  BOOST_REQUIRE(all.points.size() == 6u);
  BOOST_TEST(all.points[1][0].second.text() == "1");
  BOOST_TEST(all.points[1][1].second.text() == "4");
  BOOST_TEST(expand(Spec{}, groups, everything, 4).points.size() == 4u);
}

BOOST_AUTO_TEST_CASE(zipped_axes_move_together) {
  const AxisValues a(list("a", {"1", "2"}), plain());
  const std::vector<AxisGroup> groups{{a, AxisValues(list("b", {"3", "4"}), plain())}};
  BOOST_TEST(expand(Spec{}, groups, everything, 100).points.size() == 2u);
  const std::vector<AxisGroup> uneven{{a, AxisValues(list("b", {"3"}), plain())}};
  BOOST_TEST(contains(complaint([&] { point_count(Spec{}, uneven); }), "as many values"));
}

BOOST_AUTO_TEST_CASE(an_astronomical_grid_is_counted_not_made) {
  std::vector<AxisGroup> groups;
  for (int i = 0; i < 12; ++i)
    groups.push_back(
        {AxisValues(range("p" + std::to_string(i), {"1", "1000", "1", {}, false}), plain())});
  BOOST_TEST(point_count(Spec{}, groups) == 1e36);
  BOOST_TEST(expand(Spec{}, groups, everything, 10).points.size() == 10u);
}

BOOST_AUTO_TEST_CASE(no_point_left_is_an_error) {
  const std::vector<AxisGroup> groups{{AxisValues(list("a", {"1", "2"}), plain())}};
  Spec spec;
  spec.constraints.push_back({"a > 3", "s.yaml:9"});
  const auto nothing = [](const Assignment&) { return false; };
  BOOST_TEST(contains(complaint([&] { expand(spec, groups, nothing, 9); }), "contradict"));
}

BOOST_AUTO_TEST_CASE(samples_are_the_same_again) {
  const std::vector<AxisGroup> groups{
      {AxisValues(range("a", {"0.0", "1.0", {}, {}, false}), plain())},
      {AxisValues(range("b", {"1", "4", {}, {}, false}), plain())}};
  for (const auto method : {Sampling::Method::random, Sampling::Method::sobol}) {
    const Spec spec = sampled(method, 64);
    const Expansion first = expand(spec, groups, everything, 1000);
    BOOST_TEST(first.points.size() == 64u);
    BOOST_TEST((first.points == expand(spec, groups, everything, 1000).points));
    std::set<std::string> wholes;
    for (const Assignment& point : first.points) wholes.insert(point[1].second);
    BOOST_TEST(wholes.size() == 4u);
  }
  BOOST_TEST(contains(complaint([&] { point_count(Spec{}, groups); }), "'step' or 'count'"));
}

BOOST_AUTO_TEST_CASE(sobol_fills_the_square_evenly) {
  const std::vector<AxisGroup> groups{
      {AxisValues(range("a", {"0.0", "1.0", {}, {}, false}), plain())},
      {AxisValues(range("b", {"0.0", "1.0", {}, {}, false}), plain())}};
  const Expansion points = expand(sampled(Sampling::Method::sobol, 63), groups, everything, 1000);
  int quadrants[4] = {};
  for (const Assignment& point : points.points)
    ++quadrants[2 * (std::stod(point[0].second) >= 0.5) + (std::stod(point[1].second) >= 0.5)];
  // 64 points with the origin: 16 in each quadrant.
  for (const int count : quadrants) BOOST_TEST(std::abs(count - 16) <= 1);
}

BOOST_AUTO_TEST_CASE(morris_moves_one_axis_at_a_time) {
  const std::vector<AxisGroup> groups{
      {AxisValues(range("a", {"0.0", "3.0", {}, {}, false}), plain())},
      {AxisValues(range("b", {"0.0", "3.0", {}, {}, false}), plain())}};
  const Expansion result = expand(sampled(Sampling::Method::morris, 0), groups, everything, 1000);
  BOOST_TEST(result.points.size() == 30u);
  BOOST_TEST(result.effects.size() == 20u);
  for (const Effect& effect : result.effects) {
    const std::size_t moved = effect.path == "a" ? 0 : 1;
    const Assignment& from = result.points[effect.from];
    const Assignment& to = result.points[effect.to];
    BOOST_TEST(from[1 - moved].second.text() == to[1 - moved].second.text());
    const double step = (std::stod(to[moved].second) - std::stod(from[moved].second)) / 3;
    BOOST_TEST(std::fabs(step - effect.delta) < 1e-9);
    BOOST_TEST(std::fabs(std::fabs(step) - 2.0 / 3) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(one_at_a_time_starts_from_the_base) {
  const std::vector<AxisGroup> groups{{AxisValues(list("a", {"1", "2"}), plain())},
                                      {AxisValues(list("b", {"3"}), plain())}};
  const Expansion result =
      expand(sampled(Sampling::Method::one_at_a_time, 0), groups, everything, 1000);
  BOOST_TEST(result.points.size() == 4u);
  BOOST_TEST(result.points[0].empty());
  BOOST_TEST(result.effects.size() == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
