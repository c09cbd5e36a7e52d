#include <study/explore/explore.h>
#include <study/explore/progress.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include <result/metrics.h>
#include <vp/error.h>

#include "number_space.h"

using namespace platform;
using namespace platform::explore;
using namespace space_test;

namespace {

constexpr const char* square = R"(
parameters:
  a: {start: 0, stop: 1000, step: 1}
  b: {start: 0, stop: 1000, step: 1}
search: {points: 400, generation: 20}
)";

/// The same with other words for its search.
std::string square_with(const std::string& search) {
  std::string text(square);
  return text.replace(text.find("points: 400"), 11, search);
}

/// A search over `yaml` by a clock on which a point takes a second. Points from `most` on are
/// interrupted, and so are those that the study's time does not suffice for.
struct Study {
  using Outcome = study::Outcome (*)(const study::Point&);

  explicit Study(const std::string& yaml, Outcome outcome = outcome_of, std::size_t most = 1e9)
      : space(study::parse_spec(yaml, "study.yaml"), platform),
        budget(space.spec().search, [this] { return now; }),
        explorer(space, budget, [=](const auto& positions) {
          std::map<std::size_t, study::Outcome> found;
          for (const std::size_t position : positions) {
            if (position >= most || budget.time_is_over()) break;
            found[position] = outcome(space.manifest().points[position]);
            ++now;
          }
          return found;
        }) {}

  Answer answer() {
    return explore::answer(explorer, [] { return true; });
  }
  Relaxations relaxations() {
    return explore::relaxations(explorer, [] { return true; });
  }

  std::vector<std::string> keys() {
    std::vector<std::string> keys;
    for (const study::Point& point : space.manifest().points) keys.push_back(point.key);
    return keys;
  }

  study::Platform platform = numbers();
  study::Space space;
  double now = 1000;
  Budget budget;
  Explorer explorer;
};

