#include <marker/designs/marker/marker_design.h>

#include <axi_gpio_registers.h>
#include <facts/result.h>
#include <marker/input/image_need.h>
#include <marker/report/marker_frame.h>
#include <marker/result.h>
#include <marker_logic.h>
#include <vp/clock.h>
#include <vp/error.h>
#include <vp/register_bank.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/common/axi_lite_ip.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace platform {

namespace {

namespace addresses = marker_logic::addresses;

xilinx::AxiGpioBuild gpio(xilinx::GpioDirection direction) {
  xilinx::AxiGpioBuild build;
  build.gpio.direction = direction;
  return build;
}

xilinx::AxiDmaBuild one_channel(bool mm2s, std::uint32_t burst_words) {
  xilinx::AxiDmaBuild build;
  build.include_mm2s = mm2s;
  build.include_s2mm = !mm2s;
  build.mm2s_burst_beats = build.s2mm_burst_beats = burst_words;
  return build;
}

/// LENGTH must hold a burst.
void check_length(const xilinx::AxiDma& dma, std::uint32_t burst_words) {
  const std::uint64_t bytes = std::uint64_t{burst_words} * marker_logic::bytes_per_word;
  if (bytes < std::uint64_t{1} << dma.length_width) return;
  throw vp::InputError(std::string(dma.length_width.name()) + " is " +
                       std::to_string(dma.length_width) + ": a burst of " +
                       std::to_string(burst_words) + " words (pl.burst_words) has " +
                       std::to_string(bytes) + " bytes and needs " +
                       std::to_string(marker_logic::bits_for(bytes + 1, 8)));
}

}  // namespace

ProgrammableLogic::ProgrammableLogic(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk, pl::Fidelity otherwise,
                                     const pl::Models<pl::PixelFilter>* filter)
    : FeatureExtraction(name, system_clk, pixel_clk, otherwise, filter),
      proc_sys_reset("proc_sys_reset", system_clk),
      axi_interconnect("axi_interconnect", system_clk),
      axi_mem_interconnect("axi_mem_interconnect", system_clk),
      axi_gpio_0("axi_gpio_0", system_clk, gpio(xilinx::GpioDirection::all_outputs)),
      axi_gpio_1("axi_gpio_1", system_clk, gpio(xilinx::GpioDirection::all_inputs)),
      axi_dma_0("axi_dma_0", system_clk, one_channel(true, burst_words)),
      axi_dma_1("axi_dma_1", system_clk, one_channel(false, burst_words)),
      concat("concat", 2) {
  for (const xilinx::AxiDma* dma : {&axi_dma_0, &axi_dma_1}) check_length(*dma, burst_words);
  axi_interconnect.connect(axi_dma_0.s_axi_lite, addresses::dma_image);
  axi_interconnect.connect(axi_dma_1.s_axi_lite, addresses::dma_binary);
  axi_interconnect.connect(axi_gpio_0.s_axi, addresses::gpio_control);
  axi_interconnect.connect(axi_gpio_1.s_axi, addresses::gpio_features);

  axi_gpio_0.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_gpio_1.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_0.axi_resetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_1.axi_resetn(proc_sys_reset.peripheral_aresetn);
  por()(proc_sys_reset.peripheral_reset);

  gpio_in()(axi_gpio_0.gpio.io_o);
  axi_gpio_1.gpio.io_i(feature_packaging.feature);
  axi_dma_0.mm2s().m_axis(image_stream_link);
  image_stream()(image_stream_link);
  binary_stream()(binary_stream_link);
  axi_dma_1.s2mm().s_axis(binary_stream_link);

  axi_mem_interconnect.connect(axi_dma_0);
  axi_mem_interconnect.connect(axi_dma_1);
  concat.connect_interrupt(axi_dma_0.mm2s_introut, addresses::dma_image_interrupt);
  concat.connect_interrupt(axi_dma_1.s2mm_introut, addresses::dma_binary_interrupt);
  name_groups();
  count_work();
}

// Their order is that of reports: own IP as in the thesis' table 4.1, then table 4.2.
void ProgrammableLogic::name_groups() {
  unsigned place = 0;
  const auto group = [&place](const char* name, std::initializer_list<vp::Ip*> parts) {
    for (vp::Ip* part : parts) part->set_group(name, place++);
  };
  group("feature_extraction", {&corner_detection, &global_threshold, &blob_detection});
  group("image_memory", {&sensor_input, &bram, &axi_image_store});
  group("data_bridge",
        {&clock_crossing, &control_block, &feature_packaging, &axi_threshold_bridge});
  group("image_memory", {&axi_dma_0});
  group("data_bridge", {&axi_dma_1, &axi_gpio_0, &axi_gpio_1, &axi_interconnect,
                        &axi_mem_interconnect, &proc_sys_reset});
}

