#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vp/rule_reports.h>
#include <vp/signal.h>
#include <vp/stream_shape.h>

namespace vp {

class AxiStream;

/// Watches the handshake of one stream: what VALID offers stays until READY, but for a reset of the
/// master. It listens to TVALID and TREADY, and to the other wires while a beat may wait: a link at
/// rest costs nothing, one that flows little.
class StreamChecker final : public SignalListener {
 public:
  /// What the master is reset by, beside the wires of the link.
  struct Reset {
    SignalBase* signal;
    bool active_low;
  };

  /// Of a link with both ends, at the start of the simulation.
  StreamChecker(AxiStream& link, const Clock& clock, const std::vector<Reset>& resets);

  /// A beat passes: whether its bytes are what receivers expect.
  void pass(bool last) {
    bool known = *low_keep_.first == low_keep_.second;
    for (const auto& [place, legal] : lanes_) known = known && *place == legal;
    if (!known) check_lanes(last);
  }
  /// The master drops what it offers now, because it is reset.
  void excuse();
  void finish() const { reports_.finish(); }

 private:
  /// A wire, and what it was before the present instant.
  struct Level {
    std::uint64_t now = 0, before = 0, changed_ps = 0;
    void set(std::uint64_t value, std::uint64_t ps);
    std::uint64_t sampled(std::uint64_t ps) const { return changed_ps == ps ? before : now; }
  };
  enum Wire : std::uint32_t { valid, ready, last, wires };
  /// Bits of another field.
  struct Part {
    StreamPart part;
    SignalBase* wire;
    Level level = {};
  };
  static constexpr std::uint32_t reset_ids = 1u << 16;  ///< above those of wires and parts

  void on_change(SignalBase& signal, std::uint32_t id) override;
  bool may_wait() const { return levels_[valid].now != 0 && levels_[ready].now == 0; }
  void follow(std::uint64_t ps);
  void listen();
  bool excused(std::uint64_t ps) const;
  bool holds(std::uint64_t ps) const;
  void check_fall(std::uint64_t ps);
  void check_stable(const Part& part, std::uint64_t ps);
  void change_reset(std::uint32_t number, std::uint64_t level, std::uint64_t ps);
  std::uint64_t kept(unsigned first_bit, std::uint64_t ps) const;
  void check_lanes(bool last);
  void check_width();
  [[gnu::cold]] void broken(Rule rule, const std::string& what, std::uint64_t value);

  const Clock& clock_;
  const unsigned bytes_;
  SignalBase* const signals_[wires];
  Level levels_[wires];
  std::vector<Part> parts_;
  const std::vector<Reset> resets_;
  std::vector<Level> reset_levels_;
  /// TKEEP and TSTRB, and values of them that break no rule inside a packet: first those where all
  /// bytes count, later those of the last beat that was looked at.
  std::vector<std::pair<const std::uint32_t*, std::uint32_t>> lanes_;
  std::pair<const std::uint8_t*, std::uint8_t> low_keep_;
  bool listens_ = false;                   ///< to TLAST and the parts
  std::optional<std::uint64_t> ended_ps_;  ///< when the wait ended, while it still listens
  std::uint64_t excused_ps_ = ~std::uint64_t{0};
  RuleReports reports_;
};

}  // namespace vp
