#include <study/pareto.h>
#include <study/results.h>
#include <study/sensitivity.h>

#include <algorithm>
#include <utility>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::study;
namespace result = platform::result;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

/// Those of a feasible point.
result::Metrics feasible(std::vector<std::pair<std::string, double>> figures) {
  for (const char* part : platform::result::verdict_parts)
    figures.emplace_back("verdict." + std::string(part) + ".holds", 1);
  return result::Metrics(std::move(figures));
}

/// FPS and watts of five points, one of which failed.
Results example() {
  Results results;
  results.manifest.name = "example";
  results.manifest.swept = {"clock"};
  const double fps[] = {50, 100, 150, 90};
  const double watts[] = {1, 1.1, 3, 2};
  for (int i = 0; i < 4; ++i) {
    ResultRow row;
    row.key = std::to_string(i);
    row.swept = {{"clock", std::to_string(50 * (i + 1)) + " MHz"}};
    row.metrics = feasible({{"fps", fps[i]}, {"watts", watts[i]}});
    results.rows.push_back(row);
  }
  ResultRow failed;
  failed.failed = true;
  failed.swept = {{"clock", "1 MHz"}};
  results.rows.push_back(failed);
  return results;
}

/// The same with a constraint more.
Results with(Results results, const std::string& constraint) {
  results.constraints.emplace_back(constraint, "here");
  return results;
}

std::vector<Objective> fps_and_watts() {
  return {Objective("max fps", "here"), Objective("min watts", "here")};
}

std::string csv_of(const Results& results, const std::vector<Objective>& objectives,
                   const Pareto& pareto) {
  const kit::TemporaryFolder folder;
  write_pareto_csv(folder / "pareto.csv", results, objectives, pareto);
  return kit::read_file(folder / "pareto.csv");
}

}  // namespace

BOOST_AUTO_TEST_SUITE(analysis)

BOOST_AUTO_TEST_CASE(objectives_say_which_way_is_better) {
  BOOST_TEST(Objective("max a / b", "x").maximise());
  BOOST_TEST(!Objective("min a", "x").maximise());
  for (const char* wrong : {"a", "maximum a", "max ", ""})
    BOOST_TEST(contains(complaint([&] { Objective(wrong, "x"); }), "max METRIC"), wrong);
}

BOOST_AUTO_TEST_CASE(fronts_are_peeled_one_by_one) {
  const std::vector<std::size_t> front =
      fronts({{1, 1}, {2, 2}, {3, 3}, {2, 4}, {2, 2}}, {true, false});
  BOOST_TEST(front == (std::vector<std::size_t>{1, 1, 1, 2, 1}), boost::test_tools::per_element());
}

// Taken away one by one, as slowly as fronts are defined.
BOOST_AUTO_TEST_CASE(fronts_are_those_of_the_definition) {
  std::uint32_t seed = 1;
  const auto draw = [&] { return static_cast<double>((seed = seed * 1664525 + 1013904223) >> 29); };
  for (const std::vector<bool>& maximise :
       {std::vector<bool>{true}, {true, false}, {false, false, true}}) {
    std::vector<std::vector<double>> figures(60);
    for (auto& point : figures) {
      for (std::size_t i = 0; i < maximise.size(); ++i) point.push_back(draw());
    }
    const auto beats = [&](const std::vector<double>& a, const std::vector<double>& b) {
      for (std::size_t i = 0; i < maximise.size(); ++i) {
        if (maximise[i] ? a[i] < b[i] : a[i] > b[i]) return false;
      }
      return a != b;
    };
    const std::vector<std::size_t> front = fronts(figures, maximise);
    std::vector<std::size_t> left(figures.size(), 0);
    for (std::size_t number = 1; std::count(left.begin(), left.end(), 0u) != 0; ++number) {
      std::vector<std::size_t> now = left;
      for (std::size_t i = 0; i < figures.size(); ++i) {
        bool beaten = left[i] != 0;
        for (std::size_t j = 0; j < figures.size(); ++j)
          beaten = beaten || (left[j] == 0 && beats(figures[j], figures[i]));
        if (!beaten) now[i] = number;
      }
      left = now;
    }
    BOOST_TEST(front == left, boost::test_tools::per_element());
  }
}

