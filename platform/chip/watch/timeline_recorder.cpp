#include <chip/watch/timeline_recorder.h>

#include <algorithm>

#include <chip/system/design.h>

namespace platform {

HandshakeRecorder::HandshakeRecorder(const vp::ClockScheduler& scheduler,
                                     const TimelineEngines::Handshake& words)
    : scheduler_(scheduler),
      watched_{words.enable, words.word, words.acknowledge},
      meaning_(words.meaning) {
  handshake_.name = words.name;
  for (std::uint32_t id = 0; id < lines; ++id) {
    handshake_.signals.push_back({watched_[id]->basename(), watched_[id]->width(), {}});
    watched_[id]->attach(*this, id);
  }
}

void HandshakeRecorder::stop() {
  if (!listens_) return;
  listens_ = false;
  for (vp::SignalBase* signal : watched_) signal->detach(*this);
}

void HandshakeRecorder::add(Line line, std::uint64_t value) {
  handshake_.signals[line].points.push_back({scheduler_.now_ps(), static_cast<double>(value)});
  if (line == word && value != 0 && meaning_) handshake_.meanings[value] = meaning_(value);
}

void HandshakeRecorder::on_change(vp::SignalBase& signal, std::uint32_t id) {
  const bool begins = id == enable && signal.bits() != 0;
  if (begins && words_ == 0) {
    for (auto& line : handshake_.signals) line.points.clear();
    for (const Line line : {word, acknowledge}) add(line, watched_[line]->bits());
  }
  if (handshake_.signals[enable].points.empty() && !begins) return;
  add(static_cast<Line>(id), signal.bits());
  if (id == word && signal.bits() != 0) ++words_;
  // The word after the last is not shown, but the toggle before it.
  if (id == acknowledge && words_ == most_words) stop();
}

namespace {

// Ids of signals that are no engine's.
constexpr std::size_t level_id = 1000;

}  // namespace

TimelineRecorder::TimelineRecorder(Zynq& zynq, std::uint32_t frames) : zynq_(zynq), left_(frames) {
  if (frames == 0) return;
  logic_ = zynq.design().timeline();
  add_tracks();
  for (const auto& level : logic_.levels)
    timeline_.counters.push_back({level.name, level.unit, level.capacity, {}});
  for (const auto& peak : logic_.peaks)
    timeline_.counters.push_back({peak.name, peak.unit, peak.capacity, {}});
  bursts_.resize(logic_.peaks.size());
  for (std::size_t i = 0; i < logic_.levels.size(); ++i)
    watch(*logic_.levels[i].level, level_id + i);
  for (std::size_t i = 0; i < logic_.channels.size(); ++i) watch_transfers(i);
  if (logic_.handshake) handshake_.emplace(zynq.scheduler, *logic_.handshake);
}

void TimelineRecorder::add_tracks() {
  frame_ = add_track("Frame", "Frame");
  first_engine_ = tracks_.size();
  for (const auto& engine : logic_.engines)
    watch(*engine.busy, add_track("PL", engine.name, "frame", engine.active_low));
  first_channel_ = tracks_.size();
  for (const auto& channel : logic_.channels) add_track("DMA", channel.name);
  for (const auto& channel : logic_.channels)
    watch(*channel.line, add_track("Interrupts", channel.interrupt, "pending"));
  watch(zynq_.ps.cpu.in_handler, add_track("Interrupts", "Handler", "handler"));
  stages_ = add_track("PS", "PS stage");
  functions_ = add_track("PS", "PS function");
  watch(zynq_.ps.cpu.function, functions_);
  if (auto* second = zynq_.ps.second_core()) {
    ps::Cpu& cpu1 = second->cpu;
    watch(cpu1.in_handler, add_track("Interrupts", "Handler, cpu1", "handler"));
    watch(cpu1.asleep, add_track("PS", "cpu1", "awake", true));
    second_functions_ = add_track("PS", "cpu1 function");
    watch(cpu1.function, *second_functions_);
  }
}

std::size_t TimelineRecorder::add_track(const char* group, const std::string& name,
                                        const char* span, bool active_low) {
  timeline_.tracks.push_back({group, name, {}});
  tracks_.push_back({span, active_low, {}});
  return tracks_.size() - 1;
}

void TimelineRecorder::watch(vp::SignalBase& signal, std::size_t id) {
  signal.attach(*this, static_cast<std::uint32_t>(id));
  watched_.push_back(&signal);
}

void TimelineRecorder::watch_transfers(std::size_t channel) {
  logic_.channels[channel].channel->on_transfer(
      [this, channel](bool begins) { transfer(channel, begins); });
}

void TimelineRecorder::transfer(std::size_t channel, bool begins) {
  for (std::size_t i = 0; i < bursts_.size(); ++i) {
    if (logic_.peaks[i].channel != channel) continue;
    if (begins) burst_done(i);
    (begins ? bursts_[i].begin : bursts_[i].end) = zynq_.scheduler.now_ps();
  }
  if (begins) return begin(first_channel_ + channel, "transfer");
  end(first_channel_ + channel);
}

// At the next transfer: its packet cannot have passed yet, at either fidelity.
void TimelineRecorder::burst_done(std::size_t peak) {
  Burst& burst = bursts_[peak];
  if (!burst.begin || !burst.end) return;
  timeline_.counters[logic_.levels.size() + peak].points.push_back(
      {*burst.begin, logic_.peaks[peak].most()});
  burst = {};
}

void TimelineRecorder::stop() {
  left_ = 0;
  if (handshake_) handshake_->stop();
  for (vp::SignalBase* signal : watched_) signal->detach(*this);
  for (const auto& channel : logic_.channels) channel.channel->on_transfer(nullptr);
  watched_.clear();
  logic_.channels.clear();
}

void TimelineRecorder::on_change(vp::SignalBase& signal, std::uint32_t id) {
  const std::uint64_t value = signal.bits();
  if (id >= level_id) {
    timeline_.counters[id - level_id].points.push_back(
        {zynq_.scheduler.now_ps(), static_cast<double>(value)});
    return;
  }
  end(id);
  if (id == functions_ || id == second_functions_) {
    const auto& known = zynq_.ps.cpu.activity().functions();
    if (value != 0 && value <= known.size()) begin(id, known[value - 1].name);
  } else if ((value != 0) != tracks_[id].active_low) {
    begin(id, tracks_[id].span);
  }
}

void TimelineRecorder::begin(std::size_t track, const std::string& name) {
  tracks_[track].open = {zynq_.scheduler.now_ps(), timeline_.name(name)};
}

void TimelineRecorder::end(std::size_t track) {
  const auto open = tracks_[track].open;
  tracks_[track].open.reset();
  const std::uint64_t now = zynq_.scheduler.now_ps();
  if (open && now > open->start_ps) {
    timeline_.tracks[track].spans.push_back({open->start_ps, now - open->start_ps, open->name});
  }
}

void TimelineRecorder::add_span(std::size_t track, const std::string& name, std::uint64_t start_ps,
                                std::uint64_t end_ps, bool critical) {
  if (end_ps <= start_ps) return;
  // Durations of the software's stamps are rounded to ps: two that follow may seem to overlap.
  auto& spans = timeline_.tracks[track].spans;
  if (!spans.empty() && spans.back().start_ps + spans.back().length_ps == start_ps + 1) {
    --spans.back().length_ps;
  }
  spans.push_back({start_ps, end_ps - start_ps, timeline_.name(name), critical});
}

void TimelineRecorder::frame_done(const facts::UnitReport& done) {
  if (left_ == 0) return;
  for (std::size_t i = 0; i < bursts_.size(); ++i) {
    const auto last_end = bursts_[i].end;
    if (!last_end) continue;
    burst_done(i);
    timeline_.counters[logic_.levels.size() + i].points.push_back({*last_end, 0});
  }
  timeline_.frames.push_back({done.index, done.start_ps, done.end_ps});
  for (const facts::StageTime& stage : done.times) {
    if (stage.name == "upload")
      add_span(frame_, "upload", stage.start_ps, stage.start_ps + stage.ps);
  }
  add_span(frame_, "frame", done.start_ps, done.end_ps);
  mark_critical_path(done);
  if (handshake_ && !handshake_->empty()) timeline_.handshakes = {handshake_->handshake()};
  if (--left_ == 0) stop();
}

/// The stages of the PS follow one another, so all are critical; while they wait for the logic, its
/// slowest engine is in their place: that which ends last, and what feeds it.
void TimelineRecorder::mark_critical_path(const facts::UnitReport& done) {
  for (const facts::StageTime& stage : done.times) {
    if (stage.part_of.empty() || facts::has_parts(done.times, stage.name)) continue;
    const bool waits = stage.name == logic_.waiting;
    add_span(stages_, stage.name, stage.start_ps, stage.start_ps + stage.ps, !waits);
    if (!waits) continue;
    for (std::size_t i = 0; i < logic_.engines.size(); ++i) {
      if (!logic_.engines[i].critical) continue;
      for (facts::Timeline::Span& span : timeline_.tracks[first_engine_ + i].spans) {
        span.critical |=
            span.start_ps >= stage.start_ps && span.start_ps < stage.start_ps + stage.ps;
      }
    }
  }
}

}  // namespace platform
