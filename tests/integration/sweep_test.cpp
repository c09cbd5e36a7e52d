#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include <sweep/point_file.h>

#include "executable.h"

namespace {

using integration::Json;

constexpr const char* clocks = R"(
parameters:
  ps.fclk_clk1.frequency: {start: 25 MHz, stop: 100 MHz, step: 25 MHz}
metrics: [summary.fps.mean, frames.time_us.frame.mean]
objectives: [max summary.fps.mean, min summary.latency_us.mean]
)";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder in which sweeps run.
class Sweeps : public kit::TemporaryFolder {
 public:
  void write(const std::string& name, const std::string& yaml) const {
    kit::write_file(*this / name, yaml);
  }
  kit::Outcome run(const std::vector<std::string>& arguments) const {
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
  /// With a limit of the shell before it.
  kit::Outcome run_limited(const std::string& limit, const std::string& arguments) const {
    const std::string command = limit + "; exec " + MARKERVP_EXECUTABLE + " " + arguments;
    return kit::run_process("/bin/bash", {"-c", command}, path());
  }
  std::string problem(const std::string& yaml) const {
    write("wrong.yaml", yaml);
    const kit::Outcome outcome = run({"sweep", "wrong.yaml"});
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(!std::filesystem::exists(*this / "out"));
    return outcome.err;
  }
  std::map<std::string, std::string> points(const std::string& folder) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(*this / (folder + "/points"))) {
      if (entry.path().extension() == ".json")
        result[entry.path().filename().string()] = kit::read_file(entry.path().string());
    }
    return result;
  }
  std::size_t count_points(const std::string& folder) const {
    std::error_code ignored;
    const std::filesystem::directory_iterator all(*this / (folder + "/points"), ignored);
    return std::count_if(begin(all), end(all),
                         [](const auto& entry) { return entry.path().extension() == ".json"; });
  }
  /// Times that points were computed, by key.
  std::map<std::string, int> computations(const std::string& folder) const {
    std::map<std::string, int> counts;
    for (const auto& entry : std::filesystem::directory_iterator(*this / (folder + "/runs"))) {
      std::ifstream lines(entry.path());
      for (std::string line; std::getline(lines, line);)
        ++counts[Json::parse(line)["key"].get<std::string>()];
    }
    return counts;
  }
  std::string a_point(const std::string& folder) const {
    return *this / (folder + "/points/" + points(folder).begin()->first);
  }
};

