#include <zynq/timeline_recorder.h>

#include <algorithm>

namespace platform {

namespace {

struct EngineName {
  const char* group;
  const char* name;
};

// In the order of TimelineRecorder::Engine.
constexpr EngineName engine_names[] = {{"Frame", "Frame"},
                                       {"PL", "Sensor input"},
                                       {"PL", "Corners, threshold"},
                                       {"PL", "Blob detection"},
                                       {"DMA", "DMA 0, image in"},
                                       {"DMA", "DMA 1, binary out"},
                                       {"Interrupts", "IRQ of DMA 0"},
                                       {"Interrupts", "IRQ of DMA 1"},
                                       {"Interrupts", "Handler"},
                                       {"PS", "PS stage"},
                                       {"PS", "PS function"}};

// Ids of signals that are no engine's.
constexpr std::uint32_t level_id = 100;

}  // namespace

TimelineRecorder::TimelineRecorder(Zynq& zynq, std::uint32_t frames) : zynq_(zynq), left_(frames) {
  if (frames == 0) return;
  for (const EngineName& name : engine_names) {
    timeline_.tracks.push_back({name.group, name.name, {}});
  }
  const auto depth = static_cast<double>(zynq_.pl.feature_packaging.buffer_depth);
  const auto bridge_depth = static_cast<double>(zynq_.pl.axi_threshold_bridge.fifo_depth);
  timeline_.counters = {{"Corner buffer", "words", depth, {}},
                        {"Blob buffer", "words", depth, {}},
                        {"Bridge FIFO, most in a burst", "words", bridge_depth, {}}};
  watch(zynq_.pl.sensor_input.frame_ena, sensor);
  watch(zynq_.pl.frame_status.busy, corners);
  watch(zynq_.pl.blob_detection.idle, blobs);
  watch(zynq_.pl.axi_dma_0.mm2s_introut, irq_dma_0);
  watch(zynq_.pl.axi_dma_1.s2mm_introut, irq_dma_1);
  watch(zynq_.ps.cpu.in_handler, handler);
  watch(zynq_.ps.cpu.function, functions);
  watch(zynq_.pl.feature_packaging.corner_count, level_id + corner_buffer);
  watch(zynq_.pl.feature_packaging.blob_count, level_id + blob_buffer);
  watch_transfers(zynq_.pl.axi_dma_0.mm2s(), dma_0);
  watch_transfers(zynq_.pl.axi_dma_1.s2mm(), dma_1);
  handshake_.emplace(zynq);
}

void TimelineRecorder::watch(vp::SignalBase& signal, std::uint32_t id) {
  signal.attach(*this, id);
  watched_.push_back(&signal);
}

void TimelineRecorder::watch_transfers(xilinx::DmaChannel& channel, Engine engine) {
  channels_.push_back(&channel);
  channel.on_transfer([this, engine](bool begins) {
    if (engine == dma_1) {
      if (begins) bridge_burst_done();
      (begins ? burst_ : burst_end_) = zynq_.scheduler.now_ps();
    }
    if (begins) return begin(engine, "transfer");
    end(engine);
  });
}

// At the next transfer: its packet cannot have passed yet, at either fidelity.
void TimelineRecorder::bridge_burst_done() {
  if (!burst_ || !burst_end_) return;
  pl::AxiThresholdBridgeClocked& bridge = zynq_.pl.axi_threshold_bridge;
  bridge.settle();
  const auto peak = static_cast<double>(bridge.packet_peak());
  timeline_.counters[bridge_fifo].points.push_back({*burst_, peak});
  burst_.reset();
  burst_end_.reset();
}

void TimelineRecorder::stop() {
  left_ = 0;
  if (handshake_) handshake_->stop();
  for (vp::SignalBase* signal : watched_) signal->detach(*this);
  for (xilinx::DmaChannel* channel : channels_) channel->on_transfer(nullptr);
  watched_.clear();
  channels_.clear();
}

void TimelineRecorder::on_change(vp::SignalBase& signal, std::uint32_t id) {
  const std::uint64_t value = signal.bits();
  if (id >= level_id) {
    timeline_.counters[id - level_id].points.push_back(
        {zynq_.scheduler.now_ps(), static_cast<double>(value)});
    return;
  }
  const auto engine = static_cast<Engine>(id);
  end(engine);
  if (engine == functions) {
    const auto& known = zynq_.ps.cpu.activity().functions();
    if (value != 0 && value <= known.size()) begin(engine, known[value - 1].name);
  } else if (engine == blobs ? value == 0 : value != 0) {
    constexpr const char* names[] = {"frame",    "frame",   "frame",   "frame",  "transfer",
                                     "transfer", "pending", "pending", "handler"};
    begin(engine, names[engine]);
  }
}

void TimelineRecorder::begin(Engine engine, const std::string& name) {
  open_[engine] = {zynq_.scheduler.now_ps(), timeline_.name(name)};
}

void TimelineRecorder::end(Engine engine) {
  const auto open = open_[engine];
  open_[engine].reset();
  const std::uint64_t now = zynq_.scheduler.now_ps();
  if (open && now > open->start_ps) {
    timeline_.tracks[engine].spans.push_back({open->start_ps, now - open->start_ps, open->name});
  }
}

void TimelineRecorder::add_span(Engine engine, const std::string& name, std::uint64_t start_ps,
                                std::uint64_t end_ps, bool critical) {
  if (end_ps <= start_ps) return;
  // Durations of the software's stamps are rounded to ps: two that follow may seem to overlap.
  auto& spans = timeline_.tracks[engine].spans;
  if (!spans.empty() && spans.back().start_ps + spans.back().length_ps == start_ps + 1) {
    --spans.back().length_ps;
  }
  spans.push_back({start_ps, end_ps - start_ps, timeline_.name(name), critical});
}

void TimelineRecorder::frame_done(const report::FrameReport& done) {
  if (left_ == 0) return;
  if (const auto last_end = burst_end_) {
    bridge_burst_done();
    timeline_.counters[bridge_fifo].points.push_back({*last_end, 0});
  }
  timeline_.frames.push_back({done.index, done.start_ps, done.end_ps});
  for (const report::StageTime& stage : done.times) {
    if (stage.name == "upload")
      add_span(frame, "upload", stage.start_ps, stage.start_ps + stage.ps);
  }
  add_span(frame, "frame", done.start_ps, done.end_ps);
  mark_critical_path(done);
  if (!handshake_->empty()) timeline_.handshakes = {handshake_->handshake()};
  if (--left_ == 0) stop();
}

/// The stages of the PS follow one another, so all are critical; while they wait for the logic, its
/// slowest engine is in their place: that which ends last, and what feeds it.
void TimelineRecorder::mark_critical_path(const report::FrameReport& done) {
  for (const report::StageTime& stage : done.times) {
    if (stage.part_of.empty() || report::has_parts(done.times, stage.name)) continue;
    const bool waits = stage.name == "feature_extraction";
    add_span(stages, stage.name, stage.start_ps, stage.start_ps + stage.ps, !waits);
    if (!waits) continue;
    for (const Engine engine : {sensor, blobs}) {
      for (report::Timeline::Span& span : timeline_.tracks[engine].spans) {
        span.critical |=
            span.start_ps >= stage.start_ps && span.start_ps < stage.start_ps + stage.ps;
      }
    }
  }
}

}  // namespace platform
