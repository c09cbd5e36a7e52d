#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <sstream>
#include <thread>

#include "sweeps.h"

using namespace sweep_test;

namespace {

/// Whether the process has computed for some hundredths of a second: it is at a point.
bool is_at_work(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string stat{std::istreambuf_iterator<char>(file), {}};
  std::istringstream fields(stat.substr(std::min(stat.size(), stat.rfind(')') + 1)));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  long user = 0;
  fields >> user;
  return user >= 3;
}

/// Kills processes of the sweep that are at work, `times` times, each another one.
void kill_points(kit::ChildProcess& sweep, int times) {
  const std::string file =
      "/proc/" + std::to_string(sweep.pid()) + "/task/" + std::to_string(sweep.pid()) + "/children";
  std::set<pid_t> killed;
  while (times > 0 && !sweep.ended()) {
    std::ifstream children(file);
    for (pid_t child = 0; times > 0 && children >> child;) {
      if (killed.count(child) != 0 || !is_at_work(child)) continue;
      if (::kill(child, SIGKILL) != 0) continue;
      killed.insert(child);
      --times;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// A point that takes long enough to be killed in the midst of it, and long ones only: the plan's
/// processes have come and gone when its folder appears.
constexpr const char* long_point = "repeat: 3000\nparameters: {ps.fclk_clk1.frequency: [50 MHz]}\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(interrupted_sweeps)

BOOST_FIXTURE_TEST_CASE(a_sweep_goes_on_where_it_stopped, Sweeps) {
  write("s.yaml", clocks);
  BOOST_TEST(run({"sweep", "s.yaml", "--limit", "2"}).exit_code == 0);
  const kit::Outcome second = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(second.out, "4 points: 2 computed now, 2 there before, 0 failed"),
             second.out);
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now, 4 there before"));
  for (const auto& [key, count] : computations("out/s")) BOOST_TEST(count == 1);
}

BOOST_FIXTURE_TEST_CASE(a_process_killed_among_points_costs_none, Sweeps) {
  write("s.yaml",
        "parameters: {ps.fclk_clk1.frequency: {start: 20 MHz, stop: 139 MHz, step: 1 MHz}}");
  kit::ChildProcess sweep(MARKERVP_EXECUTABLE, {"sweep", "s.yaml", "--jobs", "2"}, path());
  // Points in between, so that none is killed in its second attempt, too.
  for (const std::size_t points : {5, 25, 45}) {
    wait_until([&] { return count_points("out/s") >= points || sweep.ended(); });
    kill_points(sweep, 1);
  }
  const kit::Outcome outcome = sweep.wait();
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(contains(outcome.out, "120 points: 120 computed now, 0 there before, 0 failed"),
             outcome.out);
  for (const auto& [key, count] : computations("out/s")) BOOST_TEST(count == 1, key);
}

BOOST_FIXTURE_TEST_CASE(a_sweep_stops_soon_when_asked, Sweeps) {
  write("s.yaml",
        "parameters: {ps.fclk_clk1.frequency: {start: 20 MHz, stop: 239 MHz, step: 0.1 MHz}}");
  kit::ChildProcess sweep(MARKERVP_EXECUTABLE, {"sweep", "s.yaml", "--jobs", "2"}, path());
  wait_until([&] { return count_points("out/s") >= 3 || sweep.ended(); });
  const std::size_t before = count_points("out/s");
  sweep.send(SIGINT);
  const kit::Outcome outcome = sweep.wait();
  BOOST_TEST(outcome.exit_code == 130);
  BOOST_TEST(contains(outcome.err, "the same command continues"), outcome.err);
  BOOST_TEST(count_points("out/s") < before + 1000);
  for (const auto& [key, count] : computations("out/s")) BOOST_TEST(count == 1, key);
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
  BOOST_TEST(contains(second.err, "another run or sweep writes into 'out/s' (process "),
             second.err);
}

BOOST_FIXTURE_TEST_CASE(a_point_that_fails_is_a_result, Sweeps) {
  write("s.yaml", "parameters: {pl.width: [640 px, 600 px]}");
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(outcome.exit_code == 4);
  BOOST_TEST(contains(outcome.err, "1 point of 2 failed"), outcome.err);
  BOOST_TEST(contains(outcome.out, "1 point failed: "), outcome.out);
  BOOST_TEST(contains(outcome.out, "1 of 2 points feasible, 1 did not run\n"), outcome.out);
  BOOST_TEST(run({"sweep", "s.yaml", "--require-all"}).exit_code == 1);
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "0 computed now, 2 there before, 1 failed"));
  BOOST_TEST(contains(run({"sweep", "s.yaml", "--retry-failed"}).out, "1 computed now"));
}

// Platforms are built together to know what the points are: one that cannot be built stops none.
BOOST_FIXTURE_TEST_CASE(points_that_cannot_be_built_leave_the_others_as_they_are, Sweeps) {
  const std::string labels = "  pl.blob_detection.label_count: [16, 32, 64, 128]\n";
  write("some.yaml", "parameters:\n  ps.ddr.size: [64 MiB, 511 MiB]\n" + labels);
  write("all.yaml", "parameters:\n  ps.ddr.size: [511 MiB]\n" + labels);
  const kit::Outcome some = run({"sweep", "some.yaml", "--output", "some", "--keep-results"});
  BOOST_TEST(some.exit_code == 4);
  BOOST_TEST(contains(some.err, "4 points of 8 failed"), some.err);
  BOOST_TEST(contains(some.out, "ps.ddr.dma_base is 0x10000000, but the memory ends at"), some.out);
  run({"sweep", "all.yaml", "--output", "all", "--keep-results"});
  BOOST_TEST(kept("all").size() == 4u);
  for (const auto& [key, result] : kept("all")) BOOST_TEST((kept("some").at(key) == result));
}

// The frame that went wrong says why, also if a good one follows it.
BOOST_FIXTURE_TEST_CASE(a_failed_point_says_what_the_software_said, Sweeps) {
  std::string noise = "P5\n640 480\n255\n";
  std::uint32_t chance = 1;
  for (int pixel = 0; pixel < 640 * 480; ++pixel) {
    chance = chance * 1'664'525u + 1'013'904'223u;
    noise += static_cast<char>(chance >> 24);
  }
  kit::write_file(*this / "noise.pgm", noise);
  write("s.yaml",
        "inputs: [noise.pgm, demo]\nparameters:\n  ps.fclk_clk1.frequency: [25 MHz, 50 MHz]\n");
  const kit::Outcome outcome = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(outcome.out, "ended with exit code 1: the software gave up: "), outcome.out);
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
  const platform::study::Shards shards{platform::study::Store(*this / "out/s")};
  const auto known = shards.outcome(computations("out/s").begin()->first);
  BOOST_TEST(known.value().failure.signal == SIGKILL);
  BOOST_TEST(computations("out/s").begin()->second == 1);
}

