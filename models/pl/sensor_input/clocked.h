#pragma once

#include <cstdint>

#include <pl/common/geometry.h>
#include <vp/clock.h>
#include <vp/probe.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// Sensor Input, clocked (thesis 4.3.2, ports of table B.7): reads the stored image from port B of
/// the BRAM and plays it as a camera sensor would, one pixel per pixel clock.
class SensorInputClocked : public vp::Clocked {
 public:
  SensorInputClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                     xilinx::Bram& bram);

  vp::In<bool> ena{"ena", this};  ///< a rise starts a frame; ignored while one runs
  vp::In<bool> rst{"rst", this};
  vp::Signal<bool> frame_ena{"frame_ena"};
  vp::Signal<std::uint8_t> pixel{"pixel"};
  vp::Signal<std::uint16_t> pixel_x{"pixel_x", 10};
  vp::Signal<std::uint16_t> pixel_y{"pixel_y", 9};

 private:
  void edge() override;

  Geometry geometry_;
  xilinx::Bram& bram_;
  std::uint32_t address_ = 0;
  std::uint16_t column_ = 0, row_ = 0;
  bool running_ = false;
  bool ena_before_ = false;
  vp::Probe<std::uint32_t> address_probe_{"address", address_, 19};
  vp::Probe<bool> running_probe_{"running", running_};
};

}  // namespace pl
