// Rates, latency and stages of a run, from its frames.
#include <facts/summary.h>

#include <boost/test/unit_test.hpp>

#include "report_kit.h"

using namespace platform;
using namespace report_test;

namespace {

constexpr std::uint64_t ms = 1'000'000'000;

facts::UnitReport frame(std::uint64_t start_ms, std::uint64_t end_ms, std::uint64_t upload_ms) {
  facts::UnitReport report;
  report.start_ps = start_ms * ms;
  report.end_ps = end_ms * ms;
  report.upload_ps = upload_ms * ms;
  return report;
}

facts::UnitReport given_up(facts::UnitReport report) {
  report.gave_up = "feature words timed out";
  return report;
}

std::uint64_t length(const std::vector<vp::Interval>& period) {
  std::uint64_t ps = 0;
  for (const vp::Interval& part : period) ps += part.to_ps - part.from_ps;
  return ps;
}

const auto near = boost::test_tools::tolerance(1e-12);

}  // namespace

BOOST_AUTO_TEST_SUITE(summary)

BOOST_AUTO_TEST_CASE(a_period_begins_with_the_last_one_and_leaves_the_upload_out) {
  facts::FramePeriods periods;
  BOOST_TEST(periods.end_ps() == 0u);
  BOOST_TEST(length(periods.next(frame(3, 11, 3))) == 8 * ms);
  const auto second = periods.next(frame(15, 23, 3));  // 1 ms of it before the upload
  BOOST_TEST_REQUIRE(second.size() == 2u);
  BOOST_TEST(second[0].from_ps == 11 * ms);
  BOOST_TEST(second[0].to_ps == 12 * ms);
  BOOST_TEST(second[1].from_ps == 15 * ms);
  BOOST_TEST(second[1].to_ps == 23 * ms);
  // An upload that began before the last frame's end counts from there.
  BOOST_TEST(length(periods.next(frame(25, 30, 10))) == 5 * ms);
  BOOST_TEST(periods.end_ps() == 30 * ms);
}

BOOST_AUTO_TEST_CASE(showings_that_settle_the_threshold_are_in_no_period) {
  const auto settled = [](facts::UnitReport frame, std::uint64_t settled_ms) {
    frame.settling_showings = 1;
    frame.settled_ps = settled_ms * ms;
    return frame;
  };
  facts::FramePeriods periods;
  // The first one counts from its own start, as ever.
  BOOST_TEST(length(periods.next(settled(frame(10, 18, 0), 12))) == 8 * ms);
  // The next one was shown until 40 ms, and its own result came 3 ms later.
  BOOST_TEST(length(periods.next(settled(frame(38, 43, 0), 40))) == 3 * ms);
  BOOST_TEST(length(periods.next(frame(43, 50, 0))) == 7 * ms);
  facts::Summary summary;
  summary.add(settled(frame(10, 18, 0), 12));
  summary.add(frame(18, 20, 0));
  BOOST_TEST(summary.settled() == 1u);
}

