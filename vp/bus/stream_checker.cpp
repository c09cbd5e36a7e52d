#include <vp/stream_checker.h>

#include <algorithm>

#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/text.h>

namespace vp {

namespace {

Rule stable_rule(StreamField field) {
  switch (field) {
    case StreamField::data:
      return Rule::stream_data_stable;
    case StreamField::keep:
      return Rule::stream_keep_stable;
    case StreamField::strobe:
      return Rule::stream_strb_stable;
    case StreamField::user:
      return Rule::stream_user_stable;
    case StreamField::id:
      return Rule::stream_id_stable;
    case StreamField::dest:
      break;
  }
  return Rule::stream_dest_stable;
}

std::uint64_t ones(unsigned bits) {
  return (std::uint64_t{1} << bits) - 1;
}

}  // namespace

void StreamChecker::Level::set(std::uint64_t value, std::uint64_t ps) {
  if (changed_ps != ps) before = now;
  changed_ps = ps;
  now = value;
}

StreamChecker::StreamChecker(AxiStream& link, const Clock& clock, const std::vector<Reset>& resets)
    : clock_(clock),
      bytes_(link.bytes()),
      signals_{&link.tvalid, &link.tready, &link.tlast},
      parts_{{{StreamField::data, 0, link.tdata.width()}, &link.tdata},
             {{StreamField::keep, 0, link.tkeep.width()}, &link.tkeep}},
      resets_(resets),
      reset_levels_(resets.size()),
      low_keep_{link.tkeep.place(),
                static_cast<std::uint8_t>(ones(std::min(link.tkeep.width(), link.bytes())))},
      reports_(link) {
  for (AxiStream::Part& part : link.parts()) {
    parts_.push_back({part.part, &part.wire});
    if (part.part.field == StreamField::keep || part.part.field == StreamField::strobe)
      lanes_.emplace_back(part.wire.place(), static_cast<std::uint32_t>(ones(part.part.bits)));
  }
  for (const Wire wire : {valid, ready}) {
    levels_[wire].now = levels_[wire].before = signals_[wire]->bits();
    signals_[wire]->attach(*this, wire);
  }
  if (may_wait()) listen();
  for (std::uint32_t i = 0; i < resets_.size(); ++i) {
    reset_levels_[i].now = reset_levels_[i].before = resets_[i].signal->bits();
    resets_[i].signal->attach(*this, reset_ids + i);
  }
  check_width();
}

void StreamChecker::check_width() {
  constexpr unsigned most = 24;  // IHI0051, recommended
  unsigned bits = 0;
  for (const Part& part : parts_) {
    const bool routes = part.part.field == StreamField::id || part.part.field == StreamField::dest;
    if (routes) bits += part.part.bits;
  }
  if (bits > most) broken(Rule::stream_id_dest_width, "bits of both are ", bits);
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

/// The master must hold what it offered before this instant.
bool StreamChecker::holds(std::uint64_t ps) const {
  return levels_[valid].sampled(ps) != 0 && levels_[ready].sampled(ps) == 0 && !excused(ps);
}

void StreamChecker::on_change(SignalBase& signal, std::uint32_t id) {
  const std::uint64_t ps = clock_.scheduler().now_ps();
  if (id >= reset_ids) return change_reset(id - reset_ids, signal.bits(), ps);
  if (id >= wires) {
    parts_[id - wires].level.set(signal.bits(), ps);
    return check_stable(parts_[id - wires], ps);
  }
  levels_[id].set(signal.bits(), ps);
  if (id == valid) check_fall(ps);
  if (id == last && levels_[valid].now != 0 && holds(ps))
    broken(Rule::stream_last_stable, "TLAST changed without TREADY, to ", levels_[last].now);
  if (id != last) follow(ps);
}

// A master lowers TVALID on the first edge of its reset at the latest.
void StreamChecker::change_reset(std::uint32_t number, std::uint64_t level, std::uint64_t ps) {
  reset_levels_[number].set(level, ps);
  const std::uint64_t inactive = resets_[number].active_low ? 1 : 0;
  if (level == inactive && levels_[valid].sampled(ps) != 0)
    broken(Rule::stream_valid_reset, "TVALID is high, data ", parts_.front().wire->bits());
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
    signals_[last]->detach(*this);
    for (const Part& part : parts_) part.wire->detach(*this);
    listens_ = false;
  }
}

void StreamChecker::listen() {
  listens_ = true;
  levels_[last] = {};
  levels_[last].now = signals_[last]->bits();
  signals_[last]->attach(*this, last);
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    parts_[i].level = {};
    parts_[i].level.now = parts_[i].wire->bits();
    parts_[i].wire->attach(*this, wires + i);
  }
}

void StreamChecker::check_fall(std::uint64_t ps) {
  if (!holds(ps)) return;
  const Part& data = parts_.front();
  const std::uint64_t offered = listens_ ? data.level.sampled(ps) : data.wire->bits();
  broken(Rule::stream_valid_stable, "TVALID fell without TREADY, data ", offered);
}

// Behind a fall of TVALID the rest means nothing.
void StreamChecker::check_stable(const Part& part, std::uint64_t ps) {
  if (levels_[valid].now == 0 || !holds(ps)) return;
  std::uint64_t changed = part.level.now ^ part.level.sampled(ps);
  if (part.part.field == StreamField::data) changed &= kept(part.part.low, ps);
  if (changed == 0) return;
  broken(stable_rule(part.part.field),
         std::string(to_string(part.part.field)) + " changed without TREADY, to ", part.level.now);
}

/// Of 32 bits of data from `first_bit` on, those whose bytes were kept.
std::uint64_t StreamChecker::kept(unsigned first_bit, std::uint64_t ps) const {
  const unsigned first = first_bit / bits_per_byte;
  std::uint64_t mask = 0;
  for (const Part& part : parts_) {
    if (part.part.field != StreamField::keep) continue;
    for (unsigned byte = 0; byte < 4; ++byte) {
      const unsigned lane = first + byte;
      if (lane < part.part.low || lane >= part.part.low + part.part.bits) continue;
      if (part.level.sampled(ps) >> (lane - part.part.low) & 1)
        mask |= ones(bits_per_byte) << bits_per_byte * byte;
    }
  }
  return mask;
}

void StreamChecker::check_lanes(bool last_beat) {
  bool legal = true;
  for (const Part& part : parts_) {
    const std::uint64_t bits = part.wire->bits();
    if (part.part.field == StreamField::keep) {
      const unsigned lanes = std::min(part.part.bits, bytes_ - part.part.low);
      if (bits == ones(lanes)) continue;
      legal = false;
      if (!last_beat) broken(Rule::stream_keep_gap, "a word with TKEEP ", bits);
    } else if (part.part.field == StreamField::strobe) {
      std::uint64_t keep = 0;
      for (const Part& other : parts_) {
        if (other.part.field == StreamField::keep && other.part.low / 32 == part.part.low / 32)
          keep |= other.wire->bits() << other.part.low % 32;
      }
      if ((bits & ~keep) == 0) continue;
      legal = false;
      broken(Rule::stream_keep_strb, "a beat with TSTRB ", bits);
    }
  }
  if (!legal) return;
  low_keep_.second = *low_keep_.first;
  for (auto& [place, value] : lanes_) value = *place;
}

void StreamChecker::broken(Rule rule, const std::string& what, std::uint64_t value) {
  reports_.violate(rule, &clock_, what + hex(value));
}

}  // namespace vp