// A point loses to one that is better in one objective and equal in the others.
BOOST_AUTO_TEST_CASE(equal_in_one_objective_and_better_in_another_dominates) {
  using Fronts = std::vector<std::size_t>;
  BOOST_TEST(fronts({{1, 1}, {1, 2}}, {true, true}) == (Fronts{2, 1}),
             boost::test_tools::per_element());
  BOOST_TEST(fronts({{1, 1}, {1, 2}}, {true, false}) == (Fronts{1, 2}),
             boost::test_tools::per_element());
  BOOST_TEST(fronts({{5, 1}, {4, 1}, {3, 1}}, {false, true}) == (Fronts{3, 2, 1}),
             boost::test_tools::per_element());
  BOOST_TEST(fronts({{1, 1}, {1, 1}}, {true, true}) == (Fronts{1, 1}),
             boost::test_tools::per_element());
}

// Of a fifth of the range in each and of everything in one, it is the former that beats it in all.
BOOST_AUTO_TEST_CASE(what_beats_a_point_is_named_with_by_how_much) {
  Results results = example();
  const double fps[] = {50, 100, 150, 90};
  const double watts[] = {2, 1, 3, 2};
  for (int i = 0; i < 4; ++i)
    results.rows[i].metrics = feasible({{"fps", fps[i]}, {"watts", watts[i]}});
  Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST(!pareto.points[0].better);  // not asked for yet
  find_better(pareto, fps_and_watts());
  BOOST_TEST(pareto.points[0].better.value() == 1u);  // the one with 150 takes more
  BOOST_TEST(!pareto.points[1].better);
  BOOST_TEST(!pareto.points[2].better);
  BOOST_TEST(pareto.points[3].better.value() == 1u);
  const std::string csv = csv_of(results, fps_and_watts(), pareto);
  BOOST_TEST(contains(csv, ",max fps,min watts,better,better by fps,better by watts\n"), csv);
  BOOST_TEST(contains(csv, ",50,2,1,50,1\n"), csv);
  BOOST_TEST(contains(csv, ",90,2,1,10,1\n"), csv);
  BOOST_TEST(contains(csv, ",100,1,,,\n"), csv);

  const std::vector<Objective> both_up{Objective("max fps", "x"), Objective("max watts", "x")};
  for (int i = 0; i < 4; ++i)
    results.rows[i].metrics =
        feasible({{"fps", i < 3 ? 20.0 + 40 * i : 20}, {"watts", i < 3 ? 100 - 40.0 * i : 10}});
  pareto = rank(results, both_up);
  find_better(pareto, both_up);
  BOOST_TEST(pareto.points[3].better.value() == 1u);  // (60, 60), not (20, 100) or (100, 20)
}

// A third and two thirds on the way are equally far from the best of everything.
BOOST_AUTO_TEST_CASE(of_equally_good_knees_the_first_is_taken) {
  Results results = example();
  for (int i = 0; i < 4; ++i)
    results.rows[i].metrics = feasible({{"fps", 10.0 * i}, {"watts", 1.0 * i}});
  BOOST_TEST(rank(results, fps_and_watts()).knee.value() == 1u);
  std::swap(results.rows[1], results.rows[2]);
  BOOST_TEST(rank(results, fps_and_watts()).knee.value() == 1u);
}

BOOST_AUTO_TEST_CASE(a_front_of_two_has_no_knee) {
  Results results = example();
  results.rows.resize(2);  // (50, 1 W) and (100, 1.1 W)
  const Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST(pareto.points[0].front == 1u);
  BOOST_TEST(pareto.points[1].front == 1u);
  BOOST_TEST(!pareto.knee.has_value());
}