void wait_until(const std::function<bool()>& happened) {
  while (!happened()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Kills the process of the sweep's point that runs now, `times` times, each another one.
void kill_points(kit::ChildProcess& sweep, int times) {
  const std::string file =
      "/proc/" + std::to_string(sweep.pid()) + "/task/" + std::to_string(sweep.pid()) + "/children";
  pid_t before = 0;
  while (times > 0 && !sweep.ended()) {
    pid_t child = 0;
    std::ifstream(file) >> child;
    if (child != 0 && child != before && ::kill(child, SIGKILL) == 0) {
      before = child;
      --times;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// A point that takes long enough to be killed in the midst of it, and long ones only: the plan's
/// processes have come and gone when its folder appears.
constexpr const char* long_point = "repeat: 3000\nparameters: {ps.fclk_clk1.frequency: [50 MHz]}\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(sweeps)

BOOST_FIXTURE_TEST_CASE(a_sweep_goes_on_where_it_stopped, Sweeps) {
  write("s.yaml", clocks);
  BOOST_TEST(run({"sweep", "s.yaml", "--limit", "2"}).exit_code == 0);
  const kit::Outcome second = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(second.out, "4 points: 2 computed now, 2 there before, 0 failed"),
             second.out);
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now, 4 there before"));
  for (const auto& [key, count] : computations("out/s")) BOOST_TEST(count == 1);
}

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
  for (const auto& [file, unused] : points("out/s"))
    BOOST_TEST(contains(text, '"' + file.substr(0, file.find('.')) + '"'));
}

BOOST_FIXTURE_TEST_CASE(results_do_not_depend_on_the_number_of_workers, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml", "--jobs", "1", "--output", "one"});
  run({"sweep", "s.yaml", "--jobs", "3", "--output", "three"});
  BOOST_TEST(points("one").size() == 4u);
  BOOST_TEST((points("one") == points("three")));
  BOOST_TEST(kit::read_file(*this / "one/sweep.csv") == kit::read_file(*this / "three/sweep.csv"));
}

BOOST_FIXTURE_TEST_CASE(equal_points_are_computed_once, Sweeps) {
  write("s.yaml", "parameters: {ps.fclk_clk1.frequency: [50 MHz, 50000 kHz, 0.05 GHz, 25 MHz]}");
  BOOST_TEST(contains(run({"sweep", "s.yaml", "--output", "d"}).out, "2 points: 2 computed now"));
  // The default, which another sweep had already.
  write("t.yaml", "parameters: {pl.corner_detection.threshold: [30]}");
  BOOST_TEST(contains(run({"sweep", "t.yaml", "--output", "d"}).out, "0 computed now, 1 there"));
}

BOOST_FIXTURE_TEST_CASE(a_killed_sweep_leaves_whole_results_only, Sweeps) {
  write("s.yaml",
        "parameters: {ps.fclk_clk1.frequency: {start: 20 MHz, stop: 59 MHz, step: 1 MHz}}");
  {
    kit::ChildProcess sweep(MARKERVP_EXECUTABLE, {"sweep", "s.yaml", "--jobs", "2"}, path());
    wait_until([&] { return count_points("out/s") >= 5 || sweep.ended(); });
    sweep.send(SIGKILL);
    sweep.wait();
  }
  const kit::Outcome again = run({"sweep", "s.yaml"});
  BOOST_TEST(again.exit_code == 0);
  BOOST_TEST(contains(again.out, "40 points: "), again.err);
  BOOST_TEST(contains(again.out, " 0 failed"));
  BOOST_TEST(count_points("out/s") == 40u);
  for (const auto& [key, count] : computations("out/s")) BOOST_TEST(count == 1, key);
}

BOOST_FIXTURE_TEST_CASE(two_sweeps_in_one_folder_are_refused, Sweeps) {
  write("s.yaml",
        "parameters: {ps.fclk_clk1.frequency: {start: 20 MHz, stop: 219 MHz, step: 1 MHz}}");
  kit::ChildProcess first(MARKERVP_EXECUTABLE, {"sweep", "s.yaml", "--jobs", "1"}, path());
  wait_until([&] { return count_points("out/s") >= 1 || first.ended(); });
  const kit::Outcome second = run({"sweep", "s.yaml"});
  BOOST_TEST(second.exit_code == 2);
  BOOST_TEST(contains(second.err, "another sweep works in 'out/s' (process "), second.err);
}

BOOST_FIXTURE_TEST_CASE(a_point_that_fails_is_a_result, Sweeps) {
  write("s.yaml", "parameters: {pl.width: [640 px, 600 px]}");
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.out, "1 point failed: "), outcome.out);
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now, 2 there before, 1 failed"));
  BOOST_TEST(contains(run({"sweep", "s.yaml", "--retry-failed"}).out, "1 computed now"));
}

BOOST_FIXTURE_TEST_CASE(a_killed_point_is_tried_once_more, Sweeps) {
  write("s.yaml", long_point);
  kit::ChildProcess sweep(MARKERVP_EXECUTABLE, {"sweep", "s.yaml"}, path());
  wait_until([&] { return std::filesystem::exists(*this / "out/s/points.csv") || sweep.ended(); });
  kill_points(sweep, 1);
  const kit::Outcome outcome = sweep.wait();
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.out, "1 point: 1 computed now, 0 there before, 0 failed"),
             outcome.out);
}

BOOST_FIXTURE_TEST_CASE(a_point_killed_twice_is_recorded_with_the_signal, Sweeps) {
  write("s.yaml", long_point);
  kit::ChildProcess sweep(MARKERVP_EXECUTABLE, {"sweep", "s.yaml"}, path());
  wait_until([&] { return std::filesystem::exists(*this / "out/s/points.csv") || sweep.ended(); });
  kill_points(sweep, 2);
  const kit::Outcome outcome = sweep.wait();
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.out, "1 point failed: the process was ended by a signal: Killed"),
             outcome.out);
  const Json failure = Json::parse(kit::read_file(a_point("out/s")))["outcome"]["failure"];
  BOOST_TEST(failure["signal"] == SIGKILL);
  BOOST_TEST(computations("out/s").begin()->second == 1);
}

BOOST_FIXTURE_TEST_CASE(points_of_another_version_are_mentioned, Sweeps) {
  write("s.yaml", "parameters: {ps.fclk_clk1.frequency: [50 MHz]}");
  run({"sweep", "s.yaml"});
  const std::string file = a_point("out/s");
  platform::sweep::PointRecord older = platform::sweep::read_point(file);
  older.identity["markervp"]["version"] = "0.0.1";
  older.key = platform::sweep::key_of(older.identity);
  std::filesystem::remove(file);
  kit::write_file(*this / ("out/s/points/" + older.key + ".json"),
                  platform::sweep::point_text(older));
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(outcome.out, "1 point: 1 computed now, 0 there before"), outcome.out);
  BOOST_TEST(contains(outcome.err, "1 point of another version of the program (0.0.1"),
             outcome.err);
  BOOST_TEST(count_points("out/s") == 2u);
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
  BOOST_TEST(contains(run({"sweep", "pixel-clok"}).err, "did you mean 'pixel-clock'"));
}

