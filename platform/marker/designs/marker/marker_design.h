#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <chip/system/design.h>
#include <marker/designs/marker/blob_figure.h>
#include <marker/scene/pose.h>
#include <pl/feature_extraction/feature_extraction.h>
#include <ps/cpu/cpu.h>
#include <trace/vocabulary.h>
#include <vp/clock_scheduler.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/concat/concat.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>

namespace platform {

/// The whole programmable logic: the feature extraction and what Xilinx provides around it, wired
/// as the thesis' figure 4.2 (letters of tables 4.2 and 4.3).
class ProgrammableLogic : public pl::FeatureExtraction {
 public:
  /// `filter`: models of a filter between sensor and detectors; null: there is none.
  ProgrammableLogic(sc_core::sc_module_name name, vp::Clock& system_clk, vp::Clock& pixel_clk,
                    pl::Fidelity otherwise, const pl::Models<pl::PixelFilter>* filter = nullptr);

  xilinx::ProcSysReset proc_sys_reset;           ///< G
  xilinx::AxiInterconnect axi_interconnect;      ///< H: GP0 to the registers
  xilinx::AxiInterconnect axi_mem_interconnect;  ///< J: DMA to HP0
  xilinx::AxiGpio axi_gpio_0;                    ///< B: control packet, all outputs
  xilinx::AxiGpio axi_gpio_1;                    ///< C: feature words, all inputs
  xilinx::AxiDma axi_dma_0;                      ///< E: images to the PL, read channel only
  xilinx::AxiDma axi_dma_1;                      ///< F: binary image to DDR, write channel only
  vp::AxiStream image_stream_link{"image_stream"};
  vp::AxiStream binary_stream_link{"binary_stream"};
  xilinx::Concat concat;  ///< interrupts of both DMAs

 private:
  void name_groups();
  void count_work();
};

/// Warns of mistakes in the handshake of the feature words: `ready` toggled although no word waits
/// to be acknowledged, and reads of the feature register after the end word. Once a frame each.
class HandshakeWatch : private vp::SignalListener {
 public:
  /// `cpu`: whose program is watched.
  HandshakeWatch(ProgrammableLogic& logic, const ps::Cpu& cpu, const vp::ClockScheduler& scheduler);
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

  facts::Work work() const override;
  facts::InputNeed input() const override;
  void describe(const facts::UnitInput& input, hal_frame& frame) const override;
  void place(const facts::SharedInput& input) override { bram.load(input->bytes()); }
  void settle() override { ProgrammableLogic::settle(); }
  std::optional<double> program_option(const std::string& name) const override;
  void note_option(const std::string& name, double value) override {
    if (name == "unoptimised") is_unoptimised_ = value >= 0.5;
    if (name == "marker_side") marker_side_m_ = value;
  }
  /// The threshold in use is that of the frame before.
  std::uint32_t settling_showings() const override { return 1; }
  bool report(const Publication& publication, facts::UnitReport& frame) override;
  void check(facts::UnitReport& frame) override;
  void finish() override { handshake_.finish_frame(); }

  void add_power_options() override { blob_figure_.add(); }
  bool has_net_figures() const override { return blob_figure_.is_net(); }
  vp::Signal<bool>* busy() override { return &sensor_input.frame_ena; }
  std::vector<std::string> groups() const override;
  std::vector<ClockRole> clock_roles() override;
  TimelineEngines timeline() override;

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;

  PlPorts& ports_;
  HandshakeWatch handshake_;
  BlobFigure blob_figure_;
  double marker_side_m_ = marker_side_m;
  bool is_unoptimised_ = false;  ///< the program: -O2 would be faster
  std::uint8_t threshold_ = 0;   ///< in use when the frame began
};

/// For DesignInfo::make.
std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports);

/// The words of the marker designs.
const trace::Vocabulary& marker_words();

}  // namespace platform
