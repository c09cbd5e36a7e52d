#pragma once

#include <cstdint>
#include <string>

#include <axi/queue.h>
#include <axi/wires.h>
#include <vp/clock.h>
#include <vp/rule_reports.h>

namespace axi {

/// Watches the rules of one AXI4 or AXI4-Lite link at its pins, with a model or RTL on either side
/// (vp/protocol_rules.h). It is shown the wires before each edge; on clocks without VALID that
/// costs a look at five of them.
class LinkChecker {
 public:
  /// Which side is not an adapter of ours: the reset belongs to it, and what it sends is looked at
  /// while it waits. Adapters keep what they send, as their tests show.
  enum class Resets { manager, subordinate, both };

  LinkChecker(const sc_core::sc_object& link, const vp::Clock& clock, const Shape& shape,
              Resets resets = Resets::both)
      : clock_(clock),
        shape_(shape),
        resets_(resets),
        bus_lanes_(lanes(0, shape.data_bytes)),
        reports_(link) {}

  /// `in_reset`: the edge samples an active reset.
  void edge(const Wires& wires, bool in_reset);
  /// An edge without VALID and without reset would show it nothing.
  bool idle() const { return !was_reset_ && !any_held_; }
  /// At the end of the simulation.
  void finish();
  const vp::RuleReports& reports() const { return reports_; }

 private:
  /// A request that waits for its response.
  struct Open {
    Address address;
    unsigned beats = 0;  ///< of data that passed
    bool complete = false;
  };

  void check_reset(const Wires& wires, bool in_reset);
  void check_stable(const Wires& wires);
  void check_requests_stable(const Wires& wires);
  template <class Channel, class Changes>
  void check_stable(Channel& held, const Channel& now, vp::Rule fell, Changes changes);
  void check_response(const Wires& wires, bool is_new);
  void check_read_data(const Wires& wires, bool is_new);
  void check_request(const Address& request, bool read);
  void check_write_beat(const WriteChannel& beat);
  void match_data();
  void forget_answered(const Wires& wires);
  [[gnu::cold]] void broken(vp::Rule rule, const std::string& what);

  const vp::Clock& clock_;
  const Shape shape_;
  const Resets resets_;
  const Strobes bus_lanes_;
  vp::RuleReports reports_;
  Wires held_;             ///< channels on which VALID waited on the last edge
  bool any_held_ = false;  ///< one of them did
  bool was_reset_ = false;
  bool early_response_ = false, early_data_ = false;  ///< passed before their request
  Queue<Open> writes_, reads_;                        ///< oldest first
  Queue<unsigned> early_;     ///< beats of write bursts that came before their address
  unsigned early_beats_ = 0;  ///< of the one that is not complete
};

}  // namespace axi
