// What sets the frame rate: the stages that overlap with the frame before, those that follow, or
// the camera.
#include <boost/test/unit_test.hpp>

#include <facts/summary.h>

#include "report_kit.h"

using namespace platform;
using facts::Limit;
using facts::StageTime;
using facts::UnitReport;

namespace {

constexpr std::uint64_t us = 1'000'000;

StageTime stage(const char* name, std::uint64_t from_us, std::uint64_t to_us,
                std::vector<std::string> levers = {}) {
  return {name, (to_us - from_us) * us, from_us * us, "frame", "", "", std::move(levers)};
}

UnitReport frame(std::uint64_t from_us, std::uint64_t to_us, std::vector<StageTime> stages) {
  UnitReport report;
  report.start_ps = from_us * us;
  report.end_ps = to_us * us;
  report.times = std::move(stages);
  report.times.push_back({"frame", report.end_ps - report.start_ps, report.start_ps});
  return report;
}

/// Frame `n` of a logic that captures the next one while the software works on one.
UnitReport overlapping(std::uint64_t n, std::uint64_t capture_us, std::uint64_t software_us,
                       std::vector<std::string> levers = {"sw.second_core=1"}) {
  const std::uint64_t period = std::max(capture_us, software_us);
  const std::uint64_t start = n * period, captured = start + period, end = captured + software_us;
  StageTime capture = stage("capture", start, start + capture_us, {"pl.pixels_per_clock=2"});
  capture.clock = "ps.fclk_clk0";
  StageTime wait = stage("wait", start + capture_us, captured);
  wait.waits = true;
  return frame(start, end,
               {capture, wait, stage("detection", captured, end - 10, std::move(levers)),
                stage("pose", end - 10, end)});
}

Limit limit_of(const std::vector<UnitReport>& frames) {
  facts::Summary summary;
  for (const UnitReport& each : frames) summary.add(each);
  BOOST_TEST_REQUIRE(summary.limit().has_value());
  return *summary.limit();
}

using Names = std::vector<std::string>;

const auto near = boost::test_tools::tolerance(1e-9);

double percent(const Limit& limit, const std::string& stage) {
  for (const auto& [name, share] : limit.percent) {
    if (name == stage) return share;
  }
  return -1;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(limit)

BOOST_AUTO_TEST_CASE(the_capture_is_the_limit_if_the_software_waits_for_it) {
  const Limit limit = limit_of({overlapping(0, 300, 200), overlapping(1, 300, 200)});
  BOOST_TEST((limit.kind == Limit::Kind::ahead));
  BOOST_TEST(limit.stages == Names{"capture"});
  BOOST_TEST(limit.stages_us == 300.0, near);
  BOOST_TEST(limit.period_us == 300.0, near);
  BOOST_TEST(limit.text(platform::marker_work()) ==
             "capture sets the frame rate: 300.0 of 300.0 us, other stages overlap");
  BOOST_TEST(limit.levers_text() == "pl.pixels_per_clock=2, or a higher ps.fclk_clk0.frequency");
  BOOST_TEST(percent(limit, "capture") == 100.0, near);
  BOOST_TEST(percent(limit, "detection") == 0.0);
  BOOST_TEST(percent(limit, "wait") == -1.0, "which is the cause of nothing");
}

// The capture takes the longest of all stages, and yet it does not set the rate.
BOOST_AUTO_TEST_CASE(the_software_is_the_limit_if_its_stages_together_take_longer) {
  auto two_parts = [](std::uint64_t n) {
    UnitReport frame = overlapping(n, 300, 400);
    frame.times[2] = stage("detection", (n + 1) * 400, (n + 1) * 400 + 210, {"a=1"});
    frame.times[3] = stage("pose", (n + 1) * 400 + 210, (n + 2) * 400, {"b=1"});
    return frame;
  };
  const Limit limit = limit_of({two_parts(0), two_parts(1), two_parts(2)});
  BOOST_TEST((limit.kind == Limit::Kind::behind));
  BOOST_TEST(limit.stages == (Names{"detection", "pose"}));
  BOOST_TEST(limit.stages_us == 400.0, near);
  BOOST_TEST(limit.levers == Names{"a=1"}, "the lever of the longest");
  BOOST_TEST(limit.clock == "");
  BOOST_TEST(limit.text(platform::marker_work()) ==
             "detection and pose set the frame rate: 400.0 of 400.0 us, other stages overlap");
}

BOOST_AUTO_TEST_CASE(of_stages_in_a_row_the_longest_counts) {
  std::vector<UnitReport> frames;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t at = 100 * i;
    StageTime wait = stage("wait", at + 30, at + 80);
    wait.waits = true;
    frames.push_back(frame(
        at, at + 100,
        {stage("capture", at, at + 30, {"c=2"}), wait, stage("detection", at + 80, at + 100)}));
  }
  const Limit limit = limit_of(frames);
  BOOST_TEST((limit.kind == Limit::Kind::sequence));
  BOOST_TEST(limit.stages == Names{"capture"}, "waiting is never the cause");
  BOOST_TEST(limit.levers == Names{"c=2"});
  BOOST_TEST(limit.text(platform::marker_work()) ==
             "capture sets the frame rate: 30.0 of 100.0 us, one stage follows the "
             "other");
}

BOOST_AUTO_TEST_CASE(a_stage_that_contains_others_or_has_no_beginning_is_no_overlap) {
  UnitReport first = report_test::found_frame("z1.0");
  UnitReport second = report_test::found_frame("z1.0", 1);
  second.times.insert(second.times.begin() + 1,
                      {"corner_detection", 5'000'000'000, 0, "feature_extraction"});
  const Limit limit = limit_of({first, second});
  BOOST_TEST((limit.kind == Limit::Kind::sequence));
  BOOST_TEST(limit.stages == Names{"corner_detection"});
  BOOST_TEST(percent(limit, "feature_extraction") == 0.0, "of the first frame, which says little");
}

BOOST_AUTO_TEST_CASE(a_single_frame_has_a_limit_of_its_own) {
  BOOST_TEST((limit_of({overlapping(0, 300, 400)}).kind == Limit::Kind::sequence));
  UnitReport settled = overlapping(1, 300, 400);
  settled.settling_showings = 2;
  settled.settled_ps = 2 * 400 * us;
  BOOST_TEST((limit_of({settled}).kind == Limit::Kind::behind));
}

BOOST_AUTO_TEST_CASE(what_sets_most_of_the_time_is_the_limit) {
  std::vector<UnitReport> frames{overlapping(0, 300, 200)};
  for (std::uint64_t i = 1; i < 4; ++i) frames.push_back(overlapping(i, 300, 200));
  UnitReport slow = overlapping(4, 300, 200);
  slow.end_ps += 300 * us;
  slow.times[2].ps += 300 * us;
  frames.push_back(slow);
  // The capture of the next one ends while the software is still at it.
  const std::uint64_t busy_until = slow.end_ps / us;
  frames.push_back(frame(busy_until - 350, busy_until + 200,
                         {stage("capture", busy_until - 350, busy_until - 50),
                          stage("detection", busy_until, busy_until + 190),
                          stage("pose", busy_until + 190, busy_until + 200)}));
  const Limit limit = limit_of(frames);
  BOOST_TEST(limit.stages == Names{"capture"});
  // Periods: 3 of 300, one of 600, and one of 200 in which the capture was ready in time.
  BOOST_TEST(percent(limit, "capture") == 100 * 1500.0 / 1700, near);
  BOOST_TEST(percent(limit, "pose") == 100 * 200.0 / 1700, near);
  BOOST_TEST(limit.text(platform::marker_work()) ==
             "capture sets the frame rate for 88 % of the run: 300.0 of 375.0 us, other stages "
             "overlap");
}

BOOST_AUTO_TEST_CASE(levers_are_those_of_most_frames) {
  const Limit limit = limit_of({overlapping(0, 300, 400, {"none=0"}),
                                overlapping(1, 300, 400, {"sw.second_core=1"}),
                                overlapping(2, 300, 400, {}), overlapping(3, 300, 400, {})});
  BOOST_TEST(limit.levers.empty());
  BOOST_TEST(limit.levers_text() == "");
  BOOST_TEST(percent(limit, "detection") == 100.0, near);
}

BOOST_AUTO_TEST_CASE(a_camera_that_the_program_waits_for_is_the_limit) {
  const auto paced = [](std::uint64_t n, std::optional<std::uint64_t> missed) {
    const std::uint64_t at = 1000 * n;
    UnitReport report = frame(at, at + 100, {stage("work", at, at + 100, {"w=1"})});
    report.camera_period = vp::Interval{at * us, (at + 1000) * us};
    report.camera_missed = missed;
    return report;
  };
  const Limit limit = limit_of({paced(0, 0), paced(1, {})});
  BOOST_TEST((limit.kind == Limit::Kind::camera));
  BOOST_TEST(limit.stages.empty());
  BOOST_TEST(limit.levers == Names{"camera.rate=none"});
  BOOST_TEST(limit.text(platform::marker_work()) ==
             "the camera sets the frame rate: an image each 1000.0 us");
  BOOST_TEST(percent(limit, "camera") == 100.0, near);
  // It came while the program was busy: that is the program's limit.
  const Limit busy = limit_of({paced(0, 1), paced(1, 2), paced(2, {})});
  BOOST_TEST(busy.stages == Names{"work"});
  BOOST_TEST(percent(busy, "camera") == 0.0);
}

BOOST_AUTO_TEST_CASE(frames_without_a_result_have_no_limit) {
  facts::Summary summary;
  summary.add(report_test::given_up_frame("z1.0"));
  BOOST_TEST(!summary.limit().has_value());
  UnitReport bare;
  bare.end_ps = us;
  summary.add(bare);
  BOOST_TEST(!summary.limit().has_value(), "its frame has no parts");
}

BOOST_AUTO_TEST_SUITE_END()
