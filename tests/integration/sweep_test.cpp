#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include <marker/report/marker_metrics.h>
#include <result/figures.h>
#include <study/kept_result.h>

#include "sweeps.h"

using namespace sweep_test;

BOOST_AUTO_TEST_SUITE(sweeps)

BOOST_FIXTURE_TEST_CASE(the_page_of_a_sweep_has_all_its_points, Sweeps) {
  write("s.yaml", clocks);
  const std::string page = *this / "out/s/report.html";
  const kit::Outcome first = run({"sweep", "s.yaml", "--limit", "2", "--no-report"});
  BOOST_TEST(first.exit_code == 0);
  BOOST_TEST(!std::filesystem::exists(page));
  BOOST_TEST(!contains(first.out, "report.html"));
  const kit::Outcome second = run({"sweep", "s.yaml"});
  if (!contains(second.out, "report.html to look at")) return;  // built without it
  const std::string text = kit::read_file(page);
  for (const auto& [key, unused] : computations("out/s"))
    BOOST_TEST(contains(text, '"' + key + '"'));
}

BOOST_FIXTURE_TEST_CASE(results_do_not_depend_on_the_number_of_workers, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml", "--jobs", "1", "--output", "one", "--keep-results"});
  run({"sweep", "s.yaml", "--jobs", "3", "--output", "three", "--keep-results"});
  BOOST_TEST(kept("one").size() == 4u);
  BOOST_TEST((kept("one") == kept("three")));
  BOOST_TEST(kit::read_file(*this / "one/sweep.csv") == kit::read_file(*this / "three/sweep.csv"));
}

