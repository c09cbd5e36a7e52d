#include <designs/marker/frame_report.h>

#include <algorithm>
#include <string>
#include <vector>

namespace platform {

namespace {

report::FoundMarker found_marker(const marker::Marker& m) {
  report::FoundMarker found;
  found.id = m.identity.id;
  found.rotation = m.identity.rotation;
  for (std::size_t i = 0; i < 4; ++i) found.corners_px[i] = {m.corners[i].x, m.corners[i].y};
  found.has_pose = m.pose.valid;
  found.pose.rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(m.pose.rotation.data());
  found.pose.translation = Eigen::Vector3d::Map(m.pose.translation.data());
  found.reprojection_px = m.pose.reprojection_px;
  found.iterations = m.pose.iterations;
  return found;
}

report::Features features_of(const marker::FrameResult& result) {
  report::Features features;
  const auto& set = result.features;
  features.corners.assign(set.corners.begin(), set.corners.begin() + set.corner_count);
  features.blobs.assign(set.blobs.begin(), set.blobs.begin() + set.blob_count);
  for (std::uint32_t i = 0; i < result.candidates.count; ++i) {
    const marker::Quad q =
        marker::swap_bottom(marker::candidate_corners(set, result.candidates.candidates[i]));
    features.candidates.push_back(
        {{{q[0].x, q[0].y}, {q[1].x, q[1].y}, {q[2].x, q[2].y}, {q[3].x, q[3].y}}});
  }
  return features;
}

}  // namespace

void fill_in(report::FrameReport& report, const marker::FrameResult& result, std::uint64_t now_ps,
             const vp::Clock& cpu_clk) {
  report.index = result.frame;
  if (result.status != marker::Status::ok) report.gave_up = marker::status_name(result.status);
  if (result.has_threshold) report.threshold = result.threshold;
  report.counts.corners = result.features.corner_count + result.features.lost_corners;
  report.counts.blobs = result.features.blob_count + result.features.lost_blobs;
  report.counts.feature_words = result.feature_words;
  report.counts.candidates = result.candidates.count + result.candidates.lost;
  report.counts.software_overflow = std::uint64_t{result.lost_words} +
                                    result.features.lost_corners + result.features.lost_blobs +
                                    result.candidates.lost;
  report.counts.malformed = result.features.malformed;
  for (std::uint32_t i = 0; i < result.marker_count; ++i)
    report.markers.push_back(found_marker(result.markers[i]));
  // Stamps count pairs of CPU cycles.
  const auto duration = [&](const marker::StageTime& stage) {
    return cpu_clk.duration_ps(2.0 * static_cast<double>(stage.end - stage.start));
  };
  const marker::StageTimes& t = result.times;
  const std::uint64_t start_ps = now_ps - duration(t.frame);
  const auto stage = [&](const char* name, const marker::StageTime& time,
                         const char* part_of) -> report::StageTime {
    // The upload begins before the frame.
    const bool before = time.start < t.frame.start;
    const std::uint64_t away =
        before ? duration({time.start, t.frame.start}) : duration({t.frame.start, time.start});
    return {name, duration(time), before ? start_ps - std::min(start_ps, away) : start_ps + away,
            part_of};
  };
  constexpr const char* whole = "frame";
  constexpr const char* extraction = "feature_extraction";
  report.times = {stage("upload", t.upload, ""),
                  stage(extraction, t.feature_extraction, whole),
                  stage("receive", t.receive, whole),
                  stage("evaluation", t.evaluation, whole),
                  stage("identification", t.identification, whole),
                  stage("pose", t.pose, whole),
                  stage(whole, t.frame, "")};
  if (t.capture.end != 0) {
    const std::vector<report::StageTime> parts = {
        stage("capture", t.capture, extraction),
        stage("corner_detection", t.corner_detection, extraction),
        stage("threshold", t.threshold, extraction),
        stage("blob_detection", t.blob_detection, extraction)};
    report.times.insert(report.times.begin() + 1, parts.begin(), parts.end());
  }
  report.end_ps = now_ps;
  report.start_ps = start_ps;
  report.upload_ps = duration(t.upload);
  report.features = features_of(result);
}

void add_losses(report::FrameReport& report, const marker::FrameResult& result) {
  if (!report.delivered()) report.warnings.push_back("the software gave up: " + report.gave_up);
  const auto lost = [&](std::uint64_t count, const char* what) {
    if (count != 0) report.warnings.push_back(std::to_string(count) + " " + what);
  };
  lost(report.counts.feature_overflow,
       "features dropped: a buffer of pl.feature_packaging was full");
  lost(report.counts.label_overflow,
       result.has_threshold ? "dark pixels without label: sw.label_count is too small"
                            : "dark pixels without label: pl.blob_detection has too few");
  lost(report.counts.bridge_overflow, "binary words dropped: DMA 1 was not armed again in time");
  lost(report.counts.crossing_overflow,
       "words lost between the clocks: the system clock is too slow");
  lost(result.lost_words, "feature words without room in the software");
  lost(result.features.lost_corners,
       "corners without room in the software: no marker is found there");
  lost(result.features.lost_blobs, "blobs without room in the software: no marker is found there");
  lost(result.candidates.lost, "candidates without room in the software: they are not examined");
  lost(result.features.malformed,
       "malformed blobs: a start or end word without the other, or an end before the start");
}

}  // namespace platform
