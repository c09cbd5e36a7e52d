#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <system_error>

#include <host/process.h>
#include <study/engine.h>
#include <study/shards.h>
#include <vp/error.h>
#include <vp/file.h>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::study;
using sweep_test::contains;

namespace {

Manifest points(int count) {
  Manifest manifest;
  manifest.name = "numbers";
  manifest.families.push_back({"hybrid", {{"a", "x"}}, {{"a", "x"}}, {}});
  manifest.input_sets.push_back({{"demo"}, {{"name", "demo"}}});
  for (int i = 0; i < count; ++i) {
    Point point;
    point.changes = {{"a", std::to_string(i)}};
    point.swept = {{"a", std::to_string(i)}};
    point.key = key_of(manifest.identity(point));
    manifest.points.push_back(point);
  }
  return manifest;
}

[[noreturn]] void crash() {
  // The test's own handler would catch it.
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  ::_exit(1);
}

/// A platform whose points are numbers. It notes each run: "number process".
class Platform : public kit::TemporaryFolder {
 public:
  /// What a run does beside its work: the number of the point, its attempt from 1. Returns the exit
  /// code.
  using Mischief = std::function<int(int number, int attempt, std::ostream& err)>;

  explicit Platform(int count) : manifest_(points(count)) {}

  int more_figures = 0;  ///< of each result

  Tally compute(const LocalOptions& options, const Mischief& mischief = {}) {
    const Shards shards(store());
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < manifest_.points.size(); ++i) {
      if (!shards.has(manifest_.points[i].key)) missing.push_back(i);
    }
    return run_local(store(), manifest_, missing, options, run_with(mischief), nullptr);
  }
  /// All points as a task of Slurm; returns its log.
  std::string compute_as_task(const Mischief& mischief) {
    std::filesystem::create_directories(*this / "sweep/slurm/1");
    write_manifest(*this / "sweep/slurm/1/task-0.json", manifest_);
    std::ostringstream log;
    const auto warm = [](const Manifest&, const std::vector<std::size_t>&) {};
    BOOST_TEST(run_slurm_task(store(), {1, 0, 64}, warm, run_with(mischief), log) == 0);
    return log.str();
  }

  RunPoint run_with(const Mischief& mischief) {
    return [this, mischief](const Setup& asked, RunResult& result, std::ostream& err) {
      const std::string number = asked.settings.at("a");
      std::ofstream(*this / "runs", std::ios::app)
          << number + " " + std::to_string(::getpid()) + "\n"
          << std::flush;
      const int code = mischief ? mischief(std::stoi(number), attempts(number), err) : 0;
      result.configuration = {{"a", number}};
      result.result["summary"]["number"] = std::stoi(number);
      for (int i = 0; i < more_figures; ++i)
        result.result["summary"]["figure_" + std::to_string(i)] = i;
      return code;
    };
  }

