#include <trace/transactions/handshake.h>

namespace platform::trace {

void Handshake::check_unknown(const SampleEdge& edge, bool after_reset) {
  // An unknown value counts behind reset, or once it was known: before, nothing has begun.
  const bool valid_known = replay_.was_known(valid_slot_);
  if (!valid_known && (valid_was_known_ || after_reset)) add(edge, rule("VALID_X"), "VALID is x");
  valid_was_known_ = valid_known;
  if (!ready_slot_) return;
  const bool ready_known = replay_.was_known(*ready_slot_);
  if (!ready_known && (ready_was_known_ || after_reset)) {
    add(edge, prefix_ + (by_manager_ ? "ERRS_" : "ERRM_") + channel_ + "READY_X", "READY is x");
  }
  ready_was_known_ = ready_known;
}

void Handshake::check_kept(const SampleEdge& edge) {
  for (std::size_t i = 0; i < payload_.size(); ++i) {
    const std::string& now = replay_.text_before(payload_[i].slot);
    if (now == held_[i]) continue;
    add(edge, rule(payload_[i].name + "_STABLE"),
        "changes from " + held_[i] + " to " + now + " while " + channel_ + "READY is low");
    held_[i] = now;
  }
}

void Handshake::sample(const SampleEdge& edge, bool after_reset, std::uint64_t max_wait) {
  const bool was_waiting = valid_ && !beat_;
  withdrawn_ = false;
  check_unknown(edge, after_reset);
  valid_ = replay_.was_known(valid_slot_) && replay_.bits_before(valid_slot_) != 0;
  const bool ready =
      !ready_slot_ || (replay_.was_known(*ready_slot_) && replay_.bits_before(*ready_slot_) != 0);
  begins_ = valid_ && !was_waiting;
  beat_ = valid_ && ready;
  if (ready) {
    ready_low_since_.reset();
  } else if (!ready_low_since_) {
    ready_low_since_ = edge.cycle;
  }
  if (valid_ && after_reset)
    add(edge, rule("VALID_RESET"), "VALID is high in the first clock behind reset");
  if (was_waiting && !valid_) {
    withdrawn_ = true;
    add(edge, rule("VALID_STABLE"), "VALID falls before " + channel_ + "READY came");
  }
  if (was_waiting && valid_) check_kept(edge);
  if (begins_) {
    offered_ = edge;
    waits_too_long_ = false;
    for (std::size_t i = 0; i < payload_.size(); ++i)
      held_[i] = replay_.text_before(payload_[i].slot);
  }
  if (valid_ && max_wait != 0 && waited(edge) > max_wait && !waits_too_long_) {
    waits_too_long_ = true;
    add(edge, prefix_ + (by_manager_ ? "RECS_" : "RECM_") + channel_ + "READY_MAX_WAIT",
        "no READY for " + std::to_string(waited(edge)) + " clocks");
  }
}

}  // namespace platform::trace
