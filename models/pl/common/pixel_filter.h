#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>

namespace pl {

/// An IP between sensor input and detectors: takes a frame, gives one of the same size some clocks
/// later. Pixel clock.
class PixelFilter : public vp::Clocked, public vp::Ip {
 public:
  vp::In<bool> rst{"rst", this};
  vp::In<bool> ena{"ena", this};  ///< the sensor's frame_ena
  // Pixel by pixel.
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> frame_ena{"frame_ena"};
  vp::Signal<std::uint8_t> pixel_out{"pixel_out"};
  vp::Signal<std::uint16_t> pixel_x;
  vp::Signal<std::uint16_t> pixel_y;
  // Whole frames.
  FrameIn<GreyFrames> frames_in{"frames_in"};
  GreyFrames frames{"frames", clock()};

 protected:
  PixelFilter(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk),
        Ip(&site.clk),
        pixel_x("pixel_x", site.geometry.words().x_bits()),
        pixel_y("pixel_y", site.geometry.words().y_bits()),
        geometry_(site.geometry) {
    wake_on(rst);
    wake_on(ena);
  }

  const Geometry geometry_;
};

}  // namespace pl
