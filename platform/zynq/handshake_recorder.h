#pragma once

#include <cstdint>

#include <report/timeline.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>
#include <zynq/timeline_engines.h>

namespace platform {

/// Records how the first words of a run are handed over, signal by signal. Then it costs nothing.
class HandshakeRecorder : private vp::SignalListener {
 public:
  static constexpr std::uint32_t most_words = 8;

  HandshakeRecorder(const vp::ClockScheduler& scheduler, const TimelineEngines::Handshake& words);
  ~HandshakeRecorder() override { stop(); }
  HandshakeRecorder(const HandshakeRecorder&) = delete;
  HandshakeRecorder& operator=(const HandshakeRecorder&) = delete;

  void stop();
  /// From `enable` until the last of these words is acknowledged. Without words there is none.
  const report::Timeline::Handshake& handshake() const { return handshake_; }
  bool empty() const { return words_ == 0; }

 private:
  enum Line : std::uint32_t { enable, word, acknowledge, lines };

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void add(Line line, std::uint64_t value);

  const vp::ClockScheduler& scheduler_;
  vp::SignalBase* watched_[lines];
  bool listens_ = true;
  std::uint32_t words_ = 0;
  report::Timeline::Handshake handshake_;
};

}  // namespace platform
