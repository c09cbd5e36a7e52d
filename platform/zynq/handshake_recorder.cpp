#include <zynq/handshake_recorder.h>

namespace platform {

HandshakeRecorder::HandshakeRecorder(const vp::ClockScheduler& scheduler,
                                     const TimelineEngines::Handshake& words)
    : scheduler_(scheduler), watched_{words.enable, words.word, words.acknowledge} {
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

}  // namespace platform
