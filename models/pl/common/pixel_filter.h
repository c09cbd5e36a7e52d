#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <pl/common/geometry.h>
#include <vp/clock.h>
#include <vp/ip.h>

namespace pl {

/// An IP between sensor input and detectors: takes a frame, gives one of the same size some clocks
/// later. Pixel clock.
class PixelFilter : public vp::Clocked, public vp::Ip {
 public:
  vp::In<bool> rst{"rst", this};
  vp::In<bool> ena{"ena", this};  ///< the sensor's frame_ena
  // Clocked fidelity only.
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> frame_ena{"frame_ena"};
  vp::Signal<std::uint8_t> pixel_out{"pixel_out"};
  vp::Signal<std::uint16_t> pixel_x{"pixel_x", 10};
  vp::Signal<std::uint16_t> pixel_y{"pixel_y", 9};

  /// Transaction level only: the filtered frame.
  virtual FrameChannel& frames() = 0;

 protected:
  PixelFilter(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk), Ip(&clk) {
    wake_on(rst);
    wake_on(ena);
  }
};

/// What a filter is made of. `source`: the frames that it filters, at transaction level.
struct FilterSite {
  vp::Clock& clk;
  Geometry geometry;
  Fidelity fidelity;  ///< of what it feeds
  FrameChannel& source;
};

/// Makes a filter as a member of the feature extraction.
using MakeFilter = std::function<std::unique_ptr<PixelFilter>(const FilterSite& site)>;

}  // namespace pl
