#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <utility>

#include <marker_logic.h>
#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/camera/camera_clock.h>
#include <pl/common/fidelity.h>
#include <pl/common/geometry.h>
#include <pl/control_block/control_block.h>
#include <pl/control_crossing/control_crossing.h>
#include <pl/global_threshold/global_threshold.h>
#include <pl/local_threshold/local_threshold.h>
#include <pl/otsu_threshold/otsu_threshold.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <pl/stream_crossing/stream_crossing.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/concat/concat.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>

namespace platform {

/// How each IP is modelled that can be modelled in more than one way.
struct ImprovedFidelity : sc_core::sc_module {
  ImprovedFidelity(sc_core::sc_module_name name, pl::Fidelity otherwise,
                   const pl::Models<pl::GlobalThreshold>& thresholds);

  pl::Choice<pl::ControlCrossing> control_crossing;
  pl::Choice<pl::StreamCrossing> pixel_crossing, blob_crossing;
  // A part that feeds another one comes behind it.
  pl::Choice<pl::PixelStream> pixel_stream;
  pl::Choice<pl::BlobStream> blob_stream;
  pl::Choice<pl::BlobLabelling> blob_labelling;
  pl::Choice<pl::GlobalThreshold> threshold;
  pl::Choice<pl::Camera> camera;
};

/// The programmable logic of the design `improved`: the camera's pixels go to the DDR as they are,
/// and through threshold and labelling to become a packet of blobs. No frame in block memory.
///
/// One clock, unless the camera has one of its own, or blanks lines: then what takes pixels has
/// that clock, and control packet and both streams cross between it and the buses' clock.
///
///   camera ─┬─ pixel_stream ── axi_dma_0 ── DDR
///           └─ threshold ── blob_labelling ── blob_stream ── axi_dma_1 ── DDR
class ImprovedLogic : public sc_core::sc_module {
 public:
  /// `usual`: the size of frames unless another is configured.
  ImprovedLogic(sc_core::sc_module_name name, vp::Clock& clk, pl::Fidelity otherwise,
                const pl::Geometry& usual);

  vp::Parameter<std::string> threshold_rule{
      "threshold_rule",
      "otsu",
      {"otsu", "global", "local"},
      vp::Source::decision,
      "otsu, global: how the threshold of the next frame follows from a frame's histogram, with "
      "Otsu's least variance, or midway between the peaks of its halves (thesis 4.3.5); local: "
      "what is darker than its surroundings is dark"};
  /// False: a pixel's surroundings decide, not the frame before.
  bool has_frame_threshold() const { return threshold_rule.get() != "local"; }
  ImprovedFidelity fidelity;
  vp::Parameter<std::uint32_t> width, height;
  vp::Parameter<std::uint32_t> burst_words;
  vp::Parameter<std::uint32_t> pixels_per_clock{
      "pixels_per_clock",
      1,
      vp::Unit::none,
      {1, 4},
      vp::Source::decision,
      "neighbours in a row that camera, threshold and labelling take on one edge: 1, 2 or 4. With "
      "4 the stream of pictures is full, and its DMA writes 64 bits a clock"};
  pl::Geometry geometry() const { return {width, height, burst_words, pixels_per_clock}; }

  /// Resets all that takes pixels.
  vp::Signal<bool>& logic_rst() {
    return crossing_ ? crossing_->control_crossing->rst : control_block.rst_out;
  }

  /// Brings counters up to now, for observers from outside.
  void settle_counters();

 private:
  void before_end_of_elaboration() override;
  void make_crossing(vp::Clock& clk);
  void connect_control();
  template <class Control>
  void connect_control(Control& control, vp::Signal<bool>& por);
  void connect_pixels();
  void connect_blobs();
  void connect_bus();
  void connect_streams();
  void name_groups();
  void count_work();

  /// Refuses sizes that cannot be built before anything is made for them. A packet need not be
  /// whole bursts.
  struct SizeCheck {
    explicit SizeCheck(const pl::Geometry& geometry) {
      pl::check({geometry.width, geometry.height, marker_logic::min_burst_words,
                 geometry.pixels_per_clock});
    }
  } size_check_{geometry()};

 public:
  pl::ControlBlock control_block{"control_block"};
  pl::CameraClock camera_clk;
  // Modelled as `fidelity` says.
  const std::unique_ptr<pl::Camera> camera_;
  pl::Camera& camera = *camera_;
  const std::unique_ptr<pl::PixelStream> pixel_stream_;
  pl::PixelStream& pixel_stream = *pixel_stream_;
  const std::unique_ptr<pl::GlobalThreshold> threshold_;
  pl::GlobalThreshold& threshold = *threshold_;
  const std::unique_ptr<pl::BlobLabelling> blob_labelling_;
  pl::BlobLabelling& blob_labelling = *blob_labelling_;
  const std::unique_ptr<pl::BlobStream> blob_stream_;
  pl::BlobStream& blob_stream = *blob_stream_;

  xilinx::ProcSysReset proc_sys_reset;
  xilinx::AxiInterconnect axi_interconnect;      ///< GP0 to the registers
  xilinx::AxiInterconnect axi_mem_interconnect;  ///< DMA to HP0
  xilinx::AxiGpio axi_gpio_0;                    ///< control packet, all outputs
  xilinx::AxiDma axi_dma_0;                      ///< pixels to DDR, write channel only
  xilinx::AxiDma axi_dma_1;                      ///< blobs to DDR, write channel only
  vp::AxiStream pixel_stream_link{"pixels"};
  vp::AxiStream blob_stream_link{"blobs"};
  xilinx::Concat concat;  ///< interrupts of both DMAs

 private:
  /// Between the clock of pixels and that of buses.
  struct Crossing {
    /// `streams`: on either side of theirs.
    Crossing(const ImprovedFidelity& fidelity, const pl::Site& control, const pl::Site& streams)
        : control_crossing(fidelity.control_crossing.make(control)),
          pixel_crossing(fidelity.pixel_crossing.make(streams)),
          blob_crossing(fidelity.blob_crossing.make(streams)) {}

    const std::unique_ptr<pl::ControlCrossing> control_crossing;
    const std::unique_ptr<pl::StreamCrossing> pixel_crossing, blob_crossing;
    vp::AxiStream pixels_before_crossing{"pixels_before_crossing"};
    vp::AxiStream blobs_before_crossing{"blobs_before_crossing"};
  };

  std::optional<Crossing> crossing_;  ///< none where both are one clock
};

}  // namespace platform