BOOST_FIXTURE_TEST_CASE(a_huge_sweep_asks_first, Sweeps) {
  const std::string many = ": {start: 1 cycles, stop: 1000 cycles, step: 1 cycles}\n";
  const std::string two =
      "parameters:\n  pl.axi_dma_0.run_latency" + many + "  pl.axi_dma_0.start_latency" + many;
  BOOST_TEST(contains(problem(two), "1000000 points: run them all with --yes, or some with"));
  BOOST_TEST(contains(problem(two + "  pl.axi_dma_0.read_latency" + many),
                      "1000000000 points: no machine"));
  BOOST_TEST(contains(run({"sweep", "wrong.yaml", "--limit", "3", "--dry-run"}).out, "3 points"));
}

BOOST_FIXTURE_TEST_CASE(a_full_disk_loses_nothing, Sweeps) {
  write("s.yaml", std::string(clocks) + "repeat: 80\n");
  run({"sweep", "s.yaml", "--limit", "2"});
  const auto before = points("out/s");
  // Files of 64 KiB at most: the result of 80 frames does not fit.
  const kit::Outcome outcome = run_limited("ulimit -f 64", "sweep s.yaml");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "File too large"), outcome.err);
  BOOST_TEST((points("out/s") == before));
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "4 points: 2 computed now"));
}

BOOST_FIXTURE_TEST_CASE(damaged_and_foreign_files_are_named, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml"});
  kit::write_file(*this / "out/s/points/notes.txt", "mine");
  const std::string point = a_point("out/s");
  const std::string whole = kit::read_file(point);
  kit::write_file(point, whole.substr(0, 100));
  const kit::Outcome damaged = run({"sweep", "s.yaml"});
  BOOST_TEST(damaged.exit_code == 2);
  BOOST_TEST(contains(damaged.err, "is damaged"), damaged.err);
  std::filesystem::remove(point);
  const kit::Outcome again = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(again.err, "'notes.txt', which no sweep wrote"), again.err);
  BOOST_TEST(contains(again.out, "1 computed now, 3 there before"), again.out);
  BOOST_TEST(kit::read_file(point) == whole);
}

BOOST_FIXTURE_TEST_CASE(a_point_runs_again_as_an_ordinary_run, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml"});
  const std::string point = a_point("out/s");
  BOOST_TEST(run({"run", "--point", point, "--no-pictures", "-q", "-o", "again"}).exit_code == 0);
  const Json result = Json::parse(kit::read_file(*this / "again/result.json"));
  const Json record = Json::parse(kit::read_file(point));
  for (const char* part : {"frames", "summary", "system", "profile"})
    BOOST_TEST(result[part].dump() == record["outcome"]["result"][part].dump(), part);
  BOOST_TEST(result["configuration"].dump() == record["identity"]["configuration"].dump());
  BOOST_TEST(contains(run({"compare", point, "again"}).out, "metrics: the same"));
  const kit::Outcome both = run({"run", "z1.0", "--point", point});
  BOOST_TEST(both.exit_code == 2);
  BOOST_TEST(contains(both.err, "leave out INPUT"), both.err);
}

BOOST_FIXTURE_TEST_CASE(pareto_and_sensitivity_read_the_folder, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml"});
  const kit::Outcome pareto = run({"pareto", "out/s"});
  BOOST_TEST(pareto.exit_code == 0);
  BOOST_TEST(contains(pareto.out, "100 MHz"), pareto.out);
  BOOST_TEST(contains(kit::read_file(*this / "out/s/pareto.csv"), "max summary.fps.mean"));
  BOOST_TEST(contains(run({"sensitivity", "out/s"}).out, "ps.fclk_clk1.frequency"));
  BOOST_TEST(run({"pareto", "nowhere"}).exit_code == 2);
  BOOST_TEST(contains(run({"pareto", "out/s", "--objective", "max summary.fps.men"}).err,
                      "did you mean 'summary.fps.mean'"));
}

// The sensor's time is serial to the software's, which does not depend on the pixel clock: latency
// is 6.144 ms · 50 MHz / f and a constant.
BOOST_FIXTURE_TEST_CASE(the_serial_formula_holds_and_fps_is_monotone, Sweeps) {
  write("s.yaml",
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
