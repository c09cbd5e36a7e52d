#include <pl/sensor_input/tlm.h>

#include <algorithm>

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
    count(geometry_.pixels());
    running_ = false;
  } else if (running_) {
    frame_ena = true;
    wake_at(last_cycle_ + 1);
  }
  if (rises && !running_) start(cycle);
}

void SensorInputTlm::start(std::uint64_t cycle) {
  running_ = true;
  counted_ = 0;
  last_cycle_ = cycle + geometry_.pixels();
  view.begin(cycle + 1);
  wake_at(cycle + 1);
}

// A pixel leaves on each edge after the one that started the frame.
void SensorInputTlm::settle() {
  const std::uint64_t started = last_cycle_ - geometry_.pixels();
  if (running_) count(std::min(clock().cycle(), last_cycle_) - started);
}

void SensorInputTlm::count(std::uint64_t read) {
  bram_.reads_b.add(read - counted_);
  counted_ = read;
}

void SensorInputTlm::stop() {
  if (running_) count(view.sent());
  running_ = ena_before_ = false;
  frame_ena = false;
  view.end();
  wake_at(vp::Clock::never);
}

}  // namespace pl
