#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>

namespace pl {

class RtlPins;

/// Corner Detection (thesis 4.3.4, ports of table B.1). One pixel per pixel clock.
class CornerDetection : public vp::Clocked, public vp::Ip {
 public:
  static Models<CornerDetection>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  // The image pixel by pixel.
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  FrameIn<GreyFrames> frames{"frames"};  ///< the image as a whole
  vp::Signal<bool> corner_out{"corner_out"};
  vp::Signal<std::uint32_t> corner_data{"corner_data"};  ///< valid while corner_out is high

  vp::Parameter<std::uint32_t> threshold{
      "threshold",
      30,
      vp::Unit::none,
      {0, 255},
      vp::Source::decision,
      "a circle pixel is bright if it exceeds the point of interest by more (grey levels)"};

 protected:
  CornerDetection(sc_core::sc_module_name name, const Site& site)
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
