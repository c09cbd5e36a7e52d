#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <systemc>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/common/dual_clock_fifo.h>
#include <xilinx/v_vid_in_axi4s/video_camera.h>

namespace xilinx {

/// Build options, as Vivado asks for them.
struct VVidInAxi4sBuild {
  VideoFormat format = VideoFormat::rgb;
  unsigned components = 3;          ///< of a pixel
  unsigned component_bits = 8;      ///< of each, on the stream
  unsigned native_bits = 8;         ///< of each, at the native pins
  std::uint32_t fifo_depth = 1024;  ///< 2 to the power of C_ADDR_WIDTH
  bool has_async_clk = true;
};

/// Video In to AXI4-Stream v5.0 (PG043), one pixel a clock. A frame begins with the first active
/// pixel behind a vertical sync or blank: TUSER(0). The last pixel of a line, behind which active
/// video falls, takes TLAST along. A pixel for which the FIFO has no room is lost.
///
/// With `frames_from` pictures of files are at its native pins, in the usual timing of their size,
/// and what is wired there is not looked at.
class VVidInAxi4s : public vp::Clocked, public vp::Ip {
 public:
  VVidInAxi4s(sc_core::sc_module_name name, vp::Clock& vid_io_in_clk, vp::Clock& aclk,
              const VVidInAxi4sBuild& build = {});
  const char* kind() const override { return "xilinx::VVidInAxi4s"; }

  vp::Parameter<std::uint32_t> fifo_depth;
  vp::Parameter<std::uint32_t> input_clocks;
  vp::Parameter<std::string> frames_from;
  vp::Parameter<std::string> component_order;

  // All may be left open: enabled, no reset, blank.
  vp::In<bool> vid_io_in_ce{"vid_io_in_ce", this}, vid_io_in_reset{"vid_io_in_reset", this};
  vp::In<bool> aresetn{"aresetn"}, axis_enable{"axis_enable", this};
  vp::In<bool> aclken{"aclken"};  ///< low: no further pixel goes out
  vp::In<bool> vid_active_video{"vid_active_video", this};
  vp::In<bool> vid_hsync{"vid_hsync", this}, vid_vsync{"vid_vsync", this};
  vp::In<bool> vid_hblank{"vid_hblank", this}, vid_vblank{"vid_vblank", this};
  vp::In<std::uint64_t> vid_data{"vid_data", this};

  /// The timing for a detector, a clock later.
  vp::Signal<bool> vtd_active_video{"vtd_active_video"};
  vp::Signal<bool> vtd_hsync{"vtd_hsync"}, vtd_vsync{"vtd_vsync"};
  vp::Signal<bool> vtd_hblank{"vtd_hblank"}, vtd_vblank{"vtd_vblank"};
  vp::Signal<bool> overflow{"overflow"};    ///< high on a clock that lost a pixel
  vp::Signal<bool> underflow{"underflow"};  ///< never: a stream may be empty

  vp::Counter pixels{"pixels", "pixels that came"};
  vp::Counter lost{"lost", "pixels for which the FIFO had no room"};

  vp::AxiStreamMaster& m_axis_video() { return stream_->m_axis_video; }
  unsigned stream_bytes() const { return stream_bytes_; }

 private:
  struct Pixel {
    std::uint64_t data = 0;
    bool first = false, last = false;
  };
  using Fifo = DualClockFifo<Pixel>;

  /// The side of the stream.
  class Stream : public vp::Clocked {
   public:
    Stream(sc_core::sc_module_name name, vp::Clock& aclk, VVidInAxi4s& in);
    const char* kind() const override { return "xilinx::VVidInStream"; }
    vp::AxiStreamMaster m_axis_video{"m_axis_video", *this};

   private:
    void end_of_elaboration() override;
    void edge() override;
    void offer(const Pixel& pixel);

    VVidInAxi4s& in_;
    vp::Signal<std::uint32_t>* user_ = nullptr;
  };

  struct Sample {
    VideoLevels levels;
    std::uint64_t data = 0;
  };
  /// A pixel on its way through the input registers.
  struct OnWay {
    Pixel pixel;
    std::uint64_t due = 0;  ///< by `ticks_`
  };

  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  vp::IpEstimate own_estimate() const override;
  Sample sample(std::uint64_t cycle) const;
  void take(const Sample& now);
  void write_due();
  void write(const Pixel& pixel);
  bool in_reset() const;

  const VVidInAxi4sBuild build_;
  const unsigned stream_bytes_;
  Fifo fifo_;
  std::unique_ptr<Stream> stream_;
  VideoCamera camera_;
  VideoLevels last_{false, false, false, false, false};
  bool frame_next_ = false;  ///< a vertical sync or blank came: the next pixel begins a frame
  bool flows_ = false;       ///< since a frame's first pixel
  bool holds_ = false;       ///< held_ is a pixel of which it is not known whether it is the last
  OnWay held_;
  std::deque<OnWay> on_way_;
  std::uint64_t ticks_ = 0;  ///< enabled clocks
};

}  // namespace xilinx
