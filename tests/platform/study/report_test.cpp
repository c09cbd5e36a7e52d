#include <study/report.h>

#include "sweep_kit.h"

using namespace platform::study;
namespace result = platform::result;
using sweep_test::contains;

namespace {

result::Metrics judged(double timing, std::vector<std::pair<std::string, double>> figures) {
  for (const char* part : platform::result::verdict_parts)
    figures.emplace_back("verdict." + std::string(part) + ".holds", 1);
  for (auto& [name, value] : figures) {
    if (name == "verdict.timing.holds") value = timing;
  }
  return result::Metrics(std::move(figures));
}

ResultRow point(const std::string& clock, result::Metrics metrics) {
  ResultRow row;
  row.key = "key of " + clock;
  row.swept = {{"pl.clock", clock}, {"same", "1"}};
  row.metrics = std::move(metrics);
  return row;
}

/// Two good points, one that misses timing, one that is too slow, one that failed.
Results example() {
  Results results;
  results.manifest.name = "example";
  results.manifest.title = "Clocks";
  results.manifest.text = "What it teaches.";
  results.manifest.swept = {"pl.clock", "same"};
  results.manifest.objectives = {"max summary.fps.mean", "min power.total_w.nominal"};
  results.constraints.emplace_back("summary.fps.mean >= 60", "example");
  const auto figures = [](double fps, double watts) {
    return std::vector<std::pair<std::string, double>>{{"summary.fps.mean", fps},
                                                       {"power.total_w.nominal", watts}};
  };
  results.rows = {point("50 MHz", judged(1, figures(90, 2))),
                  point("40 MHz", judged(1, figures(50, 1))),
                  point("100 MHz", judged(0, figures(130, 3))),
                  point("55 MHz", judged(1, figures(95, 2.5))), point("0 Hz", {})};
  results.rows[2].complaints = {{"timing", "timing missed by pl.blobs"}};
  results.rows[4].failed = true;
  results.rows[4].failure.message = "it stood";
  return results;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(report)

BOOST_AUTO_TEST_CASE(the_console_shows_the_best_first_and_the_others_apart) {
  BOOST_TEST(sweep_text(example()) == R"(Clocks

pl.clock  fps.mean  total_w.nominal
  55 MHz        95            2.500  front
  50 MHz        90                2  front

Not feasible:

pl.clock  fps.mean  total_w.nominal  why
  40 MHz        50                1  breaks summary.fps.mean >= 60
 100 MHz       130                3  timing missed by pl.blobs

1 point failed: it stood

pl.clock  fps.mean  total_w.nominal
    0 Hz  -         -

2 of 5 points feasible, 1 did not run, 1 miss timing, 1 break a constraint

What it teaches.
)");
}

// As of a manifest that was received from someone else.
BOOST_AUTO_TEST_CASE(control_characters_are_shown_and_command_no_terminal) {
  Results results = example();
  results.manifest.title = "Clocks\x1b[2J\nof all";
  results.manifest.text = "It\x1b]0;t\x07 teaches\nin two lines.";
  results.rows[0].swept = {{"pl.clock", "50\x1b[7m MHz"}, {"same", "1"}};
  results.rows[4].failure.message = "\u202eit stood";
  const std::string text = sweep_text(results);
  BOOST_TEST(contains(text, "Clocks\\x1b[2J\\nof all\n"), text);
  BOOST_TEST(contains(text, "It\\x1b]0;t\\x07 teaches\nin two lines.\n"), text);
  BOOST_TEST(contains(text, "50\\x1b[7m MHz"), text);
  BOOST_TEST(contains(text, "\\u202eit stood"), text);
  BOOST_TEST(text.find('\x1b') == std::string::npos);
}

BOOST_AUTO_TEST_CASE(without_a_feasible_point_the_console_says_why) {
  Results results = example();
  results.constraints.emplace_back("power.total_w.nominal < 1.5", "example");
  const std::string text = sweep_text(results);
  BOOST_TEST(contains(text, "no point is feasible: 0 of 5"), text);
  BOOST_TEST(contains(text, "the nearest is pl.clock = 40 MHz"), text);
}

// A part of the points cannot prove what is said of all.
BOOST_AUTO_TEST_CASE(where_points_are_missing_the_text_of_the_study_is_left_out) {
  Results results = example();
  results.missing = 1;
  BOOST_TEST(!contains(sweep_text(results), "What it teaches"));
  BOOST_TEST(Json::parse(page_block(results, "x"))["text"] == "");
}

BOOST_AUTO_TEST_CASE(the_page_has_the_text_of_the_study_without_line_feeds) {
  Results results = example();
  results.manifest.text = "Fewer is\nbetter.\n";
  BOOST_TEST(Json::parse(page_block(results, "x"))["text"] == "Fewer is better.");
}

BOOST_AUTO_TEST_CASE(more_points_than_fit_are_counted) {
  const std::string text = sweep_text(example(), 1);
  BOOST_TEST(contains(text, "… and 1 point more: see sweep.csv\n\nNot feasible:\n\n… and 2"), text);
}

BOOST_AUTO_TEST_CASE(the_page_has_what_the_console_says) {
  const Results results = example();
  const Json block = Json::parse(page_block(results, "out/x"));
  BOOST_TEST(block["title"] == "Clocks");
  BOOST_TEST(block["folder"] == "out/x");
  BOOST_TEST(block["missing"] == 0);
  BOOST_TEST(block["objectives"] ==
             Json::parse(R"([{"metric":"summary.fps.mean","unit":"1/s","better":1},
                             {"metric":"power.total_w.nominal","unit":"W","better":-1}])"));
  BOOST_TEST(block["constraints"] == Json::parse(R"(["summary.fps.mean >= 60"])"));
  BOOST_TEST(
      block["metrics"] ==
      Json::parse(
          R"([{"path":"summary.fps.mean","title":"Frame rate","unit":"frames/s","factor":1.0,"better":1},
              {"path":"power.total_w.nominal","title":"Power","unit":"W","factor":1.0,"better":-1}])"));
  BOOST_REQUIRE(block["points"].size() == 5u);
  BOOST_TEST(block["points"][0] == Json::parse(R"({"key":"key of 50 MHz","swept":["50 MHz","1"],
    "metrics":[90.0,2.0],"failed":false,"reasons":[],"front":1})"));
  BOOST_TEST(block["points"][1]["front"] == 0);
  BOOST_TEST(block["points"][1]["reasons"] == Json::parse(R"(["breaks summary.fps.mean >= 60"])"));
  BOOST_TEST(block["points"][2]["reasons"] == Json::parse(R"(["timing missed by pl.blobs"])"));
  BOOST_TEST(block["points"][4] == Json::parse(R"({"key":"key of 0 Hz","swept":["0 Hz","1"],
    "metrics":[null,null],"failed":true,"reasons":["failed: it stood"],"front":0})"));
}

BOOST_AUTO_TEST_CASE(the_page_has_what_the_bands_leave_of_the_front) {
  Results results = example();
  results.rows.resize(2);
  results.constraints.clear();
  const auto banded = [](double fps, double watts) {
    return judged(1, {{"summary.fps.mean", fps},
                      {"power.total_w.low", watts - 0.1},
                      {"power.total_w.nominal", watts},
                      {"power.total_w.high", watts + 0.1}});
  };
  const auto dominated = [&](double fps, double watts) {
    results.rows[0].metrics = banded(90, 2);
    results.rows[1].metrics = banded(fps, watts);
    const Json block = Json::parse(page_block(results, "x"));
    BOOST_TEST(block["doubt"].get<std::string>().find("By the bands of the figures") == 0u);
    return block["points"][0]["dominated"].get<std::string>() + " " +
           block["points"][1]["dominated"].get<std::string>();
  };
  BOOST_TEST(dominated(80, 1.5) == "no no");
  BOOST_TEST(dominated(80, 1.95) == "no unknown");
  BOOST_TEST(dominated(80, 2.5) == "no yes");
  BOOST_TEST(!Json::parse(page_block(example(), "x")).contains("doubt"));  // no bands
}

BOOST_AUTO_TEST_CASE(a_page_of_very_many_points_has_the_front_and_some_of_the_others) {
  Results results = example();
  const ResultRow usual = results.rows[1];
  results.rows.resize(4);
  const std::size_t all = 45'003;
  // The front is where a sample of every so many would leave it out.
  const std::vector<std::size_t> best{1, 31'337, all - 1};
  std::vector<ResultRow> rows(all, usual);
  for (std::size_t i = 0; i < all; ++i) rows[i].key = std::to_string(i);
  for (std::size_t i = 0; i < best.size(); ++i) {
    const double better = static_cast<double>(i);
    rows[best[i]].metrics =
        judged(1, {{"summary.fps.mean", 90 + better}, {"power.total_w.nominal", 2 + better}});
  }
  results.rows = rows;
  const Json block = Json::parse(page_block(results, "x"));
  const Json counts{{"points", all}, {"feasible", best.size()}, {"failed", 0}};
  BOOST_TEST(block["counts"] == counts);
  BOOST_TEST_REQUIRE(block["points"].size() == 20'000u);
  std::size_t on_front = 0, before = 0;
  for (const Json& point : block["points"]) {
    const std::size_t place = std::stoul(point["key"].get<std::string>());
    BOOST_TEST((place == 0 || (place > before && place - before <= 4)), place);
    before = place;
    on_front += point["front"] == 1 ? 1 : 0;
  }
  BOOST_TEST(page_block(results, "x", {{"progress", 1}}).find("\"progress\":1") !=
             std::string::npos);
  BOOST_TEST(on_front == best.size());
  BOOST_TEST(Json::parse(page_block(example(), "x"))["counts"] ==
             Json::parse(R"({"points":5,"feasible":2,"failed":1})"));
}

BOOST_AUTO_TEST_CASE(a_point_without_a_verdict_is_not_feasible) {
  Results results = example();
  results.rows[0].metrics = {{"summary.fps.mean", 90}, {"power.total_w.nominal", 2}};
  BOOST_TEST(Json::parse(page_block(results, "x"))["points"][0]["reasons"] ==
             Json::parse(R"(["without a verdict"])"));
}

BOOST_AUTO_TEST_SUITE_END()