// A process that computed other points before leaves no trace in a result.
BOOST_FIXTURE_TEST_CASE(results_do_not_depend_on_what_their_process_did_before, Sweeps) {
  write("s.yaml",
        "inputs: [demo]\n"
        "parameters:\n"
        "  system: [hybrid, ps-only]\n"
        "  fidelity: [tlm, clocked]\n"
        "  pl.width: [640 px, 320 px, 600 px]\n"
        "  inputs: [z1.0, squares]\n"
        "  sw.opt: [O0, O2]\n");
  const std::vector<std::string> same{"sweep", "s.yaml", "--no-report", "--keep-results", "--jobs"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = same;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  const kit::Outcome alone = with({"1", "--isolate", "--output", "alone"});
  BOOST_TEST(alone.exit_code == 4, alone.err);  // no image is 600 px wide
  with({"1", "--output", "one"});
  with({"2", "--output", "two"});
  BOOST_TEST(kept("alone").size() > 20u);
  BOOST_TEST((kept("alone") == kept("one")));
  BOOST_TEST((kept("alone") == kept("two")));
  const std::string csv = kit::read_file(*this / "alone/sweep.csv");
  BOOST_TEST(csv == kit::read_file(*this / "one/sweep.csv"));
  // From whole results it is the same as from the shards.
  std::filesystem::remove(*this / "one/sweep.csv");
  std::filesystem::remove_all(*this / "one/runs");
  BOOST_TEST(contains(with({"1", "--output", "one"}).out, " 0 computed now"));
  BOOST_TEST(csv == kit::read_file(*this / "one/sweep.csv"));
}

/// Computes a study and, again, a tenth of its points, always the same, each as a run of its own.
class Tenth : public Sweeps {
 public:
  void equals_runs_of_their_own(const std::string& yaml, std::size_t least_points) const {
    write("s.yaml", yaml);
    const kit::Outcome sweep =
        run({"sweep", "s.yaml", "--no-report", "--jobs", "2", "--keep-results"});
    BOOST_TEST(sweep.exit_code == 0, sweep.err);
    std::vector<std::string> files;
    for (const auto& [file, text] : kept("out/s")) files.push_back(file);
    BOOST_TEST_REQUIRE(files.size() >= least_points);
    std::shuffle(files.begin(), files.end(), std::minstd_rand(18));
    files.resize(files.size() / 10);
    for (const std::string& file : files) equals_run_of_its_own(*this / ("out/s/points/" + file));
  }

 private:
  void equals_run_of_its_own(const std::string& point) const {
    const kit::Outcome alone =
        run({"run", "--point", point, "--no-pictures", "--no-report", "-q", "-o", "alone"});
    BOOST_TEST(alone.exit_code == 0, alone.err);
    Json result = Json::parse(kit::read_file(*this / "alone/result.json"));
    const Json record = Json::parse(kit::read_file(point));
    BOOST_TEST(result["configuration"].dump() == record["identity"]["configuration"].dump());
    for (const char* elsewhere : {"provenance", "configuration"}) result.erase(elsewhere);
    BOOST_TEST(result.dump() == record["outcome"]["result"].dump(), point);
  }
};

// What a process keeps from one point for the next must show nowhere.
BOOST_FIXTURE_TEST_CASE(a_tenth_of_clocks_buffers_and_software_equals_runs_of_their_own, Tenth) {
  equals_runs_of_their_own(
      "inputs: [demo, z1.0]\n"
      "parameters:\n"
      "  ps.fclk_clk1.frequency: {start: 20 MHz, stop: 70 MHz}\n"
      "  ps.cpu_clk.frequency: {start: 200 MHz, stop: 667 MHz}\n"
      "  pl.blob_detection.label_count: [16, 32, 64, 128]\n"
      "  pl.feature_packaging.buffer_depth: [16, 64, 100]\n"
      "  sw.canonical_width: [18 px, 36 px, 60 px]\n"
      "  sw.upload: [0, 1]\n"
      "  sw.opt: [O0, O2]\n"
      "sample: {method: sobol, points: 100}\n",
      90);
}

BOOST_FIXTURE_TEST_CASE(a_tenth_of_designs_devices_and_inputs_equals_runs_of_their_own, Tenth) {
  equals_runs_of_their_own(
      "parameters:\n"
      "  design: [thesis, improved, ps-only]\n"
      "  device: [xc7z010-1, xc7z020-1, xc7z020-3]\n"
      "  profile: [thesis, a9-O2]\n"
      "  power.mode: [activity, vivado-default]\n"
      "  ps.cpu_clk.frequency: {start: 300 MHz, stop: 667 MHz}\n"
      "  inputs: {plain: [demo], noisy: ['demo@noise=0.03,blur=1px'], near: [z1.0, squares]}\n"
      "sample: {method: sobol, points: 60}\n",
      50);
}

BOOST_FIXTURE_TEST_CASE(a_tenth_of_a_study_over_scenes_equals_runs_of_their_own, Tenth) {
  equals_runs_of_their_own(
      "scenes: {base: front7, distance: [1 m, 2 m], noise: [0.007, 0.05]}\n"
      "job: summary.frames > 0\n"
      "parameters:\n"
      "  sw.canonical_width: {start: 18 px, stop: 54 px, step: 9 px}\n"
      "  pl.blob_detection.minimum_side: [8 px, 12 px, 16 px, 24 px]\n",
      20);
}

BOOST_FIXTURE_TEST_CASE(equal_points_are_computed_once, Sweeps) {
  write("s.yaml", "parameters: {ps.fclk_clk1.frequency: [50 MHz, 50000 kHz, 0.05 GHz, 25 MHz]}");
  BOOST_TEST(contains(run({"sweep", "s.yaml", "--output", "d"}).out, "2 points: 2 computed now"));
  // The default, which another sweep had already.
  write("t.yaml", "parameters: {pl.corner_detection.threshold: [30]}");
  BOOST_TEST(contains(run({"sweep", "t.yaml", "--output", "d"}).out, "0 computed now, 1 there"));
}

/// What the version before left: each point's whole result in a file of its own, and no shard.
class OlderFolder : public Sweeps {
 public:
  OlderFolder() {
    write("s.yaml", clocks);
    run({"sweep", "s.yaml", "--keep-results"});
    std::filesystem::remove_all(*this / "out/s/runs");
  }
};

BOOST_FIXTURE_TEST_CASE(points_of_another_version_are_mentioned, OlderFolder) {
  const std::string file = *this / ("out/s/points/" + kept("out/s").begin()->first);
  platform::study::KeptResult older = platform::study::read_kept(file);
  platform::study::Json identity = older.identity_json();
  identity["markervp"]["version"] = "0.0.1";
  older.identity = identity.dump();
  older.key = platform::study::key_of(older.identity);
  std::filesystem::remove(file);
  kit::write_file(*this / ("out/s/points/" + older.key + ".json"),
                  platform::study::kept_text(older));
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(outcome.out, "4 points: 1 computed now, 3 there before"), outcome.out);
  BOOST_TEST(contains(outcome.err, "1 point of another version of the program (0.0.1"),
             outcome.err);
  BOOST_TEST(count_points("out/s") == 4u);
}

