#pragma once

#include <array>
#include <cstdint>

#include <pl/corner_detection/core.h>
#include <pl/corner_detection/corner_detection.h>
#include <vp/probe.h>

namespace pl {

/// Corner Detection, clocked.
class CornerDetectionClocked : public CornerDetection {
 public:
  CornerDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry);

 private:
  void edge() override;
  void reset();

  CornerCore core_;
  std::uint32_t in_flight_ = 0;  ///< bit n: a corner leaves in n + 1 clocks
  std::array<std::uint32_t, CornerCore::latency + 1> data_{};
  unsigned slot_ = 0;
  vp::Probe<std::uint16_t> new_strength_{"new_strength", [this] { return core_.newest().strength; },
                                         12};
  vp::Probe<std::uint8_t> new_direction_{"new_direction",
                                         [this] { return core_.newest().direction; }, 2};
  vp::Probe<std::uint16_t> centre_strength_{"centre_strength",
                                            [this] { return core_.centre().strength; }, 12};
  vp::Probe<std::uint8_t> centre_direction_{"centre_direction",
                                            [this] { return core_.centre().direction; }, 2};
  vp::Probe<std::uint32_t> in_flight_probe_{"in_flight", in_flight_, CornerCore::latency};
};

}  // namespace pl