BOOST_AUTO_TEST_CASE(every_marker_of_a_scene_has_its_truth) {
  facts::UnitReport frame = found_frame("z1.0");
  const auto truths = platform::ground_truths(platform::make_scene("z2.0@markers=10"));
  BOOST_TEST_REQUIRE(truths.size() == 10u);
  marker_frame(frame).truth = truths.front();
  marker_frame(frame).further_truth = {truths.begin() + 1, truths.end()};
  marker_frame(frame).markers.clear();
  for (const platform::GroundTruth& truth : truths) {
    FoundMarker& found = marker_frame(frame).markers.emplace_back();
    found.id = truth.marker_id;
    found.corners_px = truth.corners_px;
    found.pose = truth.pose;
    BOOST_TEST_REQUIRE(truth_of(marker_frame(frame), found) != nullptr);
    BOOST_TEST(measure_error(found, *truth_of(marker_frame(frame), found)).corner_px == 0);
  }
  facts::Summary summary;
  summary.add(judged(frame));
  BOOST_TEST(summary.samples("corner_px").count() == 10u);
  BOOST_TEST(summary.tally("mistaken") == 0u);
  marker_frame(frame).markers.erase(marker_frame(frame).markers.begin());
  summary.add(judged(frame));
  BOOST_TEST(summary.failures().size() == 1u, "the scene's own one decides");
  BOOST_TEST(summary.tally("mistaken") == 0u);
  marker_frame(frame).markers[0].id = 200;
  BOOST_TEST(truth_of(marker_frame(frame), marker_frame(frame).markers[0]) == nullptr);
  BOOST_TEST(another_marker_text(marker_frame(frame)) ==
             "another marker: the scene has 0 and 9 more");
  summary.add(judged(frame));
  BOOST_TEST(summary.tally("mistaken") == 1u);
  // Of two with one ID the nearer one is meant; of one of another size the pose says nothing.
  marker_frame(frame).further_truth[0].marker_id = marker_frame(frame).further_truth[1].marker_id;
  marker_frame(frame).markers[1].id = marker_frame(frame).further_truth[1].marker_id;
  marker_frame(frame).markers[1].corners_px = marker_frame(frame).further_truth[1].corners_px;
  BOOST_TEST(truth_of(marker_frame(frame), marker_frame(frame).markers[1]) ==
             &marker_frame(frame).further_truth[1]);
  marker_frame(frame).further_truth[1].is_usual = false;
  BOOST_TEST(!has_pose_error(marker_frame(frame).markers[1], marker_frame(frame).further_truth[1]));
}

BOOST_AUTO_TEST_CASE(a_frame_given_up_counts_as_time_and_not_as_result) {
  facts::Summary summary;
  summary.add(frame(0, 8, 0));
  summary.add(given_up(frame(11, 41, 3)));
  summary.add(frame(44, 52, 3));
  summary.add(given_up(frame(52, 100, 0)));  // after the last result
  BOOST_TEST(summary.frames() == 4u);
  BOOST_TEST(summary.delivered() == 2u);
  BOOST_TEST(summary.mean_fps() == 2000.0 / (8 + 30 + 8), near);
  BOOST_TEST(summary.fps().max() == 125.0, near);
  BOOST_TEST(summary.fps().min() == 1000.0 / 38, near);
  BOOST_TEST(summary.latency_us().count() == 2u);
  BOOST_TEST(summary.latency_us().max() == 8000.0, near);
}

BOOST_AUTO_TEST_CASE(time_runs_from_the_first_frame_also_if_that_was_given_up) {
  facts::Summary summary;
  summary.add(given_up(frame(5, 35, 5)));
  summary.add(frame(35, 45, 0));
  BOOST_TEST(summary.mean_fps() == 25.0, near);
}

BOOST_AUTO_TEST_CASE(without_a_result_there_is_no_rate) {
  facts::Summary summary;
  summary.add(given_up_frame("z1.0"));
  BOOST_TEST(summary.frames() == 1u);
  BOOST_TEST(summary.delivered() == 0u);
  BOOST_TEST(summary.mean_fps() == 0.0);
  BOOST_TEST(summary.fps().count() == 0u);
  BOOST_TEST(summary.latency_us().count() == 0u);
  BOOST_TEST(summary.stages().empty());
}

BOOST_AUTO_TEST_CASE(stages_are_those_of_results) {
  facts::Summary summary;
  facts::UnitReport stopped = given_up_frame("z1.0");
  for (facts::StageTime& time : stopped.times) time.ps *= 7;
  summary.add(stopped);
  summary.add(found_frame("z1.0", 1));
  for (const facts::Summary::Stage& stage : summary.stages()) {
    if (stage.name == "frame") BOOST_TEST(stage.us.max() == 8000.0);
    BOOST_TEST(stage.us.count() == 1u);
    const bool outside = stage.name == "frame" || stage.name == "upload";
    BOOST_TEST(stage.part_of == (outside ? "" : "frame"));
  }
  BOOST_TEST(facts::has_parts(stopped.times, "frame"));
  BOOST_TEST(!facts::has_parts(stopped.times, "pose"));
}

BOOST_AUTO_TEST_SUITE_END()
