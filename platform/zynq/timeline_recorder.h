#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <report/result.h>
#include <report/timeline.h>
#include <vp/signal.h>
#include <zynq/handshake_recorder.h>
#include <zynq/zynq.h>

namespace platform {

/// Records the timeline of a run's first frames from signals that exist at both fidelities, so that
/// both give the same. It listens until the last of these frames is done, then costs nothing.
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
  void frame_done(const report::FrameReport& frame);
  /// What was recorded; open intervals are left out.
  const report::Timeline& timeline() const { return timeline_; }

 private:
  /// The engines, in the order in which they are shown.
  enum Engine : std::uint32_t {
    frame,
    sensor,
    corners,
    blobs,
    dma_0,
    dma_1,
    irq_dma_0,
    irq_dma_1,
    handler,
    stages,
    functions,
    engines
  };
  enum Level : std::uint32_t { corner_buffer, blob_buffer, bridge_fifo, levels };

  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void watch(vp::SignalBase& signal, std::uint32_t id);
  void watch_transfers(xilinx::DmaChannel& channel, Engine engine);
  void stop();
  void begin(Engine engine, const std::string& name);
  void end(Engine engine);
  void add_span(Engine engine, const std::string& name, std::uint64_t start_ps,
                std::uint64_t end_ps, bool critical = false);
  void bridge_burst_done();
  void mark_critical_path(const report::FrameReport& frame);

  Zynq& zynq_;
  std::uint32_t left_;
  report::Timeline timeline_;
  struct Open {
    std::uint64_t start_ps;
    std::uint32_t name;
  };
  std::optional<Open> open_[engines];
  std::optional<std::uint64_t> burst_;  ///< when DMA 1's transfer began that is not recorded yet
  std::optional<std::uint64_t> burst_end_;
  std::optional<HandshakeRecorder> handshake_;
  std::vector<vp::SignalBase*> watched_;
  std::vector<xilinx::DmaChannel*> channels_;
};

}  // namespace platform
