// Hybrid and PS-only system: the same images give the same results, in other times.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include <marker/scene/scene.h>

#include "platform_run.h"

using namespace integration;
using platform::facts::UnitReport;

namespace {

std::vector<std::string> all_groups() {
  std::vector<std::string> names;
  for (const platform::SceneGroup& group : platform::scene_groups()) names.push_back(group.name);
  return names;
}

void check_same_marker(const UnitReport& a, const UnitReport& b) {
  BOOST_TEST_REQUIRE(platform::marker_frame(a).markers.size() ==
                     platform::marker_frame(b).markers.size());
  for (std::size_t i = 0; i < platform::marker_frame(a).markers.size(); ++i) {
    const auto &one = platform::marker_frame(a).markers[i],
               &other = platform::marker_frame(b).markers[i];
    BOOST_TEST(one.id == other.id);
    BOOST_TEST(one.rotation == other.rotation);
    BOOST_TEST((one.iterations == other.iterations));
    BOOST_TEST((one.reprojection_px == other.reprojection_px));
    for (std::size_t n = 0; n < 4; ++n) {
      BOOST_TEST(one.corners_px[n].x == other.corners_px[n].x);
      BOOST_TEST(one.corners_px[n].y == other.corners_px[n].y);
    }
    BOOST_TEST((one.pose.rotation == other.pose.rotation));
    BOOST_TEST((one.pose.translation == other.pose.translation));
  }
}

void check_same_results(const PlatformRun& a, const PlatformRun& b) {
  BOOST_TEST_REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    BOOST_TEST_CONTEXT(a.frames[i].input) {
      BOOST_TEST(platform::marker_frame(a.frames[i]).threshold.value() ==
                 platform::marker_frame(b.frames[i]).threshold.value());
      BOOST_TEST(features(a.frames[i]) == features(b.frames[i]), boost::test_tools::per_element());
      BOOST_TEST(a.frames[i].counts["candidates"] == b.frames[i].counts["candidates"]);
      check_same_marker(a.frames[i], b.frames[i]);
    }
  }
}

/// What the thesis' figures 5.28 and 5.31 stack.
void check_stages(const UnitReport& frame) {
  const double parts = stage_us(frame, "capture") + stage_us(frame, "corner_detection") +
                       stage_us(frame, "threshold") + stage_us(frame, "blob_detection");
  const double features = stage_us(frame, "feature_extraction");
  BOOST_TEST(std::abs(parts - features) < 0.1);
  BOOST_TEST(stage_us(frame, "receive") == 0);
  BOOST_TEST(stage_us(frame, "upload") == 0);
  BOOST_TEST(std::abs(features + stage_us(frame, "evaluation") + stage_us(frame, "identification") +
                      stage_us(frame, "pose") - stage_us(frame, "frame")) < 0.1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(systems)

BOOST_AUTO_TEST_CASE(both_find_the_same_in_every_scene) {
  const PlatformRun hybrid = run_scenes(all_groups());
  const PlatformRun ps_only = run_scenes(all_groups(), {}, System::ps_only);
  BOOST_TEST(hybrid.frames.size() >= 317u);
  BOOST_TEST(hybrid.facts.system == "hybrid");
  BOOST_TEST(ps_only.facts.system == "ps-only");
  check_same_results(hybrid, ps_only);
  for (const UnitReport& frame : ps_only.frames) {
    BOOST_TEST_CONTEXT(frame.input) check_stages(frame);
  }
}

BOOST_AUTO_TEST_CASE(both_find_the_same_at_another_resolution) {
  const Settings settings{{"pl.width", "320 px"}, {"pl.height", "256 px"}};
  check_same_results(run_scenes({"demo", "roll30"}, settings),
                     run_scenes({"demo", "roll30"}, settings, System::ps_only));
}

BOOST_AUTO_TEST_CASE(the_profile_is_named_and_changes_times_only) {
  const PlatformRun thesis = run_scenes({"demo"}, {}, System::ps_only);
  const PlatformRun fast = run_scenes({"demo"}, {{"profile", "a9-O2"}}, System::ps_only);
  const PlatformRun scaled = run_scenes({"demo"}, {{"sw.opt", "O2"}}, System::ps_only);
  BOOST_TEST(thesis.facts.profile == "thesis");
  BOOST_TEST(fast.facts.profile == "a9-O2");
  BOOST_TEST(scaled.facts.profile == "thesis-O2");
  check_same_results(thesis, fast);
  check_same_results(thesis, scaled);
  BOOST_TEST(stage_us(fast.frames[0], "frame") < stage_us(thesis.frames[0], "frame"));
  BOOST_TEST(stage_us(scaled.frames[0], "frame") < stage_us(thesis.frames[0], "frame"));
}

BOOST_AUTO_TEST_CASE(memory_stalls_do_not_follow_the_cpu_clock) {
  const Settings half{{"ps.cpu_clk.frequency", "333333333 Hz"}};
  const PlatformRun full_run = run_scenes({"squares15"}, {}, System::ps_only);
  const PlatformRun half_run = run_scenes({"squares15"}, half, System::ps_only);
  const double ratio = stage_us(half_run.frames[0], "corner_detection") /
                       stage_us(full_run.frames[0], "corner_detection");
  BOOST_TEST(std::abs(stage_us(half_run.frames[0], "capture") -
                      stage_us(full_run.frames[0], "capture")) < 2,
             "the camera has its own clock");
  BOOST_TEST(ratio < 1.99);
  BOOST_TEST(ratio > 1.5);
}

BOOST_AUTO_TEST_SUITE_END()
