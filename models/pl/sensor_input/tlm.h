#pragma once

#include <cstdint>

#include <pl/sensor_input/sensor_input.h>

namespace pl {

/// Sensor Input at transaction level: frame_ena rises and falls at its clocks, the pixels between
/// are in `view`.
class SensorInputTlm : public SensorInput {
 public:
  SensorInputTlm(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                 xilinx::Bram& bram);

  void settle() override;

 private:
  void edge() override;
  void start(std::uint64_t cycle);
  void stop();
  void count(std::uint64_t read);

  bool running_ = false;          ///< from the frame's start until frame_ena has fallen
  std::uint64_t last_cycle_ = 0;  ///< edge on which the frame's last pixel leaves
  std::uint64_t counted_ = 0;     ///< the frame's pixels that stand in the memory's count
};

}  // namespace pl