BOOST_AUTO_TEST_CASE(the_table_of_a_front_begins_with_the_best) {
  Results results = example();
  std::swap(results.rows[0], results.rows[2]);
  const std::string table = pareto_table(results, fps_and_watts(), rank(results, fps_and_watts()));
  BOOST_TEST(table.find("150 MHz") < table.find("100 MHz"), table);
  BOOST_TEST(table.find("100 MHz") < table.find("\n 50 MHz"), table);
  BOOST_TEST(table.find("200 MHz") == std::string::npos, "not on the front");
}

// Distances are in parts of what the front spans: 40 of 100 frames/s away is nearer than 0.5 of
// 1 W.
BOOST_AUTO_TEST_CASE(the_knee_measures_in_parts_of_the_front) {
  Results results = example();
  const double fps[] = {100, 160, 200, 140}, watts[] = {1, 1.4, 2, 1.35};
  for (int i = 0; i < 4; ++i) {
    results.rows[i].metrics = feasible({{"fps", fps[i]}, {"watts", watts[i]}, {"same", 7}});
  }
  const Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST(pareto.points[3].front == 1u);
  BOOST_TEST(pareto.knee.value() == 1u);
  std::vector<Objective> objectives = fps_and_watts();
  objectives.emplace_back("max same", "here");
  BOOST_TEST(rank(results, objectives).knee.value() == 1u, "what is equal everywhere");
}

BOOST_AUTO_TEST_CASE(the_knee_is_near_the_best_of_everything) {
  const Results results = example();
  const Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST(pareto.points.size() == 4u);
  BOOST_TEST(pareto.points[3].front == 2u);
  BOOST_REQUIRE(pareto.knee.has_value());
  BOOST_TEST(*pareto.knee == 1u);
  BOOST_TEST(contains(pareto_table(results, fps_and_watts(), pareto), "knee"));
}

// The verdict of each point: feasible, unknown timing, no marker, and what ran before there were
// verdicts.
BOOST_AUTO_TEST_CASE(only_feasible_points_are_ranked) {
  using platform::result::Holds;
  Results results = example();
  const double timing[] = {1, 0.5, 1, 1}, job[] = {1, 1, 0, 1};
  for (int i = 0; i < 4; ++i) {
    std::vector<std::pair<std::string, double>> figures{
        {"fps", *results.rows[i].metrics.find("fps")},
        {"watts", *results.rows[i].metrics.find("watts")},
        {"verdict.fits.holds", 1},
        {"verdict.clocks.holds", 1}};
    if (i < 3) {
      figures.insert(figures.end(), {{"verdict.ran.holds", 1},
                                     {"verdict.job.holds", job[i]},
                                     {"verdict.timing.holds", timing[i]}});
    }
    results.rows[i].metrics = result::Metrics(std::move(figures));
  }
  const Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST((pareto.points[0].feasible == Holds::yes));
  BOOST_TEST(pareto.points[0].front == 1u);
  BOOST_TEST((pareto.points[1].feasible == Holds::unknown));
  BOOST_TEST((pareto.points[2].feasible == Holds::no));
  BOOST_TEST((pareto.points[3].feasible == Holds::unknown));
  for (const int i : {1, 2, 3}) BOOST_TEST(pareto.points[i].front == 0u);
  BOOST_TEST(contains(csv_of(results, fps_and_watts(), pareto), "1,0,0,unknown,,100 MHz"));
  BOOST_TEST(verdicts_text(results) ==
             "1 of 5 points feasible, 1 did not run, 1 did not do their job, 2 unknown");
  // A constraint that does not hold is one reason more, for all alike.
  const Results bounded = with(results, "fps > 60");
  BOOST_TEST((bounded.feasible(bounded.rows[0]) == Holds::no));
  BOOST_TEST((rank(bounded, fps_and_watts()).points[0].front == 0u));
  BOOST_TEST(contains(complaint([&] { sensitivity(bounded, vp::Expression("fps", "here")); }),
                      "0 of 5 points feasible"));
  BOOST_TEST((with(results, "fps < 60").feasible(results.rows[1]) == Holds::no));
  // Sensitivity, too.
  BOOST_TEST(contains(complaint([&] { sensitivity(results, vp::Expression("fps", "here")); }),
                      "1 of 5 points feasible"));
  BOOST_TEST(sensitivity(results, vp::Expression("fps", "here"), true).skipped == 1u);
}

