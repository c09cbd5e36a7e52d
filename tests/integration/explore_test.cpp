#include <csignal>

#include "sweeps.h"

using namespace sweep_test;

namespace {

/// 1024 points, of which a search looks at 60.
constexpr const char* space = R"(
parameters:
  ps.fclk_clk1.frequency: {start: 20 MHz, stop: 66.5 MHz, step: 1.5 MHz}
  ps.cpu_clk.frequency: {start: 100 MHz, stop: 720 MHz, step: 20 MHz}
constraints: [summary.fps.mean >= 50]
objectives: [max summary.fps.mean, min summary.energy_per_frame_mj]
search: {points: 60, generation: 12}
)";

void same_results(const Sweeps& sweeps, const std::string& one, const std::string& other) {
  BOOST_TEST((sweeps.computations(one) == sweeps.computations(other)));
  for (const char* file : {"/manifest.json", "/points.csv", "/sweep.csv"}) {
    BOOST_TEST((kit::read_file(sweeps / (one + file)) == kit::read_file(sweeps / (other + file))),
               file);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(explorations)

BOOST_FIXTURE_TEST_CASE(a_search_does_not_depend_on_the_number_of_processes, Sweeps) {
  write("s.yaml", space);
  const kit::Outcome one = run({"explore", "s.yaml", "--jobs", "1", "--output", "one"});
  BOOST_TEST(one.exit_code == 0, one.err);
  BOOST_TEST(contains(one.out, "The search looked at 60 of 1024 points"), one.out);
  BOOST_TEST(contains(one.out, " front\n"), one.out);
  run({"explore", "s.yaml", "--jobs", "3", "--output", "three"});
  run({"explore", "s.yaml", "--isolate", "--no-report", "--output", "isolated"});
  BOOST_TEST(count_points("one") == 60u);
  same_results(*this, "one", "three");
  same_results(*this, "one", "isolated");
  // A sweep's tools know it.
  BOOST_TEST(run({"pareto", "one"}).exit_code == 0);
  BOOST_TEST(
      contains(run({"explore", "s.yaml", "--output", "one"}).out, "0 computed now, 60 there"));
}

BOOST_FIXTURE_TEST_CASE(a_search_that_was_stopped_leaves_a_front_and_goes_on, Sweeps) {
  write("s.yaml", space);
  const std::vector<std::string> long_search{"explore", "s.yaml", "--points", "400",
                                             "--jobs",  "1",      "--output", "stopped"};
  kit::ChildProcess search(MARKERVP_EXECUTABLE, long_search, path());
  wait_until([&] { return count_points("stopped") >= 20 || search.ended(); });
  search.send(SIGINT);
  const kit::Outcome stopped = search.wait();
  BOOST_TEST(stopped.exit_code == 130);
  BOOST_TEST(contains(stopped.err, "the same command continues"), stopped.err);
  BOOST_TEST(contains(stopped.out, "ended: interrupted"), stopped.out);
  BOOST_TEST(run({"pareto", "stopped"}).exit_code == 0);
  const std::size_t before = count_points("stopped");
  {
    kit::ChildProcess killed(MARKERVP_EXECUTABLE, long_search, path());
    wait_until([&] { return count_points("stopped") >= before + 5 || killed.ended(); });
    killed.send(SIGKILL);
    killed.wait();
  }
  run(long_search);
  std::vector<std::string> at_once = long_search;
  at_once.back() = "at-once";
  run(at_once);
  same_results(*this, "stopped", "at-once");
  for (const auto& [key, count] : computations("stopped")) BOOST_TEST(count == 1, key);
}

// 150 frames a second of 640x480 are more than this software does within timing.
BOOST_FIXTURE_TEST_CASE(where_nothing_is_feasible_it_says_what_would_have_to_give_way, Sweeps) {
  std::string text(space);
  text.replace(text.find(">= 50"), 5, ">= 150");
  write("s.yaml", text + "set: {pl.height: 480 px}\n");
  const kit::Outcome outcome = run({"explore", "s.yaml", "--jobs", "2"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "no point is feasible"), outcome.out);
  BOOST_TEST(contains(outcome.out, "'summary.fps.mean >= 150' gives way to summary.fps.mean = "),
             outcome.out);
  BOOST_TEST(contains(kit::read_file(*this / "out/s/manifest.json"), "gives way to"));
}

BOOST_FIXTURE_TEST_CASE(at_most_means_at_most_where_nothing_is_feasible, Sweeps) {
  std::string text(space);
  text.replace(text.find(">= 50"), 5, ">= 900");
  write("s.yaml", text);
  const kit::Outcome outcome = run({"explore", "s.yaml", "--points", "16", "--jobs", "2"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(count_points("out/s") == 16u);
  BOOST_TEST(contains(outcome.out, "The search looked at 16 of 1024 points"), outcome.out);
  // No time, no point.
  const kit::Outcome late = run({"explore", "s.yaml", "--time", "1ns", "--output", "late"});
  BOOST_TEST(late.exit_code == 0, late.err);
  BOOST_TEST(count_points("late") == 0u);
  BOOST_TEST(contains(late.out, "ended: its time is up"), late.out);
}

// The design has no logic for FCLK_CLK1 to clock: whatever the search looks at, it moves no figure.
BOOST_FIXTURE_TEST_CASE(what_a_design_does_not_use_moves_nothing_after_a_search, Sweeps) {
  write("s.yaml",
        "set: {design: ps-only}\n"
        "parameters:\n"
        "  ps.fclk_clk1.frequency: [25 MHz, 40 MHz, 50 MHz, 60 MHz]\n"
        "  ps.cpu_clk.frequency: {start: 300 MHz, stop: 660 MHz, step: 60 MHz}\n"
        "objectives: [min power.total_w.nominal, max summary.fps.mean]\n"
        "search: {points: 20, generation: 10}\n");
  BOOST_TEST_REQUIRE(run({"explore", "s.yaml"}).exit_code == 0);
  const kit::Outcome outcome = run({"sensitivity", "out/s"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "all else equal: points of a search"), outcome.out);
  const std::string csv = kit::read_file(*this / "out/s/sensitivity.csv");
  BOOST_TEST(contains(csv, ",all else equal,ps.cpu_clk.frequency,"), csv);
  const std::size_t row = csv.find("power.total_w.nominal,all else equal,ps.fclk_clk1.frequency,");
  BOOST_REQUIRE(row != std::string::npos);
  const std::string line = csv.substr(row, csv.find('\n', row) - row);
  // count, mean_size
  const std::string rest = line.substr(line.find("frequency,") + 10);
  BOOST_TEST(std::stoi(rest) > 0, line);
  BOOST_TEST(contains(rest.substr(rest.find(',')), ",0,"), line);
}

BOOST_FIXTURE_TEST_CASE(a_point_tells_what_each_step_is_worth, Sweeps) {
  write("s.yaml",
        "parameters:\n"
        "  ps.fclk_clk1.frequency: [25 MHz, 40 MHz, 50 MHz]\n"
        "  pl.blob_detection.label_count: [16, 32]\n");
  run({"sweep", "s.yaml"});
  const std::string csv = kit::read_file(*this / "out/s/points.csv");
  const std::string row = csv.substr(0, csv.find(",40 MHz,16"));
  const std::string point = "out/s:" + row.substr(row.rfind('\n') + 1);
  const kit::Outcome outcome = run({"sensitivity", "--at", point});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const std::string steps = kit::read_file(*this / "out/s/steps.csv");
  // Twice the labels cost logic, and no time.
  BOOST_TEST(contains(steps, ",pl.blob_detection.label_count,16,32,0,"), steps);
  BOOST_TEST(contains(steps, ",ps.fclk_clk1.frequency,40 MHz,50 MHz,"), steps);
  BOOST_TEST(contains(steps, ",ps.fclk_clk1.frequency,40 MHz,25 MHz,-"), steps);
  BOOST_TEST(count_points("out/s") == 6u);  // the steps were there
  if (contains(outcome.out, "report.html"))
    BOOST_TEST(contains(kit::read_file(*this / "out/s/report.html"), "\"steps\":{"));
  BOOST_TEST(contains(run({"sensitivity", "--at", point, "--figure", "timing.mett"}).err,
                      "did you mean 'timing.met'"));
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"sensitivity"}, {"sensitivity", "out/s", "--at", point}}) {
    const kit::Outcome refused = run(wrong);
    BOOST_TEST(refused.exit_code == 2);
    BOOST_TEST(contains(refused.err, "name the folder of a sweep, or one of its points"));
  }
  write("t.yaml", "parameters: {sw.margin: [3 px, 4 px]}");
  run({"sweep", "t.yaml", "--output", "out/s"});
  BOOST_TEST(
      contains(run({"sensitivity", "--at", point}).err, "no point of the last sweep or search"));
}

BOOST_FIXTURE_TEST_CASE(mistakes_in_a_search_cost_no_time, Sweeps) {
  const auto problem = [&](const std::string& yaml) {
    write("wrong.yaml", yaml);
    const kit::Outcome outcome = run({"explore", "wrong.yaml"});
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(!std::filesystem::exists(*this / "out/wrong/points.csv"));
    return outcome.err;
  };
  BOOST_TEST(contains(problem("parameters: {sw.margin: [4 px]}"), "nothing to search"));
  const std::string start = "parameters: {sw.margin: [4 px, 5 px]}\n";
  BOOST_TEST(contains(problem(start + "objectives: [max device]"), "this is a text"));
  BOOST_TEST(contains(problem(start + "search: {pionts: 5}"), "did you mean 'points'"));
  BOOST_TEST(contains(problem(start + "constraints: [summary.fps.mean > 9, summary.fps.mean < 8]"),
                      "contradict each other"));
  BOOST_TEST(contains(run({"explore", "nosuch"}).err, "no sweep 'nosuch'"));
}

BOOST_FIXTURE_TEST_CASE(a_dry_run_says_how_large_the_space_is, Sweeps) {
  write("s.yaml", space);
  const kit::Outcome outcome = run({"explore", "s.yaml", "--dry-run", "--points", "7"});
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.out, "1024 points, 7 of them at most; objectives: max summary.fps"),
             outcome.out);
  BOOST_TEST(!std::filesystem::exists(*this / "out"));
}

BOOST_AUTO_TEST_SUITE_END()
