#include <study/sensitivity.h>

#include <boost/test/unit_test.hpp>

#include "number_space.h"

using namespace platform::study;
using namespace space_test;

namespace {

/// Steps as "path: from -> to".
std::vector<std::string> texts(const std::vector<Step>& steps) {
  std::vector<std::string> texts;
  for (const Step& step : steps) texts.push_back(step.path + ": " + step.from + " -> " + step.to);
  return texts;
}

struct Point {
  Point(const std::string& yaml, Assignment at)
      : platform(numbers()),
        space(parse_spec(yaml, "study.yaml"), platform),
        base(std::move(at)),
        steps(steps_from(space, base)) {}

  StepEffects effects(const std::vector<std::string>& figures) {
    Results results;
    add(results, base);
    for (const Step& step : steps) add(results, step.point);
    std::vector<vp::Expression> expressions;
    for (const std::string& figure : figures) expressions.emplace_back(figure, "here");
    return effects_of(steps, results, expressions);
  }
  void add(Results& results, const Assignment& point) {
    const platform::study::Point planned = space.point(point);
    results.add(space.manifest(), planned, outcome_of(planned));
  }

  Platform platform;
  Space space;
  Assignment base;
  std::vector<Step> steps;
};

using Texts = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(steps)

BOOST_AUTO_TEST_CASE(a_step_leads_to_the_neighbour_in_size) {
  const Point middle("parameters: {a: [5, 1, 9, 3]}\n", {{"a", "3"}});
  BOOST_TEST(texts(middle.steps) == (Texts{"a: 3 -> 1", "a: 3 -> 5"}),
             boost::test_tools::per_element());
  const Point end("parameters: {a: [5, 1, 9, 3]}\n", {{"a", "9"}});
  BOOST_TEST(texts(end.steps) == (Texts{"a: 9 -> 5"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(words_have_no_order_and_ranges_without_step_a_twentieth) {
  const Point words("parameters: {word: [plain, odd, even]}\n", {{"word", "odd"}});
  BOOST_TEST(texts(words.steps) == (Texts{"word: odd -> plain", "word: odd -> even"}),
             boost::test_tools::per_element());
  const Point range("parameters: {a: {start: 0.0, stop: 100.0}}\n", {{"a", "2"}});
  BOOST_TEST(texts(range.steps) == (Texts{"a: 2 -> 0", "a: 2 -> 7"}),
             boost::test_tools::per_element());
  const Point decades("parameters: {a: {start: 1.0, stop: 1048576.0, scale: log}}\n", {{"a", "4"}});
  BOOST_TEST(texts(decades.steps) == (Texts{"a: 4 -> 2", "a: 4 -> 8"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_moves_together_steps_together) {
  const Point zipped("zip:\n  - a: [1, 2, 3]\n    b: [10, 20, 30]\n", {{"a", "2"}, {"b", "20"}});
  BOOST_TEST(texts(zipped.steps) == (Texts{"a+b: 2 / 20 -> 1 / 10", "a+b: 2 / 20 -> 3 / 30"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(constraints_on_parameters_rule_steps_out) {
  const Point point("parameters: {a: [1, 2, 3]}\nconstraints: [a <= 2]\n", {{"a", "2"}});
  BOOST_TEST(texts(point.steps) == (Texts{"a: 2 -> 1"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_strongest_step_is_first) {
  // Frames a second are 100 a - 50 b² with a and b in thousands, b from 500 on.
  Point point("parameters: {b: [400, 500, 600], a: [400, 500, 600]}\n",
              {{"b", "500"}, {"a", "500"}});
  const StepEffects effects = point.effects({"summary.fps.mean", "summary.latency_us.mean"});
  BOOST_REQUIRE(effects.rows.size() == 4u);
  BOOST_TEST(*effects.base[0] == 50);
  BOOST_TEST(!effects.base[1].has_value());
  BOOST_TEST(effects.rows[0].step.path == "a");
  BOOST_TEST(*effects.rows[0].changes[0] == -10, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*effects.rows[1].changes[0] == 10, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(effects.rows[2].step.path == "b");
  BOOST_TEST(*effects.rows[2].changes[0] == -0.5, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(!effects.rows[0].changes[1].has_value());
  BOOST_TEST(effects.rows[0].trouble == "");
  const std::string table = effects_table(effects);
  BOOST_TEST(table.find("+10") != std::string::npos, table);
  const std::string csv = effects_csv(effects);
  BOOST_TEST(csv.find("summary.fps.mean,50,b,500,400,-0.5,\n") != std::string::npos, csv);
  const Json json = effects_json(effects, "key");
  BOOST_TEST(json["figures"][0]["base"] == 50);
  BOOST_TEST(json["rows"][0]["changes"][1].is_null());
  BOOST_TEST(json["rows"][3]["to"] == "600");
}

BOOST_AUTO_TEST_CASE(many_points_have_the_keys_that_each_has_alone) {
  const Platform platform = numbers();
  const std::string yaml =
      "parameters: {a: {start: 0, stop: 999, step: 1}, b: [1, 2, 3], word: [plain, odd]}\n";
  const Manifest manifest = plan(parse_spec(yaml, "study.yaml"), {}, platform);
  BOOST_TEST(manifest.points.size() == 6000u);
  Space space(parse_spec(yaml, "study.yaml"), platform);
  for (const platform::study::Point& point : manifest.points) {
    BOOST_REQUIRE(point.key == key_of(manifest.identity(point)));
    BOOST_REQUIRE(point.key == space.point(point.swept).key);
  }
}

BOOST_AUTO_TEST_SUITE_END()
