#pragma once

#include <cstdint>

#include <pl/common/geometry.h>
#include <pl/sensor_input/frame_view.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// Sensor Input (thesis 4.3.2, ports of table B.7): reads the stored image from port B of the BRAM
/// and plays it as a camera sensor would, one pixel per pixel clock.
class SensorInput : public vp::Clocked, public vp::Ip {
 public:
  vp::In<bool> ena{"ena", this};  ///< a rise starts a frame; ignored while one runs
  vp::In<bool> rst{"rst", this};
  vp::Signal<bool> frame_ena{"frame_ena"};
  // Clocked fidelity only; the transaction level shows the whole frame in `view`.
  vp::Signal<std::uint8_t> pixel{"pixel"};
  vp::Signal<std::uint16_t> pixel_x{"pixel_x", 10};
  vp::Signal<std::uint16_t> pixel_y{"pixel_y", 9};

  FrameView view;

  /// Brings the memory's count of reads up to now, in the middle of a frame, too.
  virtual void settle() {}

 protected:
  SensorInput(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
              xilinx::Bram& bram)
      : Clocked(name, clk), Ip(&clk), view(clk, geometry, bram), geometry_(geometry), bram_(bram) {
    wake_on(ena);
    wake_on(rst);
  }

  const Geometry geometry_;
  xilinx::Bram& bram_;
  bool ena_before_ = false;

 private:
  vp::IpEstimate own_estimate() const override;
};

}  // namespace pl
