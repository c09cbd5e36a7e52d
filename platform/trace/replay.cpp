#include <trace/replay.h>

#include <gic_registers.h>
#include <vp/trace_filter.h>

namespace platform::trace {

Replay::Replay(TraceFile& file) : file_(file), slot_of_net_(file.reader().nets(), -1) {}

Replay::Slot Replay::watch(std::uint32_t variable) {
  const vp::WaveVariable& v = file_.variable(variable);
  if (slot_of_net_[v.net] < 0) {
    slot_of_net_[v.net] = static_cast<int>(slots_.size());
    file_.reader().select(v.net);
    State state{variable, false, {}, {}};
    state.now.kind = state.before.kind = v.kind;
    slots_.push_back(state);
  }
  return static_cast<Slot>(slot_of_net_[v.net]);
}

Replay::Slot Replay::watch(const std::string& name) {
  return watch(vp::find_path(name, file_.paths()));
}

vp::ExpressionValue Replay::number(const Value& value) {
  if (!value.known || value.kind == vp::WaveVariable::Kind::text)
    return vp::ExpressionValue::unknown();
  if (value.kind == vp::WaveVariable::Kind::real) return value.real;
  return value.bits;
}

void Replay::run(Listener& listener) {
  listener_ = &listener;
  file_.reader().read(*this);
  if (started_ && !stopped_) finish_instant();
}

bool Replay::at(std::uint64_t ps) {
  if (started_ && !finish_instant()) return false;
  if (!started_) first_ps_ = ps;
  started_ = true;
  now_ps_ = ps;
  return true;
}

bool Replay::finish_instant() {
  stopped_ = !listener_->instant(now_ps_);
  for (const Slot slot : changed_) {
    State& state = slots_[slot];
    state.touched = false;
    state.before.known = state.now.known;
    state.before.bits = state.now.bits;
    state.before.real = state.now.real;
    if (keep_texts_ || state.now.kind == vp::WaveVariable::Kind::text) {
      state.before.text = state.now.text;
    }
  }
  changed_.clear();
  return !stopped_;
}

void Replay::change(std::uint32_t net, const vp::WaveValue& value) {
  const auto slot = static_cast<Slot>(slot_of_net_[net]);
  State& state = slots_[slot];
  if (!state.touched) changed_.push_back(slot);
  state.touched = true;
  state.now.known = value.known;
  state.now.bits = value.bits;
  state.now.real = value.real;
  if (keep_texts_ || value.kind == vp::WaveVariable::Kind::text) {
    state.now.text.assign(value.text);
  }
}

InterruptLine::InterruptLine(Replay& replay, TraceFile& file, int line, const std::string& irq_f2p,
                             std::uint64_t usual_id)
    : replay_(&replay), line_(replay.watch(static_cast<std::uint32_t>(line))), id_(usual_id) {
  const int vector = irq_f2p.empty() ? -1 : file.find(irq_f2p);
  if (vector >= 0) irq_f2p_ = replay.watch(static_cast<std::uint32_t>(vector));
}

bool InterruptLine::rises() {
  const bool high = replay_->known(line_) && replay_->bits(line_) != 0;
  if (!high || !replay_->was_known(line_) || replay_->bits_before(line_) != 0) return false;
  if (irq_f2p_ && replay_->known(*irq_f2p_) && replay_->was_known(*irq_f2p_)) {
    const std::uint64_t risen = replay_->bits(*irq_f2p_) & ~replay_->bits_before(*irq_f2p_);
    for (unsigned bit = 0; bit < gic::irq_f2p_bits; ++bit) {
      if (risen == std::uint64_t{1} << bit) id_ = gic::irq_f2p_id(bit);
    }
  }
  return true;
}

}  // namespace platform::trace
