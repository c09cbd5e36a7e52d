#include <zynq/handshake_recorder.h>

namespace platform {

HandshakeRecorder::HandshakeRecorder(Zynq& zynq)
    : zynq_(zynq),
      watched_{&zynq.pl.control_block.ena, &zynq.pl.feature_packaging.feature,
               &zynq.pl.control_block.ready},
      handshake_{"Feature words", {{"ena", 1, {}}, {"feature", 32, {}}, {"ready", 2, {}}}} {
  for (std::uint32_t id = 0; id < lines; ++id) watched_[id]->attach(*this, id);
}

void HandshakeRecorder::stop() {
  if (!listens_) return;
  listens_ = false;
  for (vp::SignalBase* signal : watched_) signal->detach(*this);
}

void HandshakeRecorder::add(Line line, std::uint64_t value) {
  handshake_.signals[line].points.push_back({zynq_.scheduler.now_ps(), static_cast<double>(value)});
}

void HandshakeRecorder::on_change(vp::SignalBase& signal, std::uint32_t id) {
  const bool begins = id == ena && signal.bits() != 0;
  if (begins && words_ == 0) {
    for (auto& line : handshake_.signals) line.points.clear();
    for (const Line line : {feature, ready}) add(line, watched_[line]->bits());
  }
  if (handshake_.signals[ena].points.empty() && !begins) return;
  add(static_cast<Line>(id), signal.bits());
  if (id == feature && signal.bits() != 0) ++words_;
  // The word after the last is not shown, but the toggle before it.
  if (id == ready && words_ == most_words) stop();
}

}  // namespace platform
