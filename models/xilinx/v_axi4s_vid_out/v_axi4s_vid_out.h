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
#include <xilinx/v_tc/video_timing.h>
#include <xilinx/video_frames/video_frames.h>

namespace xilinx {

/// Build options, as Vivado asks for them.
struct VAxi4sVidOutBuild {
  VideoFormat format = VideoFormat::rgb;
  unsigned components = 3;          ///< of a pixel
  unsigned component_bits = 8;      ///< of each, on the stream
  unsigned native_bits = 8;         ///< of each, at the native pins
  std::uint32_t fifo_depth = 1024;  ///< 2 to the power of C_ADDR_WIDTH
  std::uint32_t hysteresis = 12;    ///< pixels in the FIFO before a frame begins
  std::uint32_t lock_frames = 4;    ///< C_SYNC_LOCK_THRESHOLD
  bool has_async_clk = true;
  bool timing_is_master = false;  ///< C_VTG_MASTER_SLAVE
};

/// AXI4-Stream to Video Out v4.0 (PG044), one pixel a clock. It drops what comes before TUSER(0),
/// lets the timing come to a frame's first pixel, and holds it there by vtg_ce until the FIFO has a
/// frame's beginning and some pixels more. With the timing as master it holds the stream instead.
/// A frame or line whose ends do not meet, or a FIFO that runs empty, loses the lock: the rest of
/// the frame is black, and the next one begins anew.
///
/// With `frames_to` each whole frame goes into a file.
class VAxi4sVidOut : public vp::Clocked, public vp::Ip {
 public:
  VAxi4sVidOut(sc_core::sc_module_name name, vp::Clock& vid_io_out_clk, vp::Clock& aclk,
               const VAxi4sVidOutBuild& build = {});
  const char* kind() const override { return "xilinx::VAxi4sVidOut"; }

  vp::Parameter<std::uint32_t> fifo_depth;
  vp::Parameter<std::uint32_t> hysteresis;
  vp::Parameter<std::uint32_t> lock_frames;
  vp::Parameter<std::string> frames_to;
  vp::Parameter<std::uint32_t> most_frames;
  vp::Parameter<std::string> component_order;

  // All may be left open: enabled, and no reset.
  vp::In<bool> vid_io_out_ce{"vid_io_out_ce", this}, vid_io_out_reset{"vid_io_out_reset", this};
  vp::In<bool> aresetn{"aresetn"};
  vp::In<bool> aclken{"aclken"};  ///< low: no pixel comes in
  vp::In<bool> vtg_active_video{"vtg_active_video", this};
  vp::In<bool> vtg_hsync{"vtg_hsync", this}, vtg_vsync{"vtg_vsync", this};
  vp::In<bool> vtg_hblank{"vtg_hblank", this}, vtg_vblank{"vtg_vblank", this};

  vp::Signal<bool> vtg_ce{"vtg_ce", 1, true};
  vp::Signal<bool> vid_active_video{"vid_active_video"};
  vp::Signal<bool> vid_hsync{"vid_hsync"}, vid_vsync{"vid_vsync"};
  vp::Signal<bool> vid_hblank{"vid_hblank"}, vid_vblank{"vid_vblank"};
  vp::Signal<std::uint64_t> vid_data;
  vp::Signal<bool> locked{"locked"};
  vp::Signal<bool> overflow{"overflow"};    ///< never: the stream waits
  vp::Signal<bool> underflow{"underflow"};  ///< high on a clock that found no pixel

  vp::Counter frames{"frames", "whole frames that went out"};
  vp::Counter black{"black", "active pixels that were black since no pixel was there for them"};

  vp::AxiStreamSlave& s_axis_video() { return stream_->s_axis_video; }
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
    Stream(sc_core::sc_module_name name, vp::Clock& aclk, VAxi4sVidOut& out, unsigned bytes);
    const char* kind() const override { return "xilinx::VAxi4sVidOutStream"; }
    vp::AxiStreamSlave s_axis_video{"s_axis_video", *this};
    bool waits_for_room() const { return full_; }

   private:
    void end_of_elaboration() override;
    void edge() override;

    VAxi4sVidOut& out_;
    const unsigned bytes_;
    const vp::Signal<std::uint32_t>* user_ = nullptr;
    bool full_ = false;
  };

  /// The timing on a clock that counts.
  struct Timing {
    VideoLevels levels;
    bool first = false;  ///< a frame's first pixel
  };
  enum class Step : std::uint8_t { passed, held };

  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  vp::IpEstimate own_estimate() const override;
  bool in_reset() const;
  void take_timing();
  Step show(const Timing& now);
  bool may_begin();
  void drop_to_frame();
  void begin_frame();
  void end_frame();
  void end_line();
  std::uint64_t next_pixel(const Timing& now);
  Pixel pop();
  void lose(const char* why);
  void reset();

  const VAxi4sVidOutBuild build_;
  const unsigned stream_bytes_;
  Fifo fifo_;
  std::unique_ptr<Stream> stream_;
  FrameWriter writer_;

  VideoLevels last_timing_;  ///< as taken last
  bool frame_next_ = false;  ///< a vertical sync or blank came
  bool ce_one_ago_ = true, ce_two_ago_ = true;
  std::deque<Timing> waiting_;  ///< taken, and not shown
  VideoLevels shown_;
  bool aligned_ = false;   ///< pixels of the FIFO are those of the timing
  bool in_frame_ = false;  ///< since its first pixel, all in place
  Pixel last_pixel_;
  std::uint32_t good_frames_ = 0;  ///< one after the other
  bool warned_ = false;
};

}  // namespace xilinx
