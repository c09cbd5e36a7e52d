#include <vp/stream_checker.h>

#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/text.h>

namespace vp {

namespace {

/// The bits of the data whose bytes are kept.
std::uint64_t bits_of_kept(std::uint64_t keep) {
  std::uint64_t mask = 0;
  for (unsigned byte = 0; byte < 8; ++byte)
    if (keep >> byte & 1) mask |= std::uint64_t{0xFF} << 8 * byte;
  return mask;
}

}  // namespace

unsigned beat_bytes(const AxiStream& link) {
  constexpr unsigned usual = 4;
  const auto* bytes = dynamic_cast<const sc_core::sc_attribute<unsigned>*>(
      link.get_attribute(beat_bytes_attribute));
  return bytes ? bytes->value : usual;
}

void StreamChecker::Level::set(std::uint64_t value, std::uint64_t ps) {
  if (changed_ps != ps) before = now;
  changed_ps = ps;
  now = value;
}

StreamChecker::StreamChecker(AxiStream& link, const Clock& clock, const std::vector<Reset>& resets)
    : clock_(clock),
      whole_(static_cast<std::uint8_t>((1u << beat_bytes(link)) - 1)),
      signals_{&link.tvalid, &link.tready, &link.tdata, &link.tlast, &link.tkeep},
      resets_(resets),
      reset_levels_(resets.size()),
      reports_(link) {
  for (const Wire wire : {valid, ready}) {
    levels_[wire].now = levels_[wire].before = signals_[wire]->bits();
    signals_[wire]->attach(*this, wire);
  }
  if (may_wait()) listen();
  for (std::uint32_t i = 0; i < resets_.size(); ++i) {
    reset_levels_[i].now = reset_levels_[i].before = resets_[i].signal->bits();
    resets_[i].signal->attach(*this, wires + i);
  }
}

void StreamChecker::excuse() {
  excused_ps_ = clock_.scheduler().now_ps();
}

// On an edge a wire of the master changes behind what it sampled. A reset counts if it is active on
// either side of it.
bool StreamChecker::excused(std::uint64_t ps) const {
  if (excused_ps_ == ps) return true;
  for (std::size_t i = 0; i < resets_.size(); ++i) {
    const std::uint64_t inactive = resets_[i].active_low ? 1 : 0;
    if (reset_levels_[i].now != inactive || reset_levels_[i].sampled(ps) != inactive) return true;
  }
  return false;
}

void StreamChecker::on_change(SignalBase& signal, std::uint32_t id) {
  const std::uint64_t ps = clock_.scheduler().now_ps();
  if (id >= wires) return reset_levels_[id - wires].set(signal.bits(), ps);
  levels_[id].set(signal.bits(), ps);
  if (id != ready) check(static_cast<Wire>(id), ps);
  if (id == valid || id == ready) follow(ps);
}

// In the instant in which the wait ends the other wires may still break a rule: they are left on
// the next change. Never from within the notification of one of them, which would lose listeners.
void StreamChecker::follow(std::uint64_t ps) {
  if (may_wait()) {
    if (!listens_) listen();
    ended_ps_.reset();
  } else if (listens_ && !ended_ps_) {
    ended_ps_ = ps;
  } else if (listens_ && *ended_ps_ != ps) {
    for (const Wire wire : {data, last, keep}) signals_[wire]->detach(*this);
    listens_ = false;
  }
}

void StreamChecker::listen() {
  listens_ = true;
  for (const Wire wire : {data, last, keep}) {
    levels_[wire] = {};
    levels_[wire].now = signals_[wire]->bits();
    signals_[wire]->attach(*this, wire);
  }
}

void StreamChecker::check(Wire wire, std::uint64_t ps) {
  const bool waits = levels_[valid].sampled(ps) != 0 && levels_[ready].sampled(ps) == 0;
  if (!waits || excused(ps)) return;
  switch (wire) {
    case valid:
      return broken(Rule::stream_valid_stable, "TVALID fell without TREADY, data ",
                    levels_[data].sampled(ps));
    case data:
      if (((levels_[data].now ^ levels_[data].sampled(ps)) &
           bits_of_kept(levels_[keep].sampled(ps))) == 0)
        return;
      return broken(Rule::stream_data_stable, "TDATA changed without TREADY, to ",
                    levels_[data].now);
    case last:
      return broken(Rule::stream_last_stable, "TLAST changed without TREADY, to ",
                    levels_[last].now);
    case keep:
      return broken(Rule::stream_keep_stable, "TKEEP changed without TREADY, to ",
                    levels_[keep].now);
    case ready:
    case wires:
      break;
  }
}

void StreamChecker::broken(Rule rule, const char* what, std::uint64_t value) {
  reports_.violate(rule, &clock_, what + hex(value));
}

}  // namespace vp
