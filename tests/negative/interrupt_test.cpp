// Ctrl-C in the middle of a run.
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "command_line.h"

using namespace negative;

namespace {

/// Ends by itself at some time, should the test be killed.
const Words long_run{"run", "z1.0", "yaw30", "--repeat", "1000", "--output", "out"};

/// Waits until the first frames are reported.
void await_frames(const kit::ChildProcess& run) {
  while (!run.ended() && !contains(run.out(), " 3/2000]")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void check_results(const CommandLine& place) {
  const auto result = nlohmann::json::parse(kit::read_file(place / "out/result.json"));
  const std::size_t frames = result["frames"].size();
  BOOST_TEST(result["incomplete"] == "interrupted");
  BOOST_TEST(frames >= 3u);
  BOOST_TEST(frames < 2000u);
  BOOST_TEST(result["summary"]["frames"] == frames);
  BOOST_TEST(result["summary"]["detected"] == frames, "the last frame is whole");
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(place / "out")) {
    const std::string name = entry.path().filename().string();
    BOOST_TEST((name == ".markervp" || name == "result.json" || name == "report.html" ||
                entry.path().extension() == ".png"),
               name << " is left over");
    pictures += entry.path().extension() == ".png" ? 1 : 0;
  }
  BOOST_TEST(pictures == frames);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(interrupt, CommandLine)

BOOST_AUTO_TEST_CASE(results_so_far_are_kept) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const CommandLine place;
    kit::ChildProcess run(MARKERVP_EXECUTABLE, long_run, place.path());
    await_frames(run);
    run.send(signal);
    const kit::Outcome outcome = run.wait();
    BOOST_TEST(outcome.exit_code == 130);
    check_one_line(outcome.err, {"interrupted", "kept"});
    check_results(place);
  }
}

BOOST_AUTO_TEST_CASE(a_run_goes_on_where_nobody_can_hang_up) {
  const kit::Outcome outcome = shell(
      "nohup \"$markervp\" run z1.0 --repeat 300 --no-pictures --output out > log & run=$!\n"
      "until grep -q 3/300 log; do sleep 0.01; done; kill -HUP $run; wait $run");
  BOOST_TEST(outcome.exit_code == 0);
  const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["frames"].size() == 300u);
}

BOOST_AUTO_TEST_CASE(a_signal_that_ends_it_at_once_leaves_no_part_file) {
  Words arguments = long_run;
  arguments.insert(arguments.end(), {"--trace", "a.fst"});
  kit::ChildProcess run(MARKERVP_EXECUTABLE, arguments, path());
  await_frames(run);
  BOOST_TEST(!run.ended());
  run.send(SIGQUIT);
  BOOST_TEST(run.wait().signal == SIGQUIT);
  for (const std::string& name : entries()) BOOST_TEST(!contains(name, ".part-"), name);
}

BOOST_AUTO_TEST_CASE(the_trace_is_whole_too) {
  Words arguments = long_run;
  arguments.insert(arguments.end(), {"--trace", "a.vcd", "--trace-window", "6ms:6.01ms"});
  kit::ChildProcess run(MARKERVP_EXECUTABLE, arguments, path());
  await_frames(run);
  run.send(SIGINT);
  BOOST_TEST(run.wait().exit_code == 130);
  const std::string trace = kit::read_file(*this / "a.vcd");
  BOOST_TEST(contains(trace, "$enddefinitions"));
  BOOST_TEST(trace.back() == '\n');
}

BOOST_AUTO_TEST_SUITE_END()
