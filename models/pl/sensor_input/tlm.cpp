#include <pl/sensor_input/tlm.h>

namespace pl {

SensorInputTlm::SensorInputTlm(sc_core::sc_module_name name, vp::Clock& clk,
                               const Geometry& geometry, xilinx::Bram& bram)
    : SensorInput(name, clk, geometry, bram) {}

void SensorInputTlm::edge() {
  sleep();
  if (rst) return stop();
  const std::uint64_t cycle = clock().cycle();
  const bool rises = ena && !ena_before_;
  ena_before_ = ena;
  if (running_ && cycle > last_cycle_) {
    frame_ena = false;
    bram_.reads_b.add(geometry_.pixels());
    running_ = false;
  } else if (running_) {
    frame_ena = true;
    wake_at(last_cycle_ + 1);
  }
  if (rises && !running_) start(cycle);
}

void SensorInputTlm::start(std::uint64_t cycle) {
  running_ = true;
  last_cycle_ = cycle + geometry_.pixels();
  view.begin(cycle + 1);
  wake_at(cycle + 1);
}

void SensorInputTlm::stop() {
  if (running_) bram_.reads_b.add(view.sent());
  running_ = ena_before_ = false;
  frame_ena = false;
  view.end();
  wake_at(vp::Clock::never);
}

}  // namespace pl
