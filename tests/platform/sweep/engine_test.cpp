#include <csignal>
#include <fstream>

#include <sweep/engine.h>
#include <sweep/run_log.h>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::sweep;
using sweep_test::contains;

namespace {

Manifest one_point() {
  Manifest manifest;
  manifest.name = "one";
  manifest.families.push_back({"hybrid", {{"a", "1"}}, {{"a", "1"}}, {}});
  manifest.input_sets.push_back({{"demo"}, {{"name", "demo"}}});
  PlannedPoint point;
  point.key = key_of(manifest.identity(point));
  manifest.points.push_back(point);
  return manifest;
}

[[noreturn]] void crash() {
  // The test's own handler would catch it.
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  ::_exit(1);
}

/// A platform that crashes in its first runs, and counts them.
class Crashing : public kit::TemporaryFolder {
 public:
  explicit Crashing(int times) : times_(times) {}

  Tally compute() {
    const RunPoint run = [this](const PointRun&, const std::string& folder, std::ostream&) {
      std::ofstream(*this / "attempts", std::ios::app) << '.' << std::flush;
      if (attempts() <= times_) crash();
      std::filesystem::create_directories(folder);
      kit::write_file(folder + "/result.json", R"({"configuration": {"a": "1"}, "summary": {}})");
      return 0;
    };
    return run_local(store(), manifest_, {0}, {1, "local"}, run, nullptr);
  }

  int attempts() const { return static_cast<int>(kit::read_file(*this / "attempts").size()); }
  Store store() const { return Store(*this / "sweep"); }
  PointRecord record() const { return store().read(manifest_.points[0].key); }

 private:
  int times_;
  Manifest manifest_ = one_point();
};

}  // namespace

BOOST_AUTO_TEST_SUITE(local_engine)

BOOST_AUTO_TEST_CASE(a_run_that_crashes_is_tried_once_more) {
  Crashing platform(1);
  BOOST_TEST(platform.compute().computed == 1u);
  BOOST_TEST(platform.attempts() == 2);
  BOOST_TEST(!platform.record().failed());
  BOOST_TEST(read_runs(platform.store()).front().attempt == 2);
}

BOOST_AUTO_TEST_CASE(a_run_that_crashes_again_is_recorded_with_its_signal) {
  Crashing platform(100);
  platform.compute();
  BOOST_TEST(platform.attempts() == 2);
  const PointRecord record = platform.record();
  BOOST_TEST(record.failed());
  const Json& failure = record.outcome.at("failure");
  BOOST_TEST(failure.at("signal") == SIGSEGV);
  BOOST_TEST(contains(failure.at("message").get<std::string>(), "Segmentation fault"));
  // Which is a result: it stays.
  BOOST_TEST(platform.compute().computed == 0u);
  BOOST_TEST(platform.attempts() == 2);
}

BOOST_AUTO_TEST_SUITE_END()