BOOST_FIXTURE_TEST_CASE(a_folder_of_the_version_before_is_read_by_every_reader, OlderFolder) {
  const std::string csv = kit::read_file(*this / "out/s/sweep.csv");
  const kit::Outcome pareto = run({"pareto", "out/s"});
  BOOST_TEST(pareto.exit_code == 0, pareto.err);
  BOOST_TEST(contains(pareto.out, "2 of 4 points feasible, 2 miss timing\n"), pareto.out);
  std::filesystem::remove_all(*this / "out/s/runs");
  BOOST_TEST(run({"sensitivity", "out/s"}).exit_code == 0);
  std::filesystem::remove(*this / "out/s/sweep.csv");
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now, 4 there before"));
  BOOST_TEST(kit::read_file(*this / "out/s/sweep.csv") == csv);
}

BOOST_FIXTURE_TEST_CASE(a_whole_result_that_is_missing_is_made_again, OlderFolder) {
  const std::string file = kept("out/s").begin()->first;
  const std::string text = kit::read_file(*this / ("out/s/points/" + file));
  run({"sweep", "s.yaml"});
  std::filesystem::remove(*this / ("out/s/points/" + file));
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now"), "nothing asks for it");
  BOOST_TEST(contains(run({"sweep", "s.yaml", "--keep-results"}).out, "1 computed now, 3 there"));
  BOOST_TEST(kit::read_file(*this / ("out/s/points/" + file)) == text);
}

BOOST_FIXTURE_TEST_CASE(mistakes_cost_no_time, Sweeps) {
  BOOST_TEST(contains(problem("parameters: {ps.fclk_clk1.freqency: [50 MHz]}"),
                      "did you mean 'ps.fclk_clk1.frequency'"));
  BOOST_TEST(contains(problem("parameters: {ps.fclk_clk1.frequency: [50]}"), "no unit"));
  BOOST_TEST(
      contains(problem("parameters: {ps.fclk_clk1.frequency: [50 MHz, 1 Hz]}"), "out of range"));
  BOOST_TEST(contains(problem("parameters: {fidelity: [tlm, clokced]}"), "did you mean 'clocked'"));
  BOOST_TEST(contains(problem("set: {sw.upload: 0}\nparameters: {system: [hybrid, ps-only]}"),
                      "unknown key 'sw.upload'"));
  BOOST_TEST(contains(problem("parameters: {system: [hybrid, ps_only]}"), "no program 'ps_only'"));
  BOOST_TEST(contains(problem("inputs: [nosuch]\nparameters: {sw.margin: [4 px]}"),
                      "no scene, image, folder or video"));
  BOOST_TEST(contains(problem("parameters: {sw.margin: [4 px]}\nconstraints: [sw.margin > 5 px]"),
                      "contradict"));
  BOOST_TEST(contains(problem("parameters: {sw.margin: [4 px]}\nconstraints: [sw.magrin > 5 px]"),
                      "did you mean 'sw.margin'"));
  BOOST_TEST(contains(problem("parameters: {sw.margin: [4 px]}\nobjectives: [summary.fps.mean]"),
                      "max METRIC"));
  BOOST_TEST(contains(problem("parameters: {sw.margin: [4 px, 5 px]}\nobjectives: [max device]"),
                      "this is a text"));
  BOOST_TEST(
      contains(problem("parameters: {sw.margin: [4 px, 5 px]}\ntarget_rate: 200 fps\nconstraints: "
                       "[summary.fps.mean <= 100]"),
               "contradict each other"));
  BOOST_TEST(contains(run({"sweep", "pixel-clok"}).err, "did you mean 'pixel-clock'"));
}

