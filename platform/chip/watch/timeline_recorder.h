#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <facts/result.h>
#include <facts/timeline.h>
#include <functional>

#include <chip/system/design.h>
#include <chip/system/zynq.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>

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
  const facts::Timeline::Handshake& handshake() const { return handshake_; }
  bool empty() const { return words_ == 0; }

 private:
  enum Line : std::uint32_t { enable, word, acknowledge, lines };

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void add(Line line, std::uint64_t value);

  const vp::ClockScheduler& scheduler_;
  vp::SignalBase* watched_[lines];
  std::function<std::string(std::uint64_t)> meaning_;
  bool listens_ = true;
  std::uint32_t words_ = 0;
  facts::Timeline::Handshake handshake_;
};

/// Records the timeline of a run's first frames: what the design shows of the logic, and the
/// software. It listens until the last of these frames is done, then costs nothing.
class TimelineRecorder : private vp::SignalListener {
 public:
  /// `frames`: how many to record. What is passed must outlive the recorder.
  TimelineRecorder(Zynq& zynq, std::uint32_t frames);
  ~TimelineRecorder() override { stop(); }
  TimelineRecorder(const TimelineRecorder&) = delete;
  TimelineRecorder& operator=(const TimelineRecorder&) = delete;

  /// Whether frames are left to record.
  bool records() const { return left_ > 0; }
  /// A frame's results are there.
  void frame_done(const facts::UnitReport& frame);
  /// What was recorded; open intervals are left out.
  const facts::Timeline& timeline() const { return timeline_; }

 private:
  /// A row of the timeline, and what is under way on it.
  struct Track {
    const char* span = "";  ///< what its intervals are called
    bool active_low = false;
    struct Open {
      std::uint64_t start_ps;
      std::uint32_t name;
    };
    std::optional<Open> open;
  };
  /// The buffer behind a DMA channel, while its transfer is not recorded yet.
  struct Burst {
    std::optional<std::uint64_t> begin, end;
  };

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  std::size_t add_track(const char* group, const std::string& name, const char* span = "",
                        bool active_low = false);
  void add_tracks();
  void watch(vp::SignalBase& signal, std::size_t id);
  void watch_transfers(std::size_t channel);
  void stop();
  void begin(std::size_t track, const std::string& name);
  void end(std::size_t track);
  void add_span(std::size_t track, const std::string& name, std::uint64_t start_ps,
                std::uint64_t end_ps, bool critical = false);
  void transfer(std::size_t channel, bool begins);
  void burst_done(std::size_t peak);
  void mark_critical_path(const facts::UnitReport& frame);

  Zynq& zynq_;
  std::uint32_t left_;
  TimelineEngines logic_;
  facts::Timeline timeline_;
  std::vector<Track> tracks_;  ///< as in timeline_
  std::size_t frame_ = 0, first_engine_ = 0, first_channel_ = 0, stages_ = 0, functions_ = 0;
  std::optional<std::size_t> second_functions_;
  std::vector<Burst> bursts_;  ///< of the peaks
  std::optional<HandshakeRecorder> handshake_;
  std::vector<vp::SignalBase*> watched_;
};

}  // namespace platform
