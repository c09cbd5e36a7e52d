#pragma once

#include <cstdint>
#include <optional>

#include <marker/designs/marker/marker_parts.h>
#include <ps/cpu/cpu.h>
#include <vp/clock_scheduler.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace platform {

/// Warns of mistakes in the handshake of the feature words: `ready` toggled although no word waits
/// to be acknowledged, and reads of the feature register after the end word. Once a frame each.
class HandshakeWatch : private vp::SignalListener {
 public:
  /// `cpu`: whose program is watched.
  HandshakeWatch(const MarkerParts& parts, const ps::Cpu& cpu, const vp::ClockScheduler& scheduler);
  ~HandshakeWatch() override;
  HandshakeWatch(const HandshakeWatch&) = delete;
  HandshakeWatch& operator=(const HandshakeWatch&) = delete;

  /// A frame is over: the program publishes its result, or ends. Returns how often `ready` was
  /// toggled in it with nothing to acknowledge.
  std::uint64_t finish_frame();

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void control_written(std::uint32_t packet);
  void word_shown(std::uint32_t word);
  void register_read(std::uint32_t word);
  void look_at_polls();

  const ps::Cpu& cpu_;
  const vp::ClockScheduler& scheduler_;
  vp::SignalBase& feature_;
  vp::Register& feature_register_;
  std::uint32_t packet_ = 0;
  bool unacknowledged_ = false;  ///< a word is shown that `ready` did not answer
  std::uint64_t stray_toggles_ = 0;
  std::optional<std::uint64_t> reads_at_end_;  ///< of the register, when the end word was read
  std::uint64_t end_read_ps_ = 0;
};

}  // namespace platform
