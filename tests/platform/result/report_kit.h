#pragma once

#include <facts/result.h>
#include <marker/report/marker_frame.h>
#include <marker/scene/scene.h>

namespace report_test {

/// A frame as it counts.
inline platform::facts::UnitReport judged(platform::facts::UnitReport frame) {
  frame.failures.clear();
  frame.tallies.clear();
  platform::judge(frame);
  return frame;
}

/// The frame of a scene in which the marker was found, with known small errors.
inline platform::facts::UnitReport found_frame(const std::string& scene, std::uint32_t index = 0,
                                               std::uint64_t losses = 0) {
  using namespace platform;
  facts::UnitReport frame;
  frame.input = scene;
  frame.index = index;
  marker_frame(frame).threshold = 128;
  frame.counts.set("corners", 31);
  frame.counts.set("blobs", 2);
  frame.counts.set("feature_words", 36);
  frame.counts.set("candidates", 1);
  frame.counts.lose("feature_overflow", losses);
  marker_frame(frame).truth = ground_truth(make_scene(scene));
  FoundMarker marker;
  marker.id = marker_frame(frame).truth->marker_id;
  marker.corners_px = marker_frame(frame).truth->corners_px;
  marker.corners_px[0].x += 2;
  marker.pose = marker_frame(frame).truth->pose;
  marker.pose.translation[2] += 0.012;
  marker.reprojection_px = 0.25;
  marker.iterations = 3;
  marker_frame(frame).markers.push_back(marker);
  platform::judge(frame);
  frame.upload_ps = 3'000'000'000;
  frame.start_ps = index * 11'000'000'000ull + frame.upload_ps;
  frame.end_ps = frame.start_ps + 8'000'000'000;
  frame.times = {
      {"upload", frame.upload_ps},
      {"feature_extraction", 6'144'500'000, 0, "frame", "ps.fclk_clk1", "one pixel a clock"},
      {"pose", 123'456, 0, "frame"},
      {"frame", 8'000'000'000}};
  return frame;
}

/// The same frame, given up when it would have ended.
inline platform::facts::UnitReport given_up_frame(const std::string& scene,
                                                  std::uint32_t index = 0) {
  platform::facts::UnitReport frame = found_frame(scene, index);
  frame.gave_up = "binary image timed out";
  platform::marker_frame(frame).markers.clear();
  return judged(frame);
}

inline platform::facts::RunFacts run_facts() {
  return {"clocked", "hybrid",
          "thesis",  platform::marker_work(),
          "assumed", {{"pl.clk", "50 MHz"}, {"ps.clk", "667 MHz"}}};
}

inline platform::facts::Provenance provenance() {
  platform::facts::Provenance origin;
  origin.program = "markervp";
  origin.version = "0.1.0";
  origin.configuration_hash = "0123456789abcdef";
  origin.command_line = {"run", "z1.0"};
  origin.host = "here";
  origin.date = "2026-11-21T12:00:00Z";
  origin.wall_time_s = 1.23456;
  origin.details = {{"output", "out"}};
  return origin;
}

}  // namespace report_test