  /// Runs of the point of this number.
  int attempts(const std::string& number) const {
    int count = 0;
    for (const auto& [run, process] : runs()) count += run == number ? 1 : 0;
    return count;
  }
  std::size_t processes() const {
    std::set<std::string> different;
    for (const auto& [number, process] : runs()) different.insert(process);
    return different.size();
  }
  Store store() const { return Store(*this / "sweep"); }
  const std::string& key(int number) const { return manifest_.points[number].key; }
  bool has(int number) const { return Shards(store()).has(key(number)); }
  Outcome outcome(int number) const { return Shards(store()).outcome(key(number)).value(); }
  /// All computations, whosever.
  std::vector<Computation> computations() const {
    std::vector<Computation> all;
    Shards(store()).visit([&](const Computation& found) { all.push_back(found); });
    return all;
  }
  /// The whole results that are kept, one behind the other.
  std::string kept() const {
    std::string all;
    for (const Point& point : manifest_.points) all += kit::read_file(store().kept_path(point.key));
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::string>> runs() const {
    std::vector<std::pair<std::string, std::string>> result;
    std::istringstream lines(kit::read_file(*this / "runs"));
    for (std::string number, process; lines >> number >> process;)
      result.emplace_back(number, process);
    return result;
  }

  Manifest manifest_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(local_engine)

// Point 3 is in progress when the time is up, and would never end.
BOOST_AUTO_TEST_CASE(at_the_deadline_points_in_progress_are_abandoned) {
  Platform platform(10);
  const std::string up = platform / "time-is-up";
  LocalOptions options;
  options.is_over = [&] { return std::filesystem::exists(up); };
  const Tally tally = platform.compute(options, [&](int number, int, std::ostream&) {
    if (number == 3) {
      kit::write_file(up, "");
      for (;;) ::pause();
    }
    return 0;
  });
  BOOST_TEST(tally.interrupted);
  BOOST_TEST(tally.computed == 3u);
  BOOST_TEST(tally.abandoned == 1u);
  BOOST_TEST(platform.computations().size() == 3u);
  BOOST_TEST(!platform.has(3));
  // Another call computes what is missing.
  const Tally rest = platform.compute({});
  BOOST_TEST(rest.computed == 7u);
  BOOST_TEST(rest.abandoned == 0u);
  BOOST_TEST(!rest.interrupted);
}

BOOST_AUTO_TEST_CASE(a_process_computes_some_points) {
  Platform platform(10);
  const Tally tally = platform.compute({1, "local", 4});
  BOOST_TEST(tally.computed == 10u);
  BOOST_TEST(platform.processes() == 3u);
  BOOST_TEST(*platform.outcome(7).metrics.find("summary.number") == 7);
  BOOST_TEST(platform.computations().size() == 10u);
}

BOOST_AUTO_TEST_CASE(whole_results_do_not_depend_on_who_computed_them) {
  const auto kept_by = [](Platform& platform, std::uint32_t jobs, std::uint32_t points) {
    LocalOptions options{jobs, "local", points};
    options.keep_results = true;
    platform.compute(options);
    return platform.kept();
  };
  Platform alone(9);
  Platform together(9);
  BOOST_TEST(kept_by(alone, 1, 1) == kept_by(together, 3, 64));
  BOOST_TEST(alone.processes() == 9u);
  Platform none(1);
  none.compute({1, "local", 1});
  BOOST_TEST(!std::filesystem::exists(none.store().path("points")), "they are kept if asked for");
}

BOOST_AUTO_TEST_CASE(a_task_of_slurm_tells_of_a_process_that_died_and_the_sweep_of_that) {
  Platform quiet(3);
  BOOST_TEST(quiet.compute_as_task([](int, int, std::ostream&) { return 0; }) == "");
  Platform platform(3);
  const std::string log = platform.compute_as_task([](int number, int attempt, std::ostream&) {
    if (number == 2 && attempt == 1) crash();
    return 0;
  });
  BOOST_TEST(log ==
             "markervp: warning: the process was ended by a signal: Segmentation fault, at "
             "point " +
                 platform.key(2) + ": it is computed once more, and nothing else is lost\n");
  const std::string folder = platform / "sweep/slurm/1";
  const auto told = [&] {
    std::ostringstream err;
    tell_warnings(folder, err);
    return err.str();
  };
  BOOST_TEST(told() == "", "no task has a log");
  kit::write_file(folder + "/task-0.log", "slurmstepd: something\n");
  BOOST_TEST(told() == "");
  kit::write_file(folder + "/task-7.log", "first\n" + log);
  BOOST_TEST(told() == log.substr(0, log.size() - 1) + " (task-7)\n");
  std::string many;
  for (int i = 0; i < 25; ++i) many += log;
  kit::write_file(folder + "/task-7.log", many);
  BOOST_TEST(contains(told(), "markervp: warning: 5 more in the logs in " + folder + "\n"));
}

BOOST_AUTO_TEST_CASE(a_run_that_crashes_is_tried_once_more) {
  Platform platform(6);
  LocalOptions options{1, "local", 64};
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& text) { warnings.push_back(text); };
  const Tally tally = platform.compute(options, [](int number, int attempt, std::ostream&) {
    if (number == 2 && attempt == 1) crash();
    return 0;
  });
  BOOST_TEST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0] == "the process was ended by a signal: Segmentation fault, at point " +
                                platform.key(2) +
                                ": it is computed once more, and nothing else is lost");
  BOOST_TEST(tally.computed == 6u);
  BOOST_TEST(platform.attempts("1") == 1);
  BOOST_TEST(platform.attempts("2") == 2);
  BOOST_TEST(platform.attempts("3") == 1);
  // That which crashed, one for its second attempt, one for the rest.
  BOOST_TEST(platform.processes() == 3u);
  BOOST_TEST(!platform.outcome(2).failed);
  for (int number = 0; number < 6; ++number)
    BOOST_TEST(platform.outcome(number).attempt == (number == 2 ? 2 : 1));
}