BOOST_AUTO_TEST_CASE(a_study_may_ask_for_another_job) {
  using platform::result::Holds;
  Results results = example();
  results.job.emplace("fps >= 100", "here");
  BOOST_TEST((results.feasible(results.rows[0]) == Holds::no));
  BOOST_TEST((results.feasible(results.rows[1]) == Holds::yes));
  BOOST_TEST((results.holds(results.rows[4], "job") == Holds::unknown));
  BOOST_TEST((results.feasible(results.rows[4]) == Holds::no));
  BOOST_TEST(rank(results, fps_and_watts()).points[0].front == 0u);
  results.rows[0].complaints = {{"job", "1 of 1 frame without a result"}, {"fits", "too big"}};
  BOOST_TEST(results.reasons(results.rows[0]) ==
                 (std::vector<std::string>{"too big", "not its job: fps >= 100"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(constraints_take_points_out) {
  const Results results = with(example(), "clock >= 150 MHz");
  const Pareto pareto = rank(results, fps_and_watts());
  BOOST_TEST((pareto.points[0].feasible == platform::result::Holds::no));
  BOOST_TEST(
      results.reasons(results.rows[0]) == std::vector<std::string>{"breaks clock >= 150 MHz"},
      boost::test_tools::per_element());
  BOOST_TEST(pareto.points[2].front == 1u);
  BOOST_TEST(pareto.points[3].front == 1u);
  BOOST_TEST(
      contains(complaint([&] { check_names(results, Objective("max fsp", "here").figure()); }),
               "did you mean 'fps'"));
}

// 150 frames/s are nearer to 200 than 100 are; what breaks nothing else is nearer still.
BOOST_AUTO_TEST_CASE(what_no_point_meets_is_told_with_the_nearest) {
  Results results = with(with(example(), "fps >= 200"), "watts < 5");
  results.manifest.swept = {"clock"};
  BOOST_TEST(why_no_point(results) ==
             "no point is feasible: 0 of 5 points feasible, 1 did not run, 4 break a constraint; "
             "'fps >= 200' rules out 4 of 4; the nearest is clock = 150 MHz: breaks fps >= 200 "
             "(fps = 150)");
  results.rows[2].metrics = feasible({{"fps", 150}});  // no watts
  BOOST_TEST(contains(why_no_point(results),
                      "'watts < 5' rules out 1 of 4; the nearest is clock = "
                      "100 MHz"),
             why_no_point(results));
  for (ResultRow& row : results.rows) row.failed = true;
  BOOST_TEST(why_no_point(results) == "the sweep has no point with a result");
}

/// The example, whose second point found no marker: it has no error.
Results without_marker() {
  Results results = example();
  const double error[] = {5, 0, 2, 4};
  for (int i = 0; i < 4; ++i) {
    ResultRow& row = results.rows[i];
    if (i == 1) continue;
    row.metrics = feasible({{"fps", *row.metrics.find("fps")},
                            {"watts", *row.metrics.find("watts")},
                            {"error", error[i]}});
  }
  return results;
}

BOOST_AUTO_TEST_CASE(a_point_without_a_metric_is_left_out_and_counted) {
  const Results results = without_marker();
  const std::vector<Objective> objectives{Objective("max fps", "here"),
                                          Objective("min error", "here")};
  const Pareto pareto = rank(results, objectives);
  BOOST_TEST(pareto.points.size() == 4u);
  BOOST_TEST(pareto.points[1].figures.empty());
  BOOST_TEST(pareto.points[1].front == 0u);
  BOOST_TEST(pareto.points[2].front == 1u);
  BOOST_TEST(pareto.points[3].front == 2u);
  BOOST_TEST((pareto.lacking == std::map<std::string, std::uint64_t>{{"error", 1}}));
  BOOST_TEST(contains(csv_of(results, objectives, pareto), "1,0,0,yes,,100 MHz,,,,,\n"),
             csv_of(results, objectives, pareto));
  BOOST_TEST(!contains(pareto_table(results, objectives, pareto), "100 MHz"));
  // Without the objective it is ranked; a constraint on what it lacks is not met.
  BOOST_TEST(rank(results, fps_and_watts()).points[1].front == 1u);
  const Results with_bound = with(results, "not error > 100");
  const Pareto bounded = rank(with_bound, fps_and_watts());
  BOOST_TEST((bounded.points[1].feasible == platform::result::Holds::no));
  BOOST_TEST((bounded.points[2].feasible == platform::result::Holds::yes));
  BOOST_TEST(bounded.lacking.at("error") == 1u);
  BOOST_TEST(
      contains(complaint([&] { check_names(results, Objective("max eror", "here").figure()); }),
               "did you mean 'error'"));
}

BOOST_AUTO_TEST_CASE(sensitivity_leaves_out_points_without_the_figure) {
  Results results = without_marker();
  const vp::Expression error("error", "here");
  const SensitivityReport effects = sensitivity(results, error);
  BOOST_TEST(effects.method == "all else equal");
  BOOST_TEST(effects.skipped == 2u);  // and the one that failed
  BOOST_TEST(effects.rows.at(0).low == 2);
  BOOST_TEST(effects.rows.at(0).high == 5);
  results.manifest.sampling = "morris";
  results.manifest.effects = {{"0", "1", "clock", 0.5}, {"0", "2", "clock", 0.5}};
  const SensitivityReport morris = sensitivity(results, error);
  BOOST_TEST(morris.skipped == 1u);
  BOOST_TEST(morris.rows.at(0).mean == -6);
  results.manifest.sampling = "one-at-a-time";
  results.manifest.effects = {{"1", "0", "clock", 0}};
  BOOST_TEST(contains(complaint([&] { sensitivity(results, error); }), "has no 'error'"));
  results.manifest.effects = {{"0", "1", "clock", 0}, {"0", "2", "clock", 0}};
  BOOST_TEST(sensitivity(results, error).skipped == 1u);
  BOOST_TEST(contains(complaint([&] { sensitivity(results, vp::Expression("eror", "here")); }),
                      "did you mean 'error'"));
}

BOOST_AUTO_TEST_CASE(elementary_effects_are_averaged) {
  Results results = example();
  results.manifest.sampling = "morris";
  results.manifest.effects = {{"0", "1", "clock", 0.5}, {"3", "1", "clock", -0.5}};
  const SensitivityReport report = sensitivity(results, vp::Expression("fps", "here"));
  BOOST_REQUIRE(report.rows.size() == 1u);
  BOOST_TEST(report.rows[0].mean == 40);  // 100 and -20
  BOOST_TEST(report.rows[0].mean_size == 60);
  BOOST_TEST(report.rows[0].count == 2u);
}

BOOST_AUTO_TEST_CASE(a_tornado_has_low_and_high) {
  Results results = example();
  results.manifest.sampling = "one-at-a-time";
  results.manifest.effects = {{"1", "0", "clock", 0}, {"1", "2", "clock", 0}};
  const SensitivityReport report = sensitivity(results, vp::Expression("fps", "here"));
  BOOST_TEST(contains(report.basis, "base 100"));
  BOOST_TEST(report.rows.at(0).low == 50);
  BOOST_TEST(report.rows.at(0).high == 150);
  BOOST_TEST(report.rows.at(0).high_at == "150 MHz");
}

namespace {

/// Points of a search: a figure that follows from `speed` alone, at values of speed and `idle`.
Results searched(const std::vector<std::pair<int, int>>& points) {
  Results results;
  results.manifest.name = "searched";
  results.manifest.sampling = "search";
  results.manifest.swept = {"speed", "idle"};
  for (const auto& [speed, idle] : points) {
    ResultRow row;
    row.key = std::to_string(results.rows.size());
    row.swept = {{"speed", std::to_string(speed)}, {"idle", std::to_string(idle)}};
    row.metrics = feasible({{"fps", 10.0 * speed}});
    results.rows.push_back(row);
  }
  return results;
}

}  // namespace

// The search has looked where both are large: means over idle's values would be 10 and 35.
BOOST_AUTO_TEST_CASE(a_parameter_without_effect_has_none_in_a_biased_sample) {
  const SensitivityReport report =
      sensitivity(searched({{1, 1}, {3, 2}, {4, 2}, {3, 1}}), vp::Expression("fps", "here"));
  BOOST_TEST(contains(report.basis, "points of a search"));
  BOOST_REQUIRE(report.rows.size() == 2u);
  BOOST_TEST(report.rows[0].path == "speed");
  BOOST_TEST(report.rows[0].count == 2u);
  BOOST_TEST(report.rows[0].mean_size == 15);  // of 20 and 10
  BOOST_TEST(report.rows[0].low == 10);
  BOOST_TEST(report.rows[0].high == 30);
  BOOST_TEST(report.rows[0].low_at == "1");
  BOOST_TEST(report.rows[0].high_at == "3");
  BOOST_TEST(report.rows[1].path == "idle");
  BOOST_TEST(report.rows[1].count == 1u);
  BOOST_TEST(report.rows[1].size() == 0);
  const std::string table = sensitivity_table(report);
  BOOST_TEST(contains(table, "mean change  comparisons"), table);
  const Json json =
      sensitivity_json(searched({{1, 1}, {3, 2}, {3, 1}}), vp::Expression("fps", "here"));
  BOOST_TEST(json["rows"][0].dump() ==
             R"({"path":"speed","count":1,"size":20.0,"low":10.0,"low_at":"1","high":30.0,)"
             R"("high_at":"3"})");
}

BOOST_AUTO_TEST_CASE(of_what_no_two_points_show_nothing_is_said) {
  const vp::Expression fps("fps", "here");
  const Results some = searched({{1, 1}, {2, 1}, {3, 2}});
  const SensitivityReport report = sensitivity(some, fps);
  BOOST_TEST(report.rows.size() == 1u);
  BOOST_TEST((report.not_compared == std::vector<std::string>{"idle"}));
  BOOST_TEST(contains(not_compared_text(report), "said of it: idle; 'markervp sensitivity --at"));
  // With none at all, it is refused, and the page says why.
  const Results none = searched({{1, 1}, {2, 2}, {3, 3}});
  const std::string problem = complaint([&] { sensitivity(none, fps); });
  BOOST_TEST(contains(problem, "said of it: speed, idle; 'markervp sensitivity --at"), problem);
  BOOST_TEST(sensitivity_json(none, fps)["rows"].empty());
  BOOST_TEST(contains(sensitivity_json(none, fps)["note"].get<std::string>(), "makes a sweep"));
}

BOOST_AUTO_TEST_CASE(parameters_that_move_together_are_compared_together) {
  Results results = searched({{1, 1}, {2, 2}, {3, 3}});
  results.manifest.zipped = {{"speed", "idle"}};
  const SensitivityReport report = sensitivity(results, vp::Expression("fps", "here"));
  BOOST_REQUIRE(report.rows.size() == 1u);
  BOOST_TEST(report.rows[0].path == "speed+idle");
  BOOST_TEST(report.rows[0].size() == 20);
  BOOST_TEST(report.rows[0].high_at == "3 / 3");
}

BOOST_AUTO_TEST_SUITE_END()
