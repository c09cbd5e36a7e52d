#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>

namespace pl {

class RtlPins;

/// Blob Detection (thesis 4.3.6, ports of table B.3, and `idle`, decision).
class BlobDetection : public vp::Clocked, public vp::Ip {
 public:
  static Models<BlobDetection>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  // The image pixel by pixel.
  vp::In<bool> pixel{"pixel", this};  ///< 1 is dark
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  FrameIn<BinaryFrames> frames{"frames"};  ///< the image as a whole
  vp::Signal<bool> blob_out{"blob_out"};
  vp::Signal<std::uint32_t> blob_start{"blob_start"};
  vp::Signal<std::uint32_t> blob_end{"blob_end"};
  vp::Signal<bool> idle{"idle", 1, true};  ///< no frame, and every label retired
  /// Dark pixels that found no free label since the last reset; complete at the end of the frame,
  /// and after settle().
  vp::Signal<std::uint32_t> label_overflow{"label_overflow"};

  vp::Parameter<std::uint32_t> label_count{
      "label_count",
      128,
      vp::Unit::none,
      {4, 1024},
      vp::Source::decision,
      "labels, the background's included; the thesis does not give its number"};
  vp::Parameter<std::uint32_t> minimum_side{
      "minimum_side",
      24,
      vp::Unit::pixels,
      {1, 1023},
      vp::Source::published,
      "smallest Ex - Sx and Ey - Sy of a blob that is reported (thesis 4.3.6.4)"};

  /// Brings label_overflow up to now, in the middle of a frame, too.
  virtual void settle() {}

 protected:
  BlobDetection(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk), Ip(&site.clk), geometry_(site.geometry) {
    wake_on(ena);
    wake_on(rst);
  }

  const Geometry geometry_;

  /// All ports but the clock, to RTL that stands in its place.
  void connect(RtlPins& pins);

 private:
  vp::IpEstimate own_estimate() const override;
};

}  // namespace pl
