#include <zynq/frame_bench.h>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/unit.h>
#include <algorithm>
#include <cstring>

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

FrameBench::FrameBench(Zynq& zynq, const SoftwareOptions& options, const vp::ReportRouter& reports)
    : zynq_(zynq),
      cache_contract_(zynq),
      handshake_(zynq),
      spin_watch_(zynq),
      options_(options),
      reports_(reports) {
  const pl::Geometry geometry = zynq_.pl.geometry();
  const auto address = zynq_.ps.ddr.dma_memory().allocate(geometry.pixels(), 4096);
  if (!address) throw vp::InputError("ps.ddr.size leaves no memory for an image");
  frame_.width = geometry.width;
  frame_.height = geometry.height;
  frame_.bus_address = *address;
  frame_.pixels = zynq_.ps.ddr.at(*address, geometry.pixels());
  zynq_.pl.sensor_input.frame_ena.attach(*this);
}

void FrameBench::start(NextFrame next, FrameDone done) {
  next_ = std::move(next);
  done_ = std::move(done);
}

// The threshold of a frame is the one in use when it starts; it changes at the frame's end.
void FrameBench::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() != 0) threshold_ = zynq_.pl.global_threshold.active_threshold;
}

const hal_frame* FrameBench::next_frame(std::uint64_t) {
  const input::InputFrame* frame = stop_ ? nullptr : next_();
  if (!frame) return nullptr;
  place(*frame);
  return &frame_;
}

// A program that does not upload its images finds them in the image store.
void FrameBench::place(const input::InputFrame& frame) {
  if (options_.value("upload", 1) < 0.5) zynq_.pl.bram.load(frame.image.pixels);
  std::memcpy(zynq_.ps.ddr.at(frame_.bus_address, frame.image.pixels.size()),
              frame.image.pixels.data(), frame.image.pixels.size());
  cache_contract_.placed(frame_.bus_address, frame.image.pixels.size());
  frame_.index = frames_++;
  frame_.fx = frame.camera.fx;
  frame_.fy = frame.camera.fy;
  frame_.cx = frame.camera.cx;
  frame_.cy = frame.camera.cy;
}

void FrameBench::publish(std::uint32_t kind, const void* data, std::size_t size,
                         std::uint64_t now_ps) {
  if (kind != marker::frame_result_kind || size != sizeof(marker::FrameResult)) {
    throw vp::ProtocolError(
        "the program published a result of unknown kind or size: build it against the HAL and "
        "marker headers of this version" +
        zynq_.ps.cpu.where());
  }
  // Static: a result is too large for the stack of the program's thread.
  static marker::FrameResult result;
  std::memcpy(&result, data, size);
  cache_contract_.published();
  report::FrameReport report = report_of(result, now_ps);
  add_counts(report);
  if (result.has_threshold) report.counts.label_overflow = result.label_overflow;
  add_warnings(report, result);
  stop_ = !done_(std::move(report)) || stop_;
}

double FrameBench::option(std::uint32_t option, const hal_option_info&) {
  return options_.value(option);
}

report::FrameReport FrameBench::report_of(const marker::FrameResult& result,
                                          std::uint64_t now_ps) const {
  report::FrameReport report;
  report.index = result.frame;
  if (result.status != marker::Status::ok) report.gave_up = marker::status_name(result.status);
  report.threshold = result.has_threshold ? result.threshold : threshold_;
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
  auto duration = [&](const marker::StageTime& stage) {
    return zynq_.ps.cpu_clk.clk.duration_ps(2.0 * static_cast<double>(stage.end - stage.start));
  };
  const marker::StageTimes& t = result.times;
  const std::uint64_t start_ps = now_ps - duration(t.frame);
  auto stage = [&](const char* name, const marker::StageTime& time,
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
  return report;
}

void FrameBench::add_counts(report::FrameReport& report) const {
  zynq_.settle();
  report.counts.feature_overflow = zynq_.pl.feature_packaging.feature_overflow;
  report.counts.label_overflow = zynq_.pl.blob_detection.label_overflow;
  report.counts.bridge_overflow = zynq_.pl.axi_threshold_bridge.bridge_overflow;
  report.counts.crossing_overflow = zynq_.pl.clock_crossing.crossing_overflow;
}

void FrameBench::add_warnings(report::FrameReport& report, const marker::FrameResult& result) {
  if (!report.delivered()) report.warnings.push_back("the software gave up: " + report.gave_up);
  auto lost = [&](std::uint64_t count, const char* what) {
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
  const std::uint64_t stray = handshake_.finish_frame();
  spin_watch_.finish();
  if (stray > 1) lost(stray, "toggles of `ready` with nothing to acknowledge");
  take_new_warnings(report.warnings);
}

void FrameBench::take_new_warnings(std::vector<std::string>& list) {
  const auto& all = reports_.warnings();
  for (; warnings_reported_ < all.size(); ++warnings_reported_) {
    const vp::Warning& w = all[warnings_reported_];
    list.push_back(w.where + ": " + w.message + " (" + w.id + " at " + vp::format_time(w.time_ps) +
                   ")");
  }
}

std::vector<std::string> FrameBench::finish() {
  handshake_.finish_frame();
  spin_watch_.finish();
  std::vector<std::string> list;
  take_new_warnings(list);
  return list;
}

}  // namespace platform
