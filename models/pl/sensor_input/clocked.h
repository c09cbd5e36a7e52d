#pragma once

#include <cstdint>

#include <pl/sensor_input/sensor_input.h>
#include <vp/probe.h>

namespace pl {

/// Sensor Input, clocked.
class SensorInputClocked : public SensorInput {
 public:
  SensorInputClocked(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                     xilinx::Bram& bram);

 private:
  void edge() override;

  std::uint32_t address_ = 0;
  std::uint16_t column_ = 0, row_ = 0;
  bool running_ = false;
  vp::Probe<std::uint32_t> address_probe_{"address", address_, 19};
  vp::Probe<bool> running_probe_{"running", running_};
};

}  // namespace pl
