#pragma once

#include <array>
#include <cstdint>

#include <pl/corner_detection/core.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

/// Corner Detection, clocked (thesis 4.3.4, ports of table B.1). One pixel per pixel clock.
class CornerDetectionClocked : public vp::Clocked {
 public:
  CornerDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry);

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> corner_out{"corner_out"};
  vp::Signal<std::uint32_t> corner_data{"corner_data"};  ///< valid while corner_out is high

  vp::Parameter<std::uint32_t> threshold{
      "threshold",
      30,
      vp::Unit::none,
      {0, 255},
      vp::Source::decision,
      "a circle pixel is bright if it exceeds the point of interest by more (grey levels)"};

 private:
  void edge() override;
  void reset();

  CornerCore core_;
  std::uint32_t in_flight_ = 0;  ///< bit n: a corner leaves in n + 1 clocks
  std::array<std::uint32_t, CornerCore::latency + 1> data_{};
  unsigned slot_ = 0;
  vp::Probe<std::uint32_t> in_flight_probe_{"in_flight", in_flight_, CornerCore::latency};
};

}  // namespace pl