// The upload of an image is no frame's work: in the thesis' system a sensor is in its place.
void ProgrammableLogic::count_work() {
  axi_dma_0.set_active_clocks([] { return std::uint64_t{0}; });
  const auto words_out = [this] { return axi_dma_1.beats(); };
  axi_threshold_bridge.set_active_clocks(words_out);
  axi_mem_interconnect.set_active_clocks(words_out);
  axi_interconnect.set_active_clocks([this] {
    return xilinx::clocks_per_access *
           (xilinx::accesses(axi_gpio_0.s_axi) + xilinx::accesses(axi_gpio_1.s_axi) +
            xilinx::accesses(axi_dma_1.s_axi_lite));
  });
}

namespace {

namespace packet = marker_logic::control;

constexpr std::uint32_t control = 1, feature = 2, frame = 3;  // what changed

}  // namespace

HandshakeWatch::HandshakeWatch(ProgrammableLogic& logic, const ps::Cpu& cpu,
                               const vp::ClockScheduler& scheduler)
    : logic_(logic),
      cpu_(cpu),
      scheduler_(scheduler),
      feature_register_(logic.axi_gpio_1.s_axi[axi_gpio::GPIO_DATA]) {
  logic.axi_gpio_0.gpio.io_o.attach(*this, control);
  logic.feature_packaging.feature.attach(*this, feature);
  logic.sensor_input.frame_ena.attach(*this, frame);
  // Reads that a poll passes over are in the register's count only.
  feature_register_.after_read([this](std::uint32_t word) { register_read(word); });
}

HandshakeWatch::~HandshakeWatch() {
  feature_register_.after_read(nullptr);
}

void HandshakeWatch::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id == control) {
    control_written(static_cast<std::uint32_t>(signal.bits()));
  } else if (id == feature) {
    word_shown(static_cast<std::uint32_t>(signal.bits()));
  } else if (signal.bits() != 0) {
    look_at_polls();
  }
}

// Without `ena` the hardware does not look at `ready`.
void HandshakeWatch::control_written(std::uint32_t word) {
  const bool toggled = ((word ^ packet_) & packet::ready) != 0;
  packet_ = word;
  if ((word & packet::rst) != 0) unacknowledged_ = false;
  if (!toggled || (word & packet::rst) != 0 || (word & packet::ena) == 0) return;
  if (std::exchange(unacknowledged_, false)) return;
  if (stray_toggles_++ != 0) return;
  vp::warn(cpu_, "/markervp/cpu/stray_ready",
           "`ready` was toggled although no feature word waits to be acknowledged: the "
           "toggle is lost or, if a word comes at that moment, takes it away unread; toggle it "
           "once after each "
           "new word in the feature register" +
               cpu_.where());
}

void HandshakeWatch::word_shown(std::uint32_t word) {
  look_at_polls();
  unacknowledged_ = word != 0;  // 0: reset
}

void HandshakeWatch::register_read(std::uint32_t word) {
  if (word != marker_logic::WordFormat::end_of_frame || reads_at_end_ ||
      logic_.feature_packaging.feature.get() != word) {
    return;
  }
  reads_at_end_ = feature_register_.use().reads;
  end_read_ps_ = scheduler_.now_ps();
}

// The end word goes, or a frame is over: the register need not have been read in between.
void HandshakeWatch::look_at_polls() {
  if (!reads_at_end_) return;
  const std::uint64_t more = feature_register_.use().reads - *std::exchange(reads_at_end_, {});
  if (more == 0) return;
  vp::warn(cpu_, "/markervp/cpu/polls_after_end",
           "the feature register was read " + std::to_string(more) +
               " times more after the end word, which the program saw at " +
               vp::format_time(end_read_ps_) +
               ": nothing follows it; start the next frame with `rst`, then `ena`");
}

