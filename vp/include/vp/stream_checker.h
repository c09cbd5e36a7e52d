#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vp/rule_reports.h>
#include <vp/signal.h>

namespace vp {

class AxiStream;

/// The attribute (sc_core::sc_attribute<unsigned>) of a link whose beats have fewer than 4 bytes.
inline constexpr const char* beat_bytes_attribute = "beat_bytes";
/// Bytes of a beat, 1 to 4.
unsigned beat_bytes(const AxiStream& link);

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
  void pass(std::uint8_t keep, bool last) {
    if (keep != whole_ && !last) broken(Rule::stream_keep_gap, "a word with TKEEP ", keep);
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
  enum Wire : std::uint32_t { valid, ready, data, last, keep, wires };

  void on_change(SignalBase& signal, std::uint32_t id) override;
  bool may_wait() const { return levels_[valid].now != 0 && levels_[ready].now == 0; }
  void follow(std::uint64_t ps);
  void listen();
  bool excused(std::uint64_t ps) const;
  void check(Wire wire, std::uint64_t ps);
  void broken(Rule rule, const char* what, std::uint64_t value);

  const Clock& clock_;
  const std::uint8_t whole_;  ///< TKEEP of a beat with all of its bytes
  SignalBase* const signals_[wires];
  const std::vector<Reset> resets_;
  Level levels_[wires];
  std::vector<Level> reset_levels_;
  bool listens_ = false;                   ///< to data, last and keep
  std::optional<std::uint64_t> ended_ps_;  ///< when the wait ended, while it still listens
  std::uint64_t excused_ps_ = ~std::uint64_t{0};
  RuleReports reports_;
};

}  // namespace vp
