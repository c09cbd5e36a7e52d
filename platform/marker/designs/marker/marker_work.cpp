#include <marker/designs/marker/marker_work.h>

#include <chip/cost/parts.h>
#include <facts/result.h>
#include <marker/input/image_need.h>
#include <marker/report/marker_frame.h>
#include <marker/result.h>
#include <vp/clock.h>
#include <xilinx/common/axi_lite_ip.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <utility>

namespace platform {

namespace {

// Their order is that of reports: own IP as in the thesis' table 4.1, then table 4.2.
void name_groups(const MarkerParts& parts) {
  unsigned place = 0;
  const auto group = [&place](const char* name, std::initializer_list<vp::Ip*> list) {
    for (vp::Ip* part : list) part->set_group(name, place++);
  };
  if (pl::FeatureExtraction* pl = parts.models) {
    group("feature_extraction",
          {&pl->corner_detection, &pl->global_threshold, &pl->blob_detection});
    group("image_memory", {&pl->sensor_input, &pl->bram, &pl->axi_image_store});
    group("data_bridge", {&pl->clock_crossing, &pl->control_block, &pl->feature_packaging,
                          &pl->axi_threshold_bridge});
  }
  group("image_memory", {&parts.image_dma});
  group("data_bridge", {&parts.binary_dma, &parts.control, &parts.features, &parts.axi_interconnect,
                        &parts.axi_mem_interconnect, &parts.proc_sys_reset});
}

// The upload of an image is no frame's work: in the thesis' system a sensor is in its place.
void count_work(const MarkerParts& parts) {
  parts.image_dma.set_active_clocks([] { return std::uint64_t{0}; });
  const auto words_out = [&dma = parts.binary_dma] { return dma.beats(); };
  if (parts.models) parts.models->axi_threshold_bridge.set_active_clocks(words_out);
  parts.axi_mem_interconnect.set_active_clocks(words_out);
  parts.axi_interconnect.set_active_clocks(
      [&control = parts.control, &features = parts.features, &dma = parts.binary_dma] {
        return xilinx::clocks_per_access *
               (xilinx::accesses(control.s_axi) + xilinx::accesses(features.s_axi) +
                xilinx::accesses(dma.s_axi_lite));
      });
}

}  // namespace

void arrange(const MarkerParts& parts) {
  name_groups(parts);
  count_work(parts);
}

namespace {

FoundMarker found_marker(const marker::Marker& m, double side_m) {
  FoundMarker found;
  found.side_m = side_m;
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

Features features_of(const marker::FrameResult& result) {
  Features features;
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

/// Fills in what the software knows of a frame that it published at `now_ps`: times, counts,
/// markers, features. Its stamps count pairs of cycles of `cpu_clk`; pixels come with the clock
/// called `pixel_clk`; `levers` make the software faster.
void fill_in(facts::UnitReport& report, const marker::FrameResult& result, std::uint64_t now_ps,
             const vp::Clock& cpu_clk, const std::string& pixel_clk,
             const std::vector<std::string>& levers, double side_m) {
  report.index = result.frame;
  if (result.status != marker::Status::ok) report.gave_up = marker::status_name(result.status);
  MarkerFrame& found = marker_frame(report);
  if (result.has_threshold) found.threshold = result.threshold;
  for (std::uint32_t i = 0; i < result.marker_count; ++i)
    found.markers.push_back(found_marker(result.markers[i], side_m));
  // Stamps count pairs of CPU cycles.
  const auto duration = [&](const marker::StageTime& stage) {
    return cpu_clk.duration_ps(2.0 * static_cast<double>(stage.end - stage.start));
  };
  const marker::StageTimes& t = result.times;
  const std::uint64_t start_ps = now_ps - duration(t.frame);
  const auto stage = [&](const char* name, const marker::StageTime& time, const char* part_of,
                         const char* why = "") -> facts::StageTime {
    // The upload begins before the frame.
    const bool before = time.start < t.frame.start;
    const std::uint64_t away =
        before ? duration({time.start, t.frame.start}) : duration({t.frame.start, time.start});
    return {name,
            duration(time),
            before ? start_ps - std::min(start_ps, away) : start_ps + away,
            part_of,
            "",
            why};
  };
  constexpr const char* whole = "frame";
  constexpr const char* extraction = "feature_extraction";
  report.times = {stage("upload", t.upload, ""),
                  stage(extraction, t.feature_extraction, whole),
                  stage("receive", t.receive, whole),
                  stage("evaluation", t.evaluation, whole),
                  stage("identification", t.identification, whole,
                        "candidates are tried one after the other until one is a marker"),
                  stage("pose", t.pose, whole),
                  stage(whole, t.frame, "")};
  if (t.capture.end != 0) {
    const std::vector<facts::StageTime> parts = {
        stage("capture", t.capture, extraction),
        stage("corner_detection", t.corner_detection, extraction),
        stage("threshold", t.threshold, extraction),
        stage("blob_detection", t.blob_detection, extraction)};
    report.times.insert(report.times.begin() + 1, parts.begin(), parts.end());
  } else {
    report.times[1].clock = pixel_clk;
    report.times[1].why = "one pixel a clock, so it lasts as long as the image does";
  }
  for (facts::StageTime& time : report.times) {
    const bool is_software = time.clock.empty() && time.name != "capture";
    if (is_software && !time.part_of.empty()) time.levers = levers;
  }
  report.end_ps = now_ps;
  report.start_ps = start_ps;
  found.taken_ps = start_ps;
  report.upload_ps = duration(t.upload);
  found.features = features_of(result);
}

/// What was found, and what was lost: in the logic, between the clocks, in the software.
facts::Counts counts_of(const marker::FrameResult& result, const MarkerParts& parts) {
  facts::Counts counts;
  counts.set("corners", result.features.corner_count + result.features.lost_corners);
  counts.set("blobs", result.features.blob_count + result.features.lost_blobs);
  counts.set("feature_words", result.feature_words);
  counts.set("candidates", result.candidates.count + result.candidates.lost);
  counts.lose("feature_overflow", parts.feature_overflow.bits());
  counts.lose("label_overflow", result.has_threshold ? std::uint64_t{result.label_overflow}
                                                     : parts.label_overflow.bits());
  counts.lose("bridge_overflow", parts.bridge_overflow.bits());
  counts.lose("crossing_overflow", parts.crossing_overflow.bits());
  counts.lose("software_overflow", std::uint64_t{result.lost_words} + result.features.lost_corners +
                                       result.features.lost_blobs + result.candidates.lost);
  counts.lose("malformed", result.features.malformed);
  return counts;
}

/// Adds the warnings that follow from the frame's counts and the software's own.
void add_losses(facts::UnitReport& report, const marker::FrameResult& result) {
  if (!report.delivered()) report.warnings.push_back("the software gave up: " + report.gave_up);
  const auto lost = [&](std::uint64_t count, const char* what) {
    if (count != 0) report.warnings.push_back(std::to_string(count) + " " + what);
  };
  lost(report.counts["feature_overflow"],
       "features dropped: a buffer of pl.feature_packaging was full; raise its buffer_depth");
  lost(report.counts["label_overflow"],
       result.has_threshold
           ? "dark pixels without label: sw.label_count is too small"
           : "dark pixels without label: pl.blob_detection.label_count is too small");
  lost(report.counts["bridge_overflow"],
       "binary words dropped: DMA 1 was not armed again in time for "
       "pl.axi_threshold_bridge.fifo_depth");
  lost(report.counts["crossing_overflow"],
       "words lost between the clocks: the system clock is too slow");
  lost(result.lost_words, "feature words without room in the software");
  lost(result.features.lost_corners,
       "corners without room in the software: no marker is found there");
  lost(result.features.lost_blobs, "blobs without room in the software: no marker is found there");
  lost(result.candidates.lost, "candidates without room in the software: they are not examined");
  lost(result.features.malformed,
       "malformed blobs: a start or end word without the other, or an end before the start");
}

}  // namespace

void BlobFigure::add() {
  options_.emplace("blob");
}

BlobFigure::Options::Options(sc_core::sc_module_name name)
    : sc_module(name),
      figure_includes_static(
          "figure_includes_static", false, vp::Source::decision,
          "whether the thesis' 0.4 W of blob detection (4.6.1) include 0.105 W of static power") {}

MarkerWork::MarkerWork(const MarkerParts& parts, PlPorts& ports)
    : parts_(parts), ports_(ports), handshake_(parts, ports.ps.cpu, ports.scheduler) {
  parts_.frame_ena.attach(*this);
}

facts::Work MarkerWork::work() const {
  return marker_work();
}

facts::InputNeed MarkerWork::input() const {
  return input::image_need(
      {static_cast<int>(parts_.geometry.width), static_cast<int>(parts_.geometry.height)});
}

void MarkerWork::describe(const facts::UnitInput& input, hal_frame& frame) const {
  input::describe_camera(input, frame);
}

void MarkerWork::check(facts::UnitReport& frame) {
  take_truth(frame);
  judge(frame);
}

std::optional<double> MarkerWork::program_option(const std::string& name) const {
  if (name != "burst_words") return std::nullopt;
  return parts_.geometry.burst_words;
}

// The threshold of a frame is the one in use when it starts; it changes at the frame's end.
void MarkerWork::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() != 0) threshold_ = static_cast<std::uint8_t>(parts_.active_threshold.bits());
}

bool MarkerWork::report(const Publication& publication, facts::UnitReport& frame) {
  if (publication.kind != marker::frame_result_kind ||
      publication.size != sizeof(marker::FrameResult)) {
    return false;
  }
  // Static: a result is too large for the stack of the program's thread.
  static marker::FrameResult result;
  std::memcpy(&result, publication.data, publication.size);
  marker_frame(frame).threshold = threshold_;
  std::vector<std::string> levers;
  if (is_unoptimised_) levers.emplace_back("sw.opt=O2");
  fill_in(frame, result, publication.ps, ports_.ps.cpu_clk.clk, name_of(parts_.pixel_clk), levers,
          marker_side_m_);
  frame.counts = counts_of(result, parts_);
  add_losses(frame, result);
  const std::uint64_t stray = handshake_.finish_frame();
  if (stray > 1) {
    frame.warnings.push_back(std::to_string(stray) +
                             " toggles of `ready` with nothing to acknowledge");
  }
  return true;
}

std::vector<std::string> MarkerWork::groups() const {
  return {"feature_extraction", "data_bridge", "image_memory"};
}

std::vector<Design::ClockRole> MarkerWork::clock_roles() {
  return {{"pixel", &parts_.pixel_clk, "feature_extraction"},
          {"system", &parts_.system_clk, "data_bridge"}};
}

vp::Signal<bool>* MarkerWork::busy() {
  return parts_.models ? &parts_.models->sensor_input.frame_ena : nullptr;
}

void MarkerWork::place(const facts::SharedInput& input) {
  if (parts_.models) parts_.models->bram.load(input->bytes());
}

void MarkerWork::settle() {
  if (parts_.models) parts_.models->settle();
}

TimelineEngines MarkerWork::timeline() {
  TimelineEngines shown;
  shown.channels = {
      {"DMA 0, image in", &parts_.image_dma.mm2s(), "IRQ of DMA 0", &parts_.image_dma.mm2s_introut},
      {"DMA 1, binary out", &parts_.binary_dma.s2mm(), "IRQ of DMA 1",
       &parts_.binary_dma.s2mm_introut}};
  if (parts_.models) show_models(*parts_.models, shown);
  shown.waiting = "feature_extraction";
  return shown;
}

void MarkerWork::show_models(pl::FeatureExtraction& pl, TimelineEngines& shown) {
  constexpr bool active_low = true, critical = true;
  const auto depth = static_cast<double>(pl.feature_packaging.buffer_depth);
  shown.engines = {{"Sensor input", &pl.sensor_input.frame_ena, !active_low, critical},
                   {"Corners, threshold", &pl.frame_status.busy},
                   {"Blob detection", &pl.blob_detection.idle, active_low, critical}};
  shown.levels = {{"Corner buffer", "words", depth, &pl.feature_packaging.corner_count},
                  {"Blob buffer", "words", depth, &pl.feature_packaging.blob_count}};
  shown.peaks = {{"Bridge FIFO, most in a burst", "words",
                  static_cast<double>(pl.axi_threshold_bridge.fifo_depth), 1,
                  [&bridge = pl.axi_threshold_bridge] {
                    bridge.settle();
                    return static_cast<double>(bridge.packet_peak());
                  }}};
  shown.handshake = {"Feature words", &pl.control_block.ena, &pl.feature_packaging.feature,
                     &pl.control_block.ready, [&sensor = pl.sensor_input](std::uint64_t word) {
                       const std::string text = marker_words().meaning(
                           word, {sensor.pixel_x.width(), sensor.pixel_y.width()});
                       return text.substr(text.rfind('?') + 1);  // behind GTKWave's colour
                     }};
}

}  // namespace platform
