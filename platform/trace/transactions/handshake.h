#pragma once

#include <trace/transactions/decoder.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

/// VALID, READY and what goes with them: a channel of AXI or a stream. Checks the rules that all
/// channels share, under Arm's names: VALID and payload are kept until READY, VALID is low in the
/// first clock behind reset, and neither is unknown.
class Handshake {
 public:
  struct Payload {
    std::string name;  ///< "ADDR"
    Replay::Slot slot;
  };

  /// `prefix`: "AXI4_"; `channel`: "AW"; `by_manager`: it drives VALID. READY may be missing.
  Handshake(const Replay& replay, std::string prefix, std::string channel, bool by_manager,
            Replay::Slot valid, std::optional<Replay::Slot> ready, std::vector<Payload> payload)
      : replay_(replay),
        prefix_(std::move(prefix)),
        channel_(std::move(channel)),
        by_manager_(by_manager),
        valid_slot_(valid),
        ready_slot_(ready),
        payload_(std::move(payload)),
        held_(payload_.size()) {}

  /// Looks at an edge. `after_reset`: the first one behind reset; `max_wait`: 0: any.
  void sample(const SampleEdge& edge, bool after_reset, std::uint64_t max_wait);
  /// A reset: nothing waits any more.
  void reset() {
    valid_ = beat_ = begins_ = withdrawn_ = false;
    broken_.clear();
    ready_low_since_.reset();
  }

  bool valid() const { return valid_; }
  /// VALID rises, or stays behind a beat: a new word is offered.
  bool begins() const { return begins_; }
  /// A word passes on this edge.
  bool beat() const { return beat_; }
  /// VALID fell before READY came.
  bool withdrawn() const { return withdrawn_; }
  /// When the word was first offered, and clocks that it has waited since.
  const SampleEdge& offered() const { return offered_; }
  std::uint64_t waited(const SampleEdge& edge) const { return edge.cycle - offered_.cycle; }
  /// The cycle since which READY has been low; none: it is high.
  std::optional<std::uint64_t> ready_low_since() const { return ready_low_since_; }
  /// Rules that this edge broke. The caller reports them.
  std::vector<Violation>& broken() { return broken_; }

  const std::string& channel() const { return channel_; }
  bool by_manager() const { return by_manager_; }
  /// "AXI4_ERRM_AWVALID_STABLE": the side that drives VALID breaks it.
  std::string rule(const std::string& name) const {
    return prefix_ + (by_manager_ ? "ERRM_" : "ERRS_") + channel_ + name;
  }

 private:
  void check_unknown(const SampleEdge& edge, bool after_reset);
  void check_kept(const SampleEdge& edge);
  void add(const SampleEdge& edge, std::string rule, std::string detail) {
    broken_.push_back({std::move(rule), edge.ps, edge.cycle, std::move(detail)});
  }

  const Replay& replay_;
  std::string prefix_, channel_;
  bool by_manager_;
  Replay::Slot valid_slot_;
  std::optional<Replay::Slot> ready_slot_;
  std::vector<Payload> payload_;
  std::vector<std::string> held_;  ///< payload while it waits
  bool valid_ = false, beat_ = false, begins_ = false, withdrawn_ = false;
  bool valid_was_known_ = false, ready_was_known_ = false;
  bool waits_too_long_ = false;
  SampleEdge offered_;
  std::optional<std::uint64_t> ready_low_since_;
  std::vector<Violation> broken_;
};

}  // namespace platform::trace
