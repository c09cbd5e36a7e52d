#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/lanes.h>
#include <pl/pixel_stream/core.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Sends each frame of grey pixels as one packet, four pixels a word, the leftmost in bits 7:0;
/// TLAST comes with the last word.
///
/// A frame that begins while the slave is not ready, or while words of the one before wait, is
/// dropped whole. If the FIFO overflows within a frame, or the frame is cut, its packet ends early:
/// with a word of zeros and TLAST. So packets never mix, and a short one tells of a loss.
class PixelStream : public vp::Clocked, public vp::Ip {
 public:
  static constexpr std::uint32_t pixels_per_word = 4;
  static Models<PixelStream>& models();

  vp::In<bool> rst{"rst", this};
  vp::In<bool> ena{"ena", this};  ///< the camera's frame_ena
  vp::In<std::uint8_t> pixel{"pixel", this};
  Lanes<vp::In<std::uint8_t>> more_pixels;
  FrameIn<GreyFrames> frames{"frames"};  ///< in place of `pixel`
  vp::AxiStreamMaster m{"m", *this};

  // No ports of the IP: for traces and reports. Since the last reset.
  vp::Signal<std::uint32_t> dropped_frames{"dropped_frames"};
  vp::Signal<std::uint32_t> cut_frames{"cut_frames"};

  vp::Parameter<std::uint32_t> fifo_depth{
      "fifo_depth",         64,
      vp::Unit::none,       {2, 65536},
      vp::Source::decision, "words that wait for the DMA, besides the output register"};

  /// Brings the counters up to now.
  virtual void settle() {}

 protected:
  PixelStream(sc_core::sc_module_name name, const Site& site);
  /// All ports but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);
  void show_counts();
  /// Offers what the core has in its output register.
  void drive();

  PixelStreamCore core_;
  const Geometry geometry_;

 private:
  vp::IpEstimate own_estimate() const override;

  vp::Probe<std::uint32_t> fifo_count_{"fifo_count", [this] { return core_.fifo_count(); }, 17};
};

}  // namespace pl
