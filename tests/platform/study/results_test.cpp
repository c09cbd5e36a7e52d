#include <study/comparison.h>
#include <study/pareto.h>
#include <study/report.h>
#include <study/results.h>

#include "sweep_kit.h"

using namespace platform::study;
namespace result = platform::result;
using sweep_test::contains;

namespace {

/// A sweep over a wish of a clock, and another parameter.
class Wishes {
 public:
  Wishes() {
    manifest_.swept = {"clk.frequency", "labels"};
    manifest_.families = {{"", {{"clk.frequency", "1 MHz"}, {"labels", "8"}}, {}, Json::object()}};
    manifest_.input_sets.resize(1);
    results_.manifest = manifest_;
  }

  double used = 1;  ///< whether the design uses the clock

  /// A point with a real clock of `mhz`, at which it reaches `fps`.
  void add(const std::string& wish, double mhz, double fps, const std::string& labels = "8") {
    Point point;
    point.key = "key of " + wish;
    point.swept = {{"clk.frequency", wish}, {"labels", labels}};
    Outcome outcome;
    std::vector<std::pair<std::string, double>> figures{
        {"clocks.list.clk.frequency_mhz", mhz},
        {"clocks.list.clk.made.feedback", std::stod(wish)},
        {"clocks.list.clk.offset_percent", std::stod(wish) / mhz},
        {"clocks.list.clk.used", used},
        {"clocks.list.clk.wish_mhz", std::stod(wish)},
        {"summary.fps.mean", fps}};
    for (const char* part : platform::result::verdict_parts)
      figures.emplace_back("verdict." + std::string(part) + ".holds", 1);
    outcome.metrics = result::Metrics(std::move(figures));
    results_.add(manifest_, std::move(point), std::move(outcome));
  }

  /// What the last point is one with.
  std::string same_as() const {
    const std::optional<std::size_t> same = results_.rows.back().same_as;
    return same ? results_.rows[*same].value("clk.frequency") : "";
  }

  const Results& results() const { return results_; }

 private:
  Manifest manifest_;
  Results results_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(results)

BOOST_AUTO_TEST_CASE(wishes_of_which_the_chip_makes_one_clock_are_one_point) {
  Wishes sweep;
  sweep.add("75 MHz", 76.9, 100);
  BOOST_TEST(sweep.same_as() == "");
  sweep.add("76 MHz", 76.9, 100);
  BOOST_TEST(sweep.same_as() == "75 MHz");
  sweep.add("77 MHz", 76.9, 100);
  BOOST_TEST(sweep.same_as() == "75 MHz", "the first, not the one before");
  sweep.add("90 MHz", 90.9, 100);
  BOOST_TEST(sweep.same_as() == "", "another clock, as fast");
  sweep.add("91 MHz", 90.9, 101);
  BOOST_TEST(sweep.same_as() == "", "another result");
  sweep.add("76.5 MHz", 76.9, 101, "16");
  BOOST_TEST(sweep.same_as() == "", "another parameter, with another result");
  sweep.add("77.5 MHz", 76.9, 101, "16");
  BOOST_TEST(sweep.same_as() == "76.5 MHz");
}

BOOST_AUTO_TEST_CASE(a_parameter_that_changes_nothing_is_named_and_makes_no_other_point) {
  Wishes sweep;
  sweep.add("75 MHz", 76.9, 100, "8");
  sweep.add("75 MHz", 76.9, 100, "16");
  BOOST_TEST(sweep.same_as() == "75 MHz");
  sweep.add("90 MHz", 90.9, 110, "8");
  sweep.add("90 MHz", 90.9, 110, "16");
  const std::vector<IdleParameter> idle = idle_parameters(sweep.results());
  BOOST_REQUIRE(idle.size() == 1u);
  BOOST_TEST(idle[0].path == "labels");
  BOOST_TEST(idle[0].comparisons == 2u);
  const std::string text = sweep_text(sweep.results());
  BOOST_TEST(contains(text,
                      "\n'labels' changes no result: 2 comparisons of points that differ in "
                      "it alone show equal results.\n"),
             text);
  // It matters once.
  sweep.add("100 MHz", 100, 120, "8");
  sweep.add("100 MHz", 100, 121, "16");
  BOOST_TEST(idle_parameters(sweep.results()).empty());
  BOOST_TEST(!contains(sweep_text(sweep.results()), "changes no result"));
}

BOOST_AUTO_TEST_CASE(what_is_said_of_a_clock_that_nothing_uses_is_no_result) {
  for (const double used : {0.0, 1.0}) {
    Wishes sweep;
    sweep.used = used;
    sweep.add("75 MHz", 76.9, 100);
    sweep.add("90 MHz", 90.9, 100);
    BOOST_TEST(sweep.same_as() == (used == 0 ? "75 MHz" : ""));
    BOOST_TEST(idle_parameters(sweep.results()).size() == (used == 0 ? 1u : 0u));
  }
}

// Equal results, but the study has a constraint and an objective on the parameter itself.
BOOST_AUTO_TEST_CASE(an_earlier_point_stands_for_another_only_where_the_study_sees_no_difference) {
  Wishes sweep;
  sweep.add("75 MHz", 76.9, 100, "16");
  sweep.add("75 MHz", 76.9, 100, "8");
  const std::vector<Objective> rate{Objective("max summary.fps.mean", "here")};
  BOOST_TEST(rank(sweep.results(), rate).points[1].front == 0u);
  const std::vector<Objective> labels{Objective("min labels", "here")};
  BOOST_TEST(rank(sweep.results(), labels).points[1].front == 1u);
  Results bounded = sweep.results();
  bounded.constraints.emplace_back("labels < 16", "here");
  BOOST_TEST(rank(bounded, rate).points[0].front == 0u);
  BOOST_TEST(rank(bounded, rate).points[1].front == 1u);
}

BOOST_AUTO_TEST_CASE(a_point_is_on_the_front_once) {
  Wishes sweep;
  sweep.add("75 MHz", 76.9, 100);
  sweep.add("76 MHz", 76.9, 100);
  sweep.add("90 MHz", 90.9, 90);
  const Pareto pareto = rank(sweep.results(), {Objective("max summary.fps.mean", "here")});
  BOOST_TEST(pareto.points[0].front == 1u);
  BOOST_TEST(pareto.points[1].front == 0u);
  BOOST_TEST(pareto.points[2].front == 2u);
  const std::string text = sweep_text(sweep.results());
  BOOST_TEST(contains(text, "75 MHz       100  front\n"), text);
  BOOST_TEST(contains(text, "76 MHz       100  same as 75 MHz\n"), text);
  BOOST_TEST(contains(text, "3 of 3 points feasible, 1 the same as another\n"), text);
}

BOOST_AUTO_TEST_SUITE_END()