BOOST_FIXTURE_TEST_CASE(a_sweep_of_nothing_is_a_mistake, Sweeps) {
  BOOST_TEST(contains(problem("title: Forgotten\ninputs: [z1.0, z4.0]\n"), "varies nothing"));
  BOOST_TEST(contains(problem("parameters:\n  sw.margin: [4 px\nset: 5\n"),
                      "wrong.yaml:3:4: this is not YAML"));
}

BOOST_FIXTURE_TEST_CASE(figures_that_do_not_exist_are_refused_before_the_first_point, Sweeps) {
  const std::string start = "parameters: {sw.margin: [4 px, 5 px]}\n";
  BOOST_TEST(contains(problem(start + "metrics: [summary.fps.men, sw.margin]\n"),
                      "wrong.yaml: metrics: unknown metric 'summary.fps.men'; did you mean "
                      "'summary.fps.mean'?"));
  BOOST_TEST(
      contains(problem(start + "objectives: [max 2 * power.totl_w.nominal]\n"),
               "'2 * power.totl_w.nominal', column 5: unknown metric 'power.totl_w.nominal'; "
               "did you mean 'power.total_w.nominal'?"));
  BOOST_TEST(
      contains(problem(start + "constraints: [timing.mett == 1]\n"),
               "wrong.yaml:2: 'timing.mett == 1', column 1: unknown metric 'timing.mett'; did "
               "you mean 'timing.met'?"));
  for (const char* wrong : {"60", "fps", "0 fps", "60 fpss", "60 Hz fps"})
    BOOST_TEST(contains(problem(start + "target_rate: " + wrong + "\n"), "as '60 fps'"), wrong);
  BOOST_TEST(
      contains(problem(start + "job: summary.detectd > 0\n"), "did you mean 'summary.detected'?"));
  write("s.yaml", start + "metrics: [summary.fps.mean, power.modules.pl.blob.w, sw.margin]\n");
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.err, "no result has the metric 'power.modules.pl.blob.w'"),
             outcome.err);
  BOOST_TEST(!contains(outcome.err, "'sw.margin'"), outcome.err);
  write("t.yaml", clocks);
  BOOST_TEST(run({"sweep", "t.yaml"}).err == "");
}

BOOST_FIXTURE_TEST_CASE(every_metric_has_a_meaning, Sweeps) {
  write("s.yaml",
        "inputs: [demo]\nparameters: {system: [hybrid, ps-only], camera.rate: [none, 5 fps]}\n");
  BOOST_TEST(run({"sweep", "s.yaml", "--no-report"}).exit_code == 0);
  std::istringstream lines(kit::read_file(*this / "out/s/sweep.csv"));
  std::string head, name;
  std::getline(lines, head);
  std::istringstream names(head);
  for (const char* column :
       {"key", "status", "message", "feasible", "same_as", "system", "camera.rate"}) {
    std::getline(names, name, ',');
    BOOST_TEST(name == column);
  }
  BOOST_REQUIRE(platform::register_marker_metrics());
  std::set<std::string> kinds;
  while (std::getline(names, name, ',')) {
    const platform::facts::Figure* figure = platform::result::figures().of(name);
    BOOST_REQUIRE_MESSAGE(figure != nullptr, name);
    kinds.insert(figure->path);
  }
  for (const char* rare : {"summary.unpublished",        // a program said nothing of a frame
                           "program_end.reached_limit",  // it was stopped in an endless loop
                           "program_end.main_us",        // its main() left interrupts on
                           "injected.*.times", "injected.*.first_us",  // faults were asked for
                           "clocks.list.*.legal_mhz",                  // a clock is too fast
                           // the design has RTL whose signals are counted
                           "power.activity.*.toggle_rate", "power.activity.*.signal_bits",
                           "frames.settling_showings",  // the logic learns from an input
                           "frames.figures.*"})         // the design declares some
    kinds.insert(rare);
  for (const platform::facts::Figure& figure : platform::result::figures().list())
    BOOST_TEST(kinds.count(figure.path) == 1u, figure.path);
}