std::string complaint(const std::string& yaml, Study::Outcome outcome = outcome_of) {
  try {
    Study study(yaml, outcome);
    study.explorer.explore();
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(explorer)

BOOST_AUTO_TEST_CASE(a_million_points_need_a_few_hundred) {
  Study study(square);
  const End end = study.explorer.explore();
  BOOST_TEST((end == End::points || end == End::no_gain));
  const auto& rows = study.explorer.results().rows;
  BOOST_TEST(rows.size() <= 400u);
  BOOST_TEST(rows.size() == study.space.manifest().points.size());
  // The best points have b = 500 and any a: half of the box and more is below the curve.
  BOOST_TEST(study.explorer.front().size() > 20u);
  BOOST_TEST(study.explorer.front().hypervolume() > 0.65);
}

BOOST_AUTO_TEST_CASE(its_progress_never_falls_and_ends_at_its_hypervolume) {
  Study study(square);
  study.explorer.explore();
  study::Results results = study.explorer.results();
  BOOST_TEST(progress_json(results).is_null());  // points of no search
  results.manifest = study.space.manifest();
  const study::Json progress = progress_json(results);
  const auto points = progress["points"].get<std::vector<std::size_t>>();
  const auto hypervolume = progress["hypervolume"].get<std::vector<double>>();
  BOOST_REQUIRE(points.size() == hypervolume.size());
  BOOST_TEST((points.size() > 50 && points.size() <= 200));
  BOOST_TEST(points.back() == results.rows.size());
  BOOST_TEST(std::is_sorted(points.begin(), points.end()));
  BOOST_TEST(std::is_sorted(hypervolume.begin(), hypervolume.end()));
  BOOST_TEST(hypervolume.front() < 0.9 * hypervolume.back());
  BOOST_TEST(hypervolume.back() == study.explorer.front().hypervolume());
  for (study::ResultRow& row : results.rows) row.failed = true;
  BOOST_TEST(progress_json(results).is_null());
}

BOOST_AUTO_TEST_CASE(a_search_that_was_interrupted_goes_on_as_if_it_was_not) {
  Study whole(square), part(square, outcome_of, 95);
  whole.explorer.explore();
  BOOST_TEST((part.explorer.explore() == End::interrupted));
  const std::vector<std::string> all = whole.keys(), some = part.keys();
  BOOST_TEST(some.size() == 95u);
  BOOST_TEST(part.explorer.results().rows.size() == 95u);
  BOOST_TEST(std::equal(some.begin(), some.end(), all.begin()));
  BOOST_TEST(part.explorer.front().size() > 5u);
}

BOOST_AUTO_TEST_CASE(the_seed_decides_which_points_are_computed) {
  Study first(square), again(square), other(std::string(square) + "frames: 1\n");
  first.explorer.explore();
  again.explorer.explore();
  BOOST_TEST((first.keys() == again.keys()));
  const std::string text =
      std::string(square).replace(std::string(square).find("generation"), 0, "seed: 2, ");
  Study seeded(text);
  seeded.explorer.explore();
  BOOST_TEST((seeded.keys() != first.keys()));
}

BOOST_AUTO_TEST_CASE(constraints_choose_points_and_judge_results) {
  Study study(std::string(square) +
              "constraints: [a + b <= 900, summary.fps.mean >= 20]\n"
              "objectives: [min power.total_w.nominal]\n");
  study.explorer.explore();
  for (const study::Point& point : study.space.manifest().points)
    BOOST_TEST(number(point, "a") + number(point, "b") <= 900);
  // The slowest that is fast enough, on its best b.
  BOOST_REQUIRE(study.explorer.front().size() == 1u);
  BOOST_TEST(study.explorer.front().costs().front().front() == 0.04,
             boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(a_small_space_is_looked_at_as_a_whole_and_once) {
  Study study("parameters: {a: [1, 2, 3, 3.0], word: [plain, odd]}\nconstraints: [a != 2]\n");
  BOOST_TEST((study.explorer.explore() == End::exhausted));
  const std::vector<std::string> keys = study.keys();
  BOOST_TEST(keys.size() == 4u);
  BOOST_TEST(std::set<std::string>(keys.begin(), keys.end()).size() == 4u);
}

BOOST_AUTO_TEST_CASE(a_range_without_steps_is_searched) {
  Study study(
      "parameters: {a: {start: 0.0, stop: 1000.0}, b: {start: 0.0, stop: 1000.0}}\n"
      "objectives: [min power.total_w.nominal]\nsearch: {points: 300}\n");
  study.explorer.explore();
  BOOST_TEST(std::isinf(study.space.size()));
  BOOST_TEST(study.explorer.front().costs().front().front() < 0.001);
}

BOOST_AUTO_TEST_CASE(more_points_than_anybody_computes_are_no_obstacle) {
  std::string text = "parameters:\n  a: {start: 0, stop: 1000000, step: 1}\n";
  text += "  b: {start: 0.0, stop: 1000.0, step: 0.001}\n";
  Study study(text + "  word: [plain, odd]\nsearch: {points: 50}\n");
  BOOST_TEST(study.space.size() > 1e12);
  BOOST_TEST((study.explorer.explore() == End::points));
  BOOST_TEST(study.keys().size() == 50u);
}

BOOST_AUTO_TEST_CASE(without_gain_it_ends) {
  Study study(std::string(square) + "objectives: [min 0 * a + 7]\n");
  BOOST_TEST((study.explorer.explore() == End::no_gain));
  BOOST_TEST(study.keys().size() < 400u);
}

BOOST_AUTO_TEST_CASE(time_ends_it) {
  Study study("parameters: {a: {start: 0, stop: 1000, step: 1}}\nsearch: {time: 1 ns}\n");
  BOOST_TEST((study.explorer.explore() == End::time));
  BOOST_TEST(study.keys().size() == 1u);  // the one in progress
  BOOST_TEST(contains(complaint("parameters: {a: [1, 2]}\nsearch: {time: soon}\n"),
                      "study.yaml:2: 'soon' is no time for a search: write '90 s'"));
}

BOOST_AUTO_TEST_CASE(where_no_point_runs_it_ends_at_once) {
  Study study(square, [](const study::Point&) {
    study::Outcome outcome;
    outcome.failed = true;
    outcome.failure = {1, 0, "no such word"};
    return outcome;
  });
  BOOST_TEST((study.explorer.explore() == End::failed));
  BOOST_TEST(study.keys().size() == 20u);
  BOOST_TEST(study.explorer.least_violating() == nullptr);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_searched_is_told_before_the_first_point) {
  const std::string start(square);
  BOOST_TEST(contains(complaint("parameters: {a: [7]}\n"),
                      "the space has one point, so there is nothing to search"));
  BOOST_TEST(
      contains(complaint(start + "sample: {method: sobol, points: 9}\n"), "leave out 'sample'"));
  BOOST_TEST(contains(complaint(start + "objectives: [max word]\n"), "this is a text"));
  BOOST_TEST(contains(complaint(start + "objectives: [max summary.fps.men]\n"),
                      "did you mean 'summary.fps.mean'"));
  BOOST_TEST(contains(complaint(start + "objectives: [max a, max b, min a, min b, max a + b]\n"),
                      "at most 4 objectives"));
  BOOST_TEST(contains(
      complaint(start + "constraints: [summary.fps.mean >= 200, summary.fps.mean < 100]\n"),
      "'summary.fps.mean >= 200' and 'summary.fps.mean < 100' contradict each other"));
  BOOST_TEST(contains(complaint(start + "constraints: [a + b > 2000]\n"), "contradict"));
}

BOOST_AUTO_TEST_CASE(of_two_constraints_either_may_give_way) {
  Study study(square_with("points: 1600") +
              "constraints: [summary.fps.mean >= 80, power.total_w.nominal <= 0.25]\n");
  study.explorer.explore();
  BOOST_TEST(study.explorer.front().size() == 0u);
  const Relaxations relaxed = study.relaxations();
  const std::vector<Relaxation>& found = relaxed.found;
  BOOST_REQUIRE(found.size() == 2u);
  // 0.25 W is a = 500, which gives 50 frames a second; 80 are a = 800, which take 0.64 W.
  BOOST_TEST(found[0].given_up.text() == "summary.fps.mean >= 80");
  BOOST_TEST(*found[0].row.metrics.find("summary.fps.mean") == 50,
             boost::test_tools::tolerance(0.05));
  BOOST_TEST(*found[0].row.metrics.find("power.total_w.nominal") <= 0.25);
  BOOST_TEST(*found[1].row.metrics.find("power.total_w.nominal") == 0.64,
             boost::test_tools::tolerance(0.05));
  BOOST_TEST(*found[1].row.metrics.find("summary.fps.mean") >= 80);
  const std::string text = text_of(study.explorer, relaxed);
  BOOST_TEST(contains(text, "'summary.fps.mean >= 80' gives way to summary.fps.mean = "), text);
}

BOOST_AUTO_TEST_CASE(constraints_on_parameters_may_give_way_too) {
  Study study(square_with("points: 1600") +
              "constraints: [a <= 500, summary.fps.mean >= 80, b != 500]\n");
  study.explorer.explore();
  const Relaxations relaxed = study.relaxations();
  const std::vector<Relaxation>& found = relaxed.found;
  BOOST_REQUIRE(found.size() == 2u);
  BOOST_TEST(found[0].given_up.text() == "summary.fps.mean >= 80");
  BOOST_TEST(std::stod(found[0].row.value("a")) == 500, boost::test_tools::tolerance(0.05));
  BOOST_TEST(found[1].given_up.text() == "a <= 500");
  BOOST_TEST(std::stod(found[1].row.value("a")) == 800, boost::test_tools::tolerance(0.05));
  // What gave way for a point makes it one that is not feasible.
  for (const study::ResultRow& row : study.explorer.results().rows)
    BOOST_TEST((study.explorer.results().feasible(row) == result::Holds::no));
  for (const Relaxation& relaxation : found) BOOST_TEST(relaxation.row.value("b") != "500");
}

BOOST_AUTO_TEST_CASE(a_part_of_the_verdict_may_give_way) {
  // Nothing above a = 600 meets timing.
  const auto slow = [](const study::Point& point) {
    study::Outcome outcome = outcome_of(point);
    const double margin = 100 * (600 / std::max(1.0, number(point, "a")) - 1);
    std::vector<std::pair<std::string, double>> figures;
    for (std::size_t i = 0; i < outcome.metrics.names().size(); ++i) {
      const std::string& name = outcome.metrics.names()[i];
      const bool met = name != "verdict.timing.holds" || margin >= 0;
      figures.emplace_back(name, met ? outcome.metrics.values()[i] : 0);
    }
    figures.emplace_back("verdict.timing.margin_percent", margin);
    outcome.metrics = result::Metrics(std::move(figures));
    return outcome;
  };
  Study study(square_with("points: 1600") + "target_rate: 75 fps\n", slow);
  study.explorer.explore();
  const Relaxations relaxed = study.relaxations();
  const std::vector<Relaxation>& found = relaxed.found;
  BOOST_REQUIRE(found.size() == 2u);
  const bool first = found[0].given_up.text() == "verdict.timing";
  const Relaxation &timing = found[first ? 0 : 1], &rate = found[first ? 1 : 0];
  BOOST_TEST(std::stod(timing.row.value("a")) == 750, boost::test_tools::tolerance(0.05));
  BOOST_TEST(std::stod(rate.row.value("a")) == 600, boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(where_one_alone_does_not_help_it_is_said) {
  Study study(square_with("points: 1600") +
              "constraints: [summary.fps.mean >= 180, power.total_w.nominal >= 5]\n");
  study.explorer.explore();
  const Relaxations relaxed = study.relaxations();
  const std::vector<Relaxation>& found = relaxed.found;
  BOOST_TEST(found.empty());
  BOOST_TEST(contains(text_of(study.explorer, relaxed), "at least two would have to give way"));
  std::size_t asked = 0;
  const Relaxations refused = relaxations(study.explorer, [&] { return ++asked == 0; });
  BOOST_TEST(asked == 1u);
  BOOST_TEST(refused.cut_short);
  BOOST_TEST(contains(text_of(study.explorer, refused), "more points or time may find one"));
}

// Nothing is feasible, and five things could give way: all searches share the points.
BOOST_AUTO_TEST_CASE(no_more_points_than_allowed_are_looked_at) {
  const std::string hopeless =
      "parameters:\n  a: {start: 0, stop: 1000, step: 1}\n  b: {start: 0, stop: 1000, step: 1}\n"
      "constraints: [summary.fps.mean >= 180, power.total_w.nominal >= 5, a >= 100, b >= 100]\n";
  for (const std::size_t most : {2, 7, 41, 80, 500}) {
    Study study(hopeless + "search: {points: " + std::to_string(most) + "}\n");
    const Answer answer = study.answer();
    BOOST_TEST(study.keys().size() <= most);
    BOOST_TEST(study.now <= 1000.0 + static_cast<double>(most));
    BOOST_REQUIRE(answer.relaxations.has_value());
    BOOST_TEST(answer.relaxations->found.empty());
    if (most == 80u) {
      BOOST_TEST((answer.end == End::points));
      BOOST_TEST(study.keys().size() == most);
      BOOST_TEST(contains(text_of(study.explorer, *answer.relaxations),
                          "more points or time may find one"));
    }
  }
}

BOOST_AUTO_TEST_CASE(one_deadline_holds_for_all_searches) {
  const auto with_time = [&](const std::string& time) {
    return square_with("points: 4000, time: " + time) +
           "constraints: [summary.fps.mean >= 80, power.total_w.nominal <= 0.1]\n";
  };
  Study study(with_time("90 s"));
  const Answer answer = study.answer();
  BOOST_TEST(study.now == 1090);
  BOOST_TEST(study.keys().size() == 90u);
  BOOST_REQUIRE(answer.relaxations.has_value());
  BOOST_TEST((answer.end == End::time));
  BOOST_TEST(answer.relaxations->found.size() == 2u);
  BOOST_TEST(answer.relaxations->cut_short);
  BOOST_TEST(contains(text_of(study.explorer, *answer.relaxations), "The budget ended these"));
  // Time enough: it ends by itself.
  Study patient(with_time("9000 s"));
  BOOST_TEST(!patient.answer().relaxations->cut_short);
  BOOST_TEST(patient.now < 5000);
  // With feasible points, the whole time is for them.
  Study feasible(
      "parameters: {a: {start: 0, stop: 1000, step: 1}}\n"
      "search: {time: 90 s, generation: 20, patience: 90}\n");
  BOOST_TEST((feasible.answer().end == End::time));
  BOOST_TEST(feasible.keys().size() == 90u);
}

BOOST_AUTO_TEST_CASE(what_nothing_can_give_way_for_takes_the_whole_budget) {
  const auto idle = [](const study::Point& point) {
    study::Outcome outcome = outcome_of(point);
    std::vector<std::pair<std::string, double>> figures;
    for (std::size_t i = 0; i < outcome.metrics.names().size(); ++i) {
      const std::string& name = outcome.metrics.names()[i];
      figures.emplace_back(name, name == "verdict.job.holds" ? 0 : outcome.metrics.values()[i]);
    }
    outcome.metrics = result::Metrics(std::move(figures));
    return outcome;
  };
  Study study(square_with("points: 50, patience: 99"), idle);
  const Answer answer = study.answer();
  BOOST_TEST((answer.end == End::points));
  BOOST_TEST(study.keys().size() == 50u);
  BOOST_REQUIRE(answer.relaxations.has_value());
  BOOST_TEST(contains(text_of(study.explorer, *answer.relaxations), "do not do their job"));
}

// Of what would have to give way nothing does: the search continues with the point that it found.
BOOST_AUTO_TEST_CASE(a_feasible_point_that_a_relaxation_finds_is_the_answer) {
  const std::string rare =
      square_with("points: 900, patience: 2") +
      "constraints: [summary.fps.mean >= 99, power.total_w.nominal <= 0.985]\n";
  Study study(rare);
  study.explorer.explore();
  BOOST_REQUIRE(!study.explorer.has_feasible_point());
  Study whole(rare);
  const Answer answer = whole.answer();
  BOOST_TEST(!answer.relaxations.has_value());
  BOOST_TEST(whole.explorer.front().size() != 0u);
  BOOST_TEST(whole.keys().size() <= 900u);
}

BOOST_AUTO_TEST_CASE(an_objective_that_no_point_has_ends_it) {
  BOOST_TEST(contains(complaint(std::string(square) + "objectives: [min summary.latency_us.mean]"),
                      "none of the first 20 points has a value of 'summary.latency_us.mean'"));
}

BOOST_AUTO_TEST_SUITE_END()
