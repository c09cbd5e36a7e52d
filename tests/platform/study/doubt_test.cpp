// What error bands leave of an order of points.
#include <study/doubt.h>
#include <study/pareto.h>

#include <boost/test/unit_test.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::study;
using platform::result::Holds;
using sweep_test::contains;
namespace result = platform::result;

namespace {

ResultRow row(std::vector<std::pair<std::string, double>> figures) {
  ResultRow made;
  for (const char* part : result::verdict_parts)
    figures.emplace_back("verdict." + std::string(part) + ".holds", 1);
  made.metrics = result::Metrics(std::move(figures));
  return made;
}

/// Frames a second, and watts with a band of 10 % to each side.
Results results_of(const std::vector<std::pair<double, double>>& points) {
  Results results;
  results.manifest.name = "example";
  for (const auto& [fps, watts] : points) {
    results.rows.push_back(
        row({{"fps", fps}, {"w.low", 0.9 * watts}, {"w.nominal", watts}, {"w.high", 1.1 * watts}}));
  }
  return results;
}

std::vector<Objective> objectives() {
  return {Objective("max fps", "here"), Objective("min w.nominal", "here")};
}

Pareto judged(const Results& results) {
  Pareto pareto = rank(results, objectives());
  judge_by_bands(pareto, objectives());
  return pareto;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(doubt)

BOOST_AUTO_TEST_CASE(a_figure_lies_between_the_ends_of_its_bands) {
  const ResultRow point =
      row({{"fps", 50}, {"w.low", 1}, {"w.nominal", 2}, {"w.high", 4}, {"x.nominal", 3}});
  const auto span = [&](const char* text) { return *span_in(point, vp::Expression(text, "here")); };
  BOOST_TEST(span("w.nominal").low == 1.0);
  BOOST_TEST(span("w.nominal").high == 4.0);
  BOOST_TEST(span("fps / w.nominal").low == 12.5);
  BOOST_TEST(span("fps / w.nominal").high == 50.0);
  BOOST_TEST(span("x.nominal - fps").low == span("x.nominal - fps").high);  // x has no band
  BOOST_TEST(!span_in(point, vp::Expression("nothing", "here")));
  BOOST_TEST(band_of("w.nominal").at(1) == "w.high");
  BOOST_TEST(band_of("nominal").empty());
  BOOST_TEST(band_of("w.low").empty());
}

// 5 % apart is less than the bands, 50 % is more.
BOOST_AUTO_TEST_CASE(what_is_better_by_less_than_the_bands_is_better_perhaps) {
  const Results results = results_of({{100, 2}, {100, 2.1}, {90, 3}, {200, 2.05}});
  const Pareto pareto = judged(results);
  BOOST_TEST(pareto.has_bands);
  BOOST_TEST(pareto.points[0].front == 1u);
  BOOST_TEST((pareto.points[0].dominated == Holds::unknown));  // the last may take less, too
  BOOST_TEST(pareto.points[1].front == 2u);
  BOOST_TEST((pareto.points[1].dominated == Holds::unknown));
  BOOST_TEST((pareto.points[2].dominated == Holds::yes));
  BOOST_TEST((pareto.points[3].dominated == Holds::no));
  BOOST_TEST(doubt_text(pareto) ==
             "By the bands of the figures 1 of 2 points on the front can be beaten by no other; of "
             "2 behind it 1 is worse for sure");
  BOOST_TEST(contains(pareto_table(results, objectives(), pareto), "for sure"));
  const kit::TemporaryFolder folder;
  write_pareto_csv(folder / "pareto.csv", results, objectives(), pareto);
  const std::string csv = kit::read_file(folder / "pareto.csv");
  BOOST_TEST(contains(csv, "key,front,knee,feasible,dominated,"), csv);
  BOOST_TEST(contains(csv, ",2,0,yes,unknown,100,2.1"), csv);
}

BOOST_AUTO_TEST_CASE(without_bands_an_order_is_sure) {
  Results results = results_of({{100, 2}, {90, 3}});
  for (ResultRow& each : results.rows)
    each =
        row({{"fps", *each.metrics.find("fps")}, {"w.nominal", *each.metrics.find("w.nominal")}});
  const Pareto pareto = judged(results);
  BOOST_TEST(!pareto.has_bands);
  BOOST_TEST(doubt_text(pareto) == "");
  BOOST_TEST((pareto.points[0].dominated == Holds::no));
  BOOST_TEST((pareto.points[1].dominated == Holds::yes));
  BOOST_TEST(!rank(results, objectives()).points[0].dominated);
}

// Compared with all pairs, as slowly as it is defined.
BOOST_AUTO_TEST_CASE(it_is_that_of_the_definition) {
  std::uint32_t seed = 7;
  const auto draw = [&] { return static_cast<double>((seed = seed * 1664525 + 1013904223) >> 29); };
  for (const std::vector<bool>& maximise :
       {std::vector<bool>{false}, {true, false}, {true, true}, {false, true, true}}) {
    std::vector<std::vector<Span>> points(80);
    for (std::vector<Span>& point : points) {
      for (std::size_t k = 0; k < maximise.size(); ++k) {
        const double low = draw();
        point.push_back({low, low + (draw() < 4 ? draw() : 0)});
      }
    }
    const std::vector<Holds> found = surely_dominated(points, maximise);
    const auto end = [&](std::size_t i, bool better) {
      std::vector<double> figures;
      for (std::size_t k = 0; k < maximise.size(); ++k)
        figures.push_back(maximise[k] == better ? points[i][k].high : points[i][k].low);
      return figures;
    };
    std::set<Holds> seen;
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool surely = false, possibly = false;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (j == i) continue;
        surely = surely || dominates(end(j, false), end(i, true), maximise);
        possibly = possibly || dominates(end(j, true), end(i, false), maximise);
      }
      const Holds expected = surely ? Holds::yes : possibly ? Holds::unknown : Holds::no;
      BOOST_TEST((found[i] == expected), i << " of " << maximise.size());
      seen.insert(expected);
    }
    BOOST_TEST(seen.size() > 1u);
  }
}

BOOST_AUTO_TEST_SUITE_END()