// 533.333333 MHz is the platform's default, 400 MHz what the design sets.
BOOST_FIXTURE_TEST_CASE(what_a_design_sets_is_swept_to_the_platforms_default, Sweeps) {
  write("s.yaml",
        "inputs: [z1.0]\nset: {design: eco}\n"
        "parameters: {power.ddr.frequency: [400 MHz, 533.333333 MHz]}\n");
  const kit::Outcome outcome = run({"sweep", "s.yaml", "--no-report"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const std::string csv = kit::read_file(*this / "out/s/sweep.csv");
  BOOST_TEST(contains(csv, ",400 MHz,"), csv);
  BOOST_TEST(contains(csv, ",533.333333 MHz,"), csv);
}

BOOST_FIXTURE_TEST_CASE(a_rate_and_constraints_on_metrics_judge_the_results, Sweeps) {
  write("s.yaml",
        std::string(clocks) + "target_rate: 80 fps\nconstraints: [summary.detected == 1]\n");
  const std::string text = run({"sweep", "s.yaml"}).out;
  const auto apart = text.find("Not feasible:");
  BOOST_REQUIRE_MESSAGE(apart != std::string::npos, text);
  BOOST_TEST(text.find("50 MHz") < apart, text);
  BOOST_TEST(text.find("25 MHz") > apart, text);
  BOOST_TEST(contains(text, "breaks summary.fps.mean >= 80"), text);
  BOOST_TEST(contains(text, "1 of 4 points feasible, 2 miss timing, 1 break a constraint"), text);
  BOOST_TEST(contains(kit::read_file(*this / "out/s/manifest.json"), "summary.fps.mean >= 80"));
  write("t.yaml", std::string(clocks) + "target_rate: 1000 fps\n");
  run({"sweep", "t.yaml"});
  const kit::Outcome none = run({"pareto", "out/t"});
  BOOST_TEST(none.exit_code == 2);
  BOOST_TEST(contains(none.err,
                      "'summary.fps.mean >= 1000' rules out 4 of 4; the nearest is "
                      "ps.fclk_clk1.frequency = 50 MHz"),
             none.err);
}

BOOST_FIXTURE_TEST_CASE(an_objective_that_no_point_has_is_named, Sweeps) {
  write("s.yaml",
        "inputs: z4.0\nset: {pl.height: 224 px}\nparameters: {pl.width: [320 px]}\n"
        "objectives: [min frames.error.translation_mm.mean]\n");
  const kit::Outcome sweep = run({"sweep", "s.yaml", "--no-report"});
  BOOST_TEST(contains(sweep.err, "no result has the metric 'frames.error.translation_mm.mean'\n"),
             sweep.err);
  const kit::Outcome pareto = run({"pareto", "out/s"});
  BOOST_TEST(pareto.exit_code == 2);
  BOOST_TEST(contains(pareto.err,
                      "no point has a value of the study's objectives (min "
                      "frames.error.translation_mm.mean): give --objective"),
             pareto.err);
}

BOOST_FIXTURE_TEST_CASE(a_dry_run_tells_which_points_cannot_be_built, Sweeps) {
  write("s.yaml", "parameters: {pl.width: [640 px, 644 px], pl.height: [480 px, 482 px]}\n");
  const kit::Outcome dry = run({"sweep", "s.yaml", "--dry-run"});
  BOOST_TEST(contains(dry.out, "1 point will fail: frames of 644x480 px cannot be built"), dry.out);
  BOOST_TEST(!std::filesystem::exists(*this / "out"));
  const kit::Outcome ran = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(ran.out, "3 did not run"), ran.out);
  BOOST_TEST(dry.exit_code == 4);
  BOOST_TEST(ran.exit_code == 4);
  BOOST_TEST(run({"sweep", "s.yaml", "--dry-run", "--require-all"}).exit_code == 1);
  write("t.yaml", clocks);
  BOOST_TEST(run({"sweep", "t.yaml", "--dry-run"}).exit_code == 0);
}

BOOST_FIXTURE_TEST_CASE(a_huge_sweep_asks_first, Sweeps) {
  const std::string many = ": {start: 1 cycles, stop: 1000 cycles, step: 1 cycles}\n";
  const std::string two =
      "parameters:\n  pl.axi_dma_0.run_latency" + many + "  pl.axi_dma_0.start_latency" + many;
  BOOST_TEST(contains(problem(two), "1000000 points: run them all with --yes, or some with"));
  BOOST_TEST(contains(problem(two + "  pl.axi_dma_0.read_latency" + many),
                      "1000000000 points: no machine"));
  BOOST_TEST(contains(run({"sweep", "wrong.yaml", "--limit", "3", "--dry-run"}).out, "3 points"));
  BOOST_TEST(
      contains(problem("parameters:\n  ps.fclk_clk1.frequency: {start: 10 MHz, stop: 60 MHz, "
                       "step: 1 Hz}"),
               "too many also for --yes and --limit"));
}

BOOST_FIXTURE_TEST_CASE(a_point_runs_again_as_an_ordinary_run, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml", "--keep-results", "-o", "kept"});
  run({"sweep", "s.yaml"});
  BOOST_TEST(!std::filesystem::exists(*this / "out/s/points"), "they are kept if asked for");
  const std::string point = a_point("out/s");
  BOOST_TEST(run({"run", "--point", point, "--no-pictures", "-q", "-o", "again"}).exit_code == 0);
  const Json result = Json::parse(kit::read_file(*this / "again/result.json"));
  const auto [file, text] = *kept("kept").begin();
  const Json whole = Json::parse(text);
  for (const char* part : {"frames", "summary", "system", "profile"})
    BOOST_TEST(result[part].dump() == whole["outcome"]["result"][part].dump(), part);
  BOOST_TEST(result["configuration"].dump() == whole["identity"]["configuration"].dump());
  for (const std::string& name :
       {point, "kept/points/" + file, "kept:" + file.substr(0, file.find('.')),
        "out/s/points/" + file}) {
    const kit::Outcome compared = run({"compare", name, "again"});
    BOOST_TEST(contains(compared.out, "configuration: the same\n\nmetrics: the same"),
               name + ": " + compared.out + compared.err);
  }
  const kit::Outcome both = run({"run", "z1.0", "--point", point});
  BOOST_TEST(both.exit_code == 2);
  BOOST_TEST(contains(both.err, "leave out INPUT"), both.err);
}

BOOST_FIXTURE_TEST_CASE(names_of_points_that_are_wrong_are_refused, Sweeps) {
  write("s.yaml", "parameters: {pl.width: [600 px]}");
  run({"sweep", "s.yaml"});
  const std::string none = ":0123456789abcdef0123456789abcdef";
  const auto said = [&](const std::vector<std::string>& arguments) {
    const kit::Outcome outcome = run(arguments);
    BOOST_TEST(outcome.exit_code == 2);
    return outcome.err;
  };
  BOOST_TEST(contains(said({"run", "--point", "out/s"}), "cannot"));
  BOOST_TEST(contains(said({"run", "--point", "out/s:12"}), "names no point of a sweep"));
  BOOST_TEST(contains(said({"run", "--point", "out/s" + none}), "has no result of a point"));
  BOOST_TEST(contains(said({"run", "--point", "nowhere" + none}), "no folder of a sweep"));
  BOOST_TEST(contains(said({"compare", a_point("out/s"), "out"}), "is a point that failed"));
}

BOOST_FIXTURE_TEST_CASE(pareto_and_sensitivity_read_the_folder, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml"});
  const kit::Outcome pareto = run({"pareto", "out/s"});
  BOOST_TEST(pareto.exit_code == 0);
  // Above 55 MHz blob detection misses timing.
  BOOST_TEST(contains(pareto.out, "50 MHz"), pareto.out);
  BOOST_TEST(!contains(pareto.out, "100 MHz"), pareto.out);
  BOOST_TEST(contains(pareto.out, "2 of 4 points feasible, 2 miss timing\n"), pareto.out);
  BOOST_TEST(contains(kit::read_file(*this / "out/s/pareto.csv"), "max summary.fps.mean"));
  BOOST_TEST(contains(run({"sensitivity", "out/s"}).out, "ps.fclk_clk1.frequency"));
  BOOST_TEST(run({"pareto", "nowhere"}).exit_code == 2);
  BOOST_TEST(contains(run({"pareto", "out/s", "--objective", "max summary.fps.men"}).err,
                      "did you mean 'summary.fps.mean'"));
}

// Of both wishes the PLLs make 76.923 MHz.
BOOST_FIXTURE_TEST_CASE(wishes_of_one_real_clock_are_told_as_one_point, Sweeps) {
  const std::string wishes = "parameters: {ps.fclk_clk0.frequency: [75 MHz, 76 MHz]}\n";
  write("made.yaml", wishes);
  write("exact.yaml", "set: {clocks: exact}\n" + wishes);
  const std::string made = run({"sweep", "made.yaml"}).out;
  BOOST_TEST(contains(made, "  same as 75 MHz\n"), made);
  BOOST_TEST(contains(made, "2 of 2 points feasible, 1 the same as another\n"), made);
  const std::string exact = run({"sweep", "exact.yaml"}).out;
  BOOST_TEST(!contains(exact, "same as"), exact);
}

BOOST_FIXTURE_TEST_CASE(a_shipped_study_with_a_point_without_marker_is_analysed, Sweeps) {
  BOOST_TEST_REQUIRE(run({"sweep", "resolution"}).exit_code == 0);
  const kit::Outcome pareto = run({"pareto", "out/resolution"});
  BOOST_TEST(pareto.exit_code == 0, pareto.err);
  BOOST_TEST(contains(pareto.out, "left out: 2 points without 'frames.error.translation_mm.mean'"),
             pareto.out);
  const kit::Outcome sensitivity = run({"sensitivity", "out/resolution"});
  BOOST_TEST(sensitivity.exit_code == 0, sensitivity.err);
  BOOST_TEST(contains(sensitivity.err, "2 points left out of 'frames.error.translation_mm.mean'"),
             sensitivity.err);
}

// The sensor's time is serial to the software's, which does not depend on the pixel clock: latency
// is 6.144 ms · 50 MHz / f and a constant.
BOOST_FIXTURE_TEST_CASE(the_serial_formula_holds_and_fps_is_monotone, Sweeps) {
  write("s.yaml",
        "set: {clocks: exact}\n"
        "parameters: {ps.fclk_clk1.frequency: {start: 10 MHz, stop: 60 MHz, step: 5 MHz}}\n"
        "metrics: [summary.latency_us.mean, summary.fps.mean]\n");
  run({"sweep", "s.yaml"});
  std::istringstream lines(kit::read_file(*this / "out/s/sweep.csv"));
  std::string line;
  std::getline(lines, line);
  double mhz = 10;
  double fps_before = 0;
  double ps_time = 0;
  for (; std::getline(lines, line); mhz += 5) {
    const std::size_t last = line.rfind(',');
    const double latency = std::stod(line.substr(line.rfind(',', last - 1) + 1));
    const double fps = std::stod(line.substr(last + 1));
    const double sensor = 6144 * 50 / mhz;
    if (ps_time == 0) ps_time = latency - sensor;
    BOOST_TEST(std::fabs(latency / (sensor + ps_time) - 1) < 1e-3, line);
    BOOST_TEST(fps > fps_before);
    fps_before = fps;
  }
  BOOST_TEST(mhz == 65);
}

BOOST_AUTO_TEST_SUITE_END()
