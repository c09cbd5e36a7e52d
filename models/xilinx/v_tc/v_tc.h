#pragma once

#include <array>
#include <cstdint>
#include <systemc>
#include <utility>

#include <v_tc_registers.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <xilinx/v_tc/timing_detector.h>
#include <xilinx/v_tc/video_timing.h>

namespace xilinx {

/// Build options, as Vivado asks for them; the defaults of its parameters.
struct VTcBuild {
  bool has_axi4_lite = true;  ///< else the generator runs as built from the first clock on
  bool generate = true;
  bool detect = true;
  VideoTiming timing;                            ///< of the generator after reset
  std::uint32_t polarity = v_tc::polarity::all;  ///< of its outputs after reset
  std::uint32_t frame_syncs = 1;                 ///< 1 to 16
  /// Line and clock of each.
  std::array<std::pair<std::uint32_t, std::uint32_t>, v_tc::frame_syncs> frame_sync = {};
};

/// Video timing controller v6.2 (PG016): a generator of frame timing and a detector. The generator
/// has no process for each clock: it sleeps from one change of its outputs to the next.
///
/// The first pixel of a frame shows on the first clock on which the generator is on, out of reset
/// and enabled (assumed). Registers take effect while the generator is off, and with REG_UPDATE at
/// each start of a frame. Not modelled: interlaced frames, chroma, the frame sync that comes in,
/// and a generator that follows the detector's position; programs that ask for them are warned.
class VTc : public vp::Clocked, public vp::Ip {
 public:
  /// Throws vp::InputError for a timing that describes no frame.
  VTc(sc_core::sc_module_name name, vp::Clock& clk, const VTcBuild& build = {});
  const char* kind() const override { return "xilinx::VTc"; }

  vp::RegisterBank ctrl;

  // May all be left open: enabled, and not in reset.
  vp::In<bool> resetn{"resetn", this}, s_axi_aresetn{"s_axi_aresetn"};
  vp::In<bool> clken{"clken", this}, gen_clken{"gen_clken", this}, det_clken{"det_clken", this};
  vp::In<bool> hsync_in{"hsync_in", this}, vsync_in{"vsync_in", this},
      active_video_in{"active_video_in", this};

  vp::Signal<bool> hsync_out{"hsync_out"}, vsync_out{"vsync_out"};
  vp::Signal<bool> hblank_out{"hblank_out"}, vblank_out{"vblank_out"};
  vp::Signal<bool> active_video_out{"active_video_out"};
  vp::Signal<std::uint32_t> fsync_out;  ///< a bit for each, high for a clock
  vp::Signal<bool> irq{"irq"};          ///< level, active high

  const VTcBuild& build() const { return build_; }
  const TimingDetector& detector() const { return detector_; }
  /// Of the frame that the generator is in.
  const VideoTiming& timing() const { return timing_; }

 private:
  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;

  void wire();
  void show_build();
  void control_written(std::uint32_t word);
  void warn_of_what_is_missing();
  void reset_core();
  bool generates();
  void load_timing();
  void check_timing(const VideoTiming& timing);
  void generate(std::uint64_t cycle);
  void begin_position();
  void detect(std::uint64_t cycle);
  void show_detected();
  void drive();
  VideoLevels levels() const;
  std::uint64_t next_position();
  void raise(std::uint32_t bits);
  static bool high(const vp::In<bool>& pin) { return !pin.bound() || pin.read(); }
  static bool is_active(const vp::In<bool>& pin) { return pin.bound() && pin.read(); }

  const VTcBuild build_;
  VideoTiming timing_;
  std::uint32_t polarity_ = 0;
  TimingDetector detector_;
  bool running_ = false;      ///< position_ is valid
  bool was_enabled_ = false;  ///< on the edge looked at last
  bool wants_reset_ = false;  ///< FSYNC_RESET: at the end of the frame
  bool warned_ = false, warned_of_timing_ = false;
  std::uint64_t position_ = 0;  ///< clocks since the frame's first pixel
  std::uint64_t seen_ = 0;      ///< the edge looked at last
  std::uint64_t det_clocks_ = 0;
  bool det_enabled_ = false;
};

}  // namespace xilinx
