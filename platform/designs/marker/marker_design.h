#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <designs/marker/programmable_logic.h>
#include <ps/cpu/cpu.h>
#include <trace/vocabulary.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>
#include <zynq/design.h>

namespace platform {

/// Warns of mistakes in the handshake of the feature words: `ready` toggled although no word waits
/// to be acknowledged, and reads of the feature register after the end word. Once a frame each.
class HandshakeWatch : private vp::SignalListener {
 public:
  /// `cpu`: whose program is watched.
  HandshakeWatch(ProgrammableLogic& logic, const ps::Cpu& cpu, const vp::ClockScheduler& scheduler);
  ~HandshakeWatch();
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

  ProgrammableLogic& logic_;
  const ps::Cpu& cpu_;
  const vp::ClockScheduler& scheduler_;
  vp::Register& feature_register_;
  std::uint32_t packet_ = 0;
  bool unacknowledged_ = false;  ///< a word is shown that `ready` did not answer
  std::uint64_t stray_toggles_ = 0;
  std::optional<std::uint64_t> reads_at_end_;  ///< of the register, when the end word was read
  std::uint64_t end_read_ps_ = 0;
};

/// The marker detector's logic in the Zynq: the thesis' wiring, and how what its programs publish
/// becomes a frame of the result.
class MarkerDesign : public ProgrammableLogic, public Design, private vp::SignalListener {
 public:
  /// `filter`: models of a filter between sensor and detectors; null: there is none.
  MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
               const pl::Models<pl::PixelFilter>* filter = nullptr);

  input::ImageSize frame_size() const override;
  void show_image(const GreyImage& image) override;
  void settle() override { ProgrammableLogic::settle(); }
  std::optional<double> program_option(const std::string& name) const override;
  bool report(const Publication& publication, report::FrameReport& frame) override;
  void finish() override { handshake_.finish_frame(); }

  vp::Signal<bool>* busy() override { return &sensor_input.frame_ena; }
  std::vector<std::string> groups() const override;
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override;

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;

  PlPorts& ports_;
  HandshakeWatch handshake_;
  std::uint8_t threshold_ = 0;  ///< in use when the frame began
};

/// For DesignInfo::make.
std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports);

/// The words of the marker designs.
const trace::Vocabulary& marker_words();

}  // namespace platform