BOOST_AUTO_TEST_CASE(a_sweep_that_was_killed_keeps_the_points_that_were_finished) {
  Platform platform(3);
  std::array<int, 2> alive{};  // open as long as one of the processes is there
  BOOST_TEST_REQUIRE(::pipe(alive.data()) == 0);
  const pid_t sweep = ::fork();
  if (sweep == 0) {
    const platform::host::InterruptGuard
        guard;  // as the command has it: a signal ends no process at once
    platform.compute({1, "local", 64}, [](int number, int, std::ostream&) {
      if (number == 1) {
        ::kill(::getppid(), SIGKILL);
        for (;;) ::pause();
      }
      return 0;
    });
    ::_exit(0);
  }
  ::close(alive[1]);
  int status = 0;
  BOOST_TEST_REQUIRE(::waitpid(sweep, &status, 0) == sweep);
  BOOST_TEST_REQUIRE((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
  pollfd end{alive[0], 0, 0};
  constexpr int generous_ms = 60'000;
  BOOST_TEST(::poll(&end, 1, generous_ms) == 1, "its process computes on without it");
  ::close(alive[0]);
  BOOST_TEST(platform.has(0), "what it finished is kept");
  BOOST_TEST(!platform.has(1));
  BOOST_TEST(platform.attempts("2") == 0);
}

BOOST_AUTO_TEST_CASE(a_run_that_crashes_again_is_recorded_with_its_signal) {
  Platform platform(3);
  const Platform::Mischief crashes = [](int number, int, std::ostream&) {
    if (number == 1) ::raise(SIGKILL);
    return 0;
  };
  LocalOptions options{2, "local", 64};
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& text) { warnings.push_back(text); };
  const Tally tally = platform.compute(options, crashes);
  BOOST_TEST_REQUIRE(warnings.size() == 2u);
  BOOST_TEST(contains(warnings[1], "for the second time, so the point has failed"));
  BOOST_TEST(contains(warnings[1], "take fewer processes (--jobs)"));
  BOOST_TEST(tally.computed == 3u);
  BOOST_TEST(platform.outcome(1).failed);
  BOOST_TEST(platform.attempts("1") == 2);
  BOOST_TEST(platform.outcome(1).failure.signal == SIGKILL);
  BOOST_TEST(contains(platform.outcome(1).failure.message, "Killed"));
  BOOST_TEST(platform.outcome(1).attempt == 2);
  BOOST_TEST(!platform.outcome(0).failed);
  BOOST_TEST(!platform.outcome(2).failed);
}

BOOST_AUTO_TEST_CASE(a_run_that_ends_its_process_is_no_result) {
  Platform platform(2);
  platform.compute({1, "local", 64}, [](int number, int, std::ostream&) {
    if (number == 0) ::_exit(0);
    return 0;
  });
  BOOST_TEST(platform.attempts("0") == 2);
  BOOST_TEST(contains(platform.outcome(0).failure.message, "ended without a result"));
  BOOST_TEST(!platform.outcome(1).failed);
}

BOOST_AUTO_TEST_CASE(nothing_follows_a_run_that_failed_in_its_process) {
  Platform platform(4);
  const Tally tally = platform.compute({1, "local", 64}, [](int number, int, std::ostream& err) {
    if (number != 1) return 0;
    err << "markervp: it does not fit\n";
    return 2;
  });
  BOOST_TEST(tally.computed == 4u);
  BOOST_TEST(platform.processes() == 2u);
  BOOST_TEST(platform.attempts("1") == 1);
  BOOST_TEST(platform.outcome(1).failure.message == "it does not fit");
  BOOST_TEST(platform.outcome(1).failure.exit_code == 2);
}

BOOST_AUTO_TEST_CASE(a_program_named_like_an_error_of_the_disk_ends_its_own_point_only) {
  Platform platform(3);
  const Tally tally = platform.compute({1}, [](int number, int, std::ostream& err) {
    if (number == 1) err << "markervp: program 'Input/output error test' ended with exit code 1\n";
    return number == 1 ? 1 : 0;
  });
  BOOST_TEST(tally.computed == 3u);
  BOOST_TEST(platform.outcome(1).failed);
  BOOST_TEST(platform.outcome(1).failure.message ==
             "program 'Input/output error test' ended with exit code 1");
  for (const int number : {0, 2}) BOOST_TEST(!platform.outcome(number).failed);
}

BOOST_AUTO_TEST_CASE(a_machine_that_fails_ends_the_sweep_and_leaves_the_point_open) {
  const auto fail = [](const std::exception_ptr& how) {
    return [how](int number, int, std::ostream&) {
      if (number == 1) std::rethrow_exception(how);
      return 0;
    };
  };
  for (const std::exception_ptr& how :
       {std::make_exception_ptr(vp::OutputError("x", EIO)),
        std::make_exception_ptr(vp::HostError("cannot read camera 'c': Too many open files")),
        std::make_exception_ptr(
            std::system_error(EMFILE, std::generic_category(), "cannot start a process"))}) {
    Platform platform(3);
    BOOST_CHECK_THROW(platform.compute({1}, fail(how)), vp::HostError);
    BOOST_TEST(!platform.has(1));
    BOOST_TEST(!platform.outcome(0).failed, "what was computed is kept");
  }
  Platform platform(3);
  platform.compute(
      {1}, fail(std::make_exception_ptr(std::system_error(EINVAL, std::generic_category(), "no"))));
  BOOST_TEST(platform.outcome(1).failed, "an error of the run is one of its point");
}

BOOST_AUTO_TEST_CASE(another_value_than_planned_is_noticed) {
  Platform platform(1);
  const Tally tally = platform.compute({1, "local", 64}, [](int, int, std::ostream&) { return 0; });
  BOOST_TEST(tally.computed == 1u);
  Platform wrong(1);
  const Manifest manifest = points(1);
  const RunPoint run = [](const Setup&, RunResult& result, std::ostream&) {
    result.configuration = {{"a", "another"}};
    result.result["summary"]["number"] = 0;
    return 0;
  };
  run_local(wrong.store(), manifest, {0}, {1, "local", 64}, run, nullptr);
  BOOST_TEST(contains(Shards(wrong.store()).outcome(manifest.points[0].key).value().failure.message,
                      "another value than planned: a"));
}

BOOST_AUTO_TEST_SUITE_END()
