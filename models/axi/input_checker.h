#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include <vp/clock.h>
#include <vp/rule_reports.h>
#include <vp/signal.h>

namespace axi {

/// Watches the resets and the wires that RTL samples: a reset that is too short or ends beside an
/// edge of its clock, and a wire of several bits that comes from another clock and does not stay
/// (vp/protocol_rules.h). What does not change costs nothing.
class InputChecker final : private vp::SignalListener {
 public:
  explicit InputChecker(const sc_core::sc_object& part) : reports_(part) {}

  // At the end of elaboration. `clock` samples the signal.
  void watch_reset(const std::string& pin, vp::SignalBase& signal, bool active_low,
                   const vp::Clock& clock);
  /// Nothing, if `from` is the same clock.
  void watch_wire(const std::string& pin, vp::SignalBase& signal, const vp::Clock& from,
                  const vp::Clock& clock);
  void finish() const { reports_.finish(); }

 private:
  struct Input {
    std::string pin;
    const vp::Clock* clock;
    const vp::Clock* from;  ///< of a wire; null: a reset
    std::uint64_t inactive;
    std::uint64_t since_ps;  ///< of the last change; never: none
  };

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void check_release(const Input& reset, std::uint64_t now_ps);
  void check_change(const Input& wire, std::uint64_t now_ps);

  std::deque<Input> inputs_;
  vp::RuleReports reports_;
};

}  // namespace axi