std::uint64_t HandshakeWatch::finish_frame() {
  look_at_polls();
  return std::exchange(stray_toggles_, 0);
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
/// markers, features. Its stamps count pairs of cycles of `cpu_clk`; `levers` make the software
/// faster.
void fill_in(facts::UnitReport& report, const marker::FrameResult& result, std::uint64_t now_ps,
             const vp::Clock& cpu_clk, const std::vector<std::string>& levers, double side_m) {
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
    report.times[1].clock = "ps.fclk_clk1";
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
facts::Counts counts_of(const marker::FrameResult& result, const ProgrammableLogic& pl) {
  facts::Counts counts;
  counts.set("corners", result.features.corner_count + result.features.lost_corners);
  counts.set("blobs", result.features.blob_count + result.features.lost_blobs);
  counts.set("feature_words", result.feature_words);
  counts.set("candidates", result.candidates.count + result.candidates.lost);
  counts.lose("feature_overflow", pl.feature_packaging.feature_overflow);
  counts.lose("label_overflow",
              result.has_threshold ? result.label_overflow : pl.blob_detection.label_overflow);
  counts.lose("bridge_overflow", pl.axi_threshold_bridge.bridge_overflow);
  counts.lose("crossing_overflow", pl.clock_crossing.crossing_overflow);
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

MarkerDesign::MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
                           const pl::Models<pl::PixelFilter>* filter)
    : ProgrammableLogic(name, ports.fclk_clk(0), ports.fclk_clk(1), ports.fidelity, filter),
      ports_(ports),
      handshake_(*this, ports.ps.cpu, ports.scheduler) {
  ports.m_axi_gp0(axi_interconnect);
  ports.s_axi_hp0(axi_mem_interconnect);
  ports.irq_f2p(concat.dout);
  proc_sys_reset.ext_reset_in(ports.fclk_reset0_n());
  sensor_input.frame_ena.attach(*this);
}

std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports) {
  return std::make_unique<MarkerDesign>(name, ports);
}

void BlobFigure::add() {
  options_.emplace("blob");
}

BlobFigure::Options::Options(sc_core::sc_module_name name)
    : sc_module(name),
      figure_includes_static(
          "figure_includes_static", false, vp::Source::decision,
          "whether the thesis' 0.4 W of blob detection (4.6.1) include 0.105 W of static power") {}

facts::Work MarkerDesign::work() const {
  return marker_work();
}

facts::InputNeed MarkerDesign::input() const {
  return input::image_need(
      {static_cast<int>(geometry().width), static_cast<int>(geometry().height)});
}

void MarkerDesign::describe(const facts::UnitInput& input, hal_frame& frame) const {
  input::describe_camera(input, frame);
}

void MarkerDesign::check(facts::UnitReport& frame) {
  take_truth(frame);
  judge(frame);
}

std::optional<double> MarkerDesign::program_option(const std::string& name) const {
  if (name != "burst_words") return std::nullopt;
  return burst_words.get();
}

// The threshold of a frame is the one in use when it starts; it changes at the frame's end.
void MarkerDesign::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (signal.bits() != 0) threshold_ = global_threshold.active_threshold;
}

bool MarkerDesign::report(const Publication& publication, facts::UnitReport& frame) {
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
  fill_in(frame, result, publication.ps, ports_.ps.cpu_clk.clk, levers, marker_side_m_);
  frame.counts = counts_of(result, *this);
  add_losses(frame, result);
  const std::uint64_t stray = handshake_.finish_frame();
  if (stray > 1) {
    frame.warnings.push_back(std::to_string(stray) +
                             " toggles of `ready` with nothing to acknowledge");
  }
  return true;
}

std::vector<std::string> MarkerDesign::groups() const {
  return {"feature_extraction", "data_bridge", "image_memory"};
}

std::vector<Design::ClockRole> MarkerDesign::clock_roles() {
  return {{"pixel", &ports_.fclk_clk(1), "feature_extraction"},
          {"system", &ports_.fclk_clk(0), "data_bridge"}};
}

TimelineEngines MarkerDesign::timeline() {
  constexpr bool active_low = true, critical = true;
  const auto depth = static_cast<double>(feature_packaging.buffer_depth);
  TimelineEngines shown;
  shown.engines = {{"Sensor input", &sensor_input.frame_ena, !active_low, critical},
                   {"Corners, threshold", &frame_status.busy},
                   {"Blob detection", &blob_detection.idle, active_low, critical}};
  shown.channels = {
      {"DMA 0, image in", &axi_dma_0.mm2s(), "IRQ of DMA 0", &axi_dma_0.mm2s_introut},
      {"DMA 1, binary out", &axi_dma_1.s2mm(), "IRQ of DMA 1", &axi_dma_1.s2mm_introut}};
  shown.levels = {{"Corner buffer", "words", depth, &feature_packaging.corner_count},
                  {"Blob buffer", "words", depth, &feature_packaging.blob_count}};
  shown.peaks = {{"Bridge FIFO, most in a burst", "words",
                  static_cast<double>(axi_threshold_bridge.fifo_depth), 1, [this] {
                    axi_threshold_bridge.settle();
                    return static_cast<double>(axi_threshold_bridge.packet_peak());
                  }}};
  shown.handshake = {"Feature words", &control_block.ena, &feature_packaging.feature,
                     &control_block.ready, [this](std::uint64_t word) {
                       const std::string text = marker_words().meaning(
                           word, {sensor_input.pixel_x.width(), sensor_input.pixel_y.width()});
                       return text.substr(text.rfind('?') + 1);  // behind GTKWave's colour
                     }};
  shown.waiting = "feature_extraction";
  return shown;
}

}  // namespace platform