BOOST_FIXTURE_TEST_CASE(a_full_disk_loses_nothing, Sweeps) {
  write("s.yaml", std::string(clocks) + "repeat: 80\n");
  run({"sweep", "s.yaml", "--limit", "2", "--keep-results"});
  const auto before = kept("out/s");
  // Files of 64 KiB at most: the result of 80 frames does not fit.
  const kit::Outcome outcome = run_limited("ulimit -f 64", "sweep s.yaml --keep-results");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "File too large"), outcome.err);
  BOOST_TEST((kept("out/s") == before));
  BOOST_TEST(contains(run({"sweep", "s.yaml"}).out, "4 points: 2 computed now"));
}

BOOST_FIXTURE_TEST_CASE(a_damaged_shard_is_named_and_its_points_are_computed_again, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml", "--jobs", "1"});
  const std::string csv = kit::read_file(*this / "out/s/sweep.csv");
  const std::string shard = a_shard("out/s"), whole = kit::read_file(shard);
  std::string flipped = whole;
  flipped[whole.size() - 20] = static_cast<char>(flipped[whole.size() - 20] ^ 1);
  kit::write_file(shard, flipped);
  const kit::Outcome pareto = run({"pareto", "out/s"});
  BOOST_TEST(contains(pareto.err, ".shard' is damaged from byte "), pareto.err);
  BOOST_TEST(contains(pareto.err, "1 point not computed yet"), pareto.err);
  const kit::Outcome again = run({"sweep", "s.yaml"});
  BOOST_TEST(contains(again.err, ".shard' is damaged from byte "), again.err);
  BOOST_TEST(contains(again.out, "1 computed now, 3 there before"), again.out);
  BOOST_TEST(kit::read_file(*this / "out/s/sweep.csv") == csv);
  kit::write_file(shard, "notes of mine\n");
  const kit::Outcome refused = run({"sweep", "s.yaml"});
  BOOST_TEST(refused.exit_code == 2);
  BOOST_TEST(contains(refused.err, "is no results of a sweep"), refused.err);
}

BOOST_FIXTURE_TEST_CASE(damaged_and_foreign_whole_results_are_named, Sweeps) {
  write("s.yaml", clocks);
  run({"sweep", "s.yaml", "--keep-results"});
  kit::write_file(*this / "out/s/points/notes.txt", "mine");
  const std::string point = *this / ("out/s/points/" + kept("out/s").begin()->first);
  const std::string whole = kit::read_file(point);
  kit::write_file(point, whole.substr(0, 100));
  BOOST_TEST(contains(run({"run", "--point", point}).err, "is damaged"));
  std::filesystem::remove_all(*this / "out/s/runs");
  const kit::Outcome again = run({"sweep", "s.yaml", "--keep-results"});
  BOOST_TEST(contains(again.err, "is not whole"), again.err);
  BOOST_TEST(contains(again.err, "'notes.txt', which no sweep wrote"), again.err);
  BOOST_TEST(contains(again.out, "1 computed now, 3 there before"), again.out);
  BOOST_TEST(kit::read_file(point) == whole);
  std::filesystem::remove_all(*this / "out/s/runs");
  std::string changed = whole;
  changed.replace(changed.find("\"frames\":1"), 10, "\"frames\":2");
  kit::write_file(point, changed);
  for (const std::vector<std::string>& reader :
       {std::vector<std::string>{"sweep", "s.yaml"}, {"pareto", "out/s"}}) {
    const kit::Outcome refused = run(reader);
    BOOST_TEST(refused.exit_code == 2);
    BOOST_TEST(contains(refused.err, "was changed"), refused.err);
  }
}

BOOST_AUTO_TEST_SUITE_END()
