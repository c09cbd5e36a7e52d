#include <pl/sensor_input/clocked.h>

namespace pl {

SensorInputClocked::SensorInputClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                       const Geometry& geometry, xilinx::Bram& bram)
    : SensorInput(name, clk, geometry, bram) {}

void SensorInputClocked::edge() {
  if (rst) {
    running_ = ena_before_ = false;
    frame_ena = false;
    view.end();
    sleep();
    return;
  }
  const bool start = ena && !ena_before_ && !running_;
  ena_before_ = ena;
  frame_ena = running_;
  if (running_) {
    pixel = bram_.read_b(address_++);
    pixel_x = column_;
    pixel_y = row_;
    if (++column_ == geometry_.width) {
      column_ = 0;
      running_ = ++row_ != geometry_.height;
    }
  } else if (!start) {
    sleep();
  }
  if (start) {
    running_ = true;
    address_ = 0;
    column_ = row_ = 0;
    view.begin(clock().cycle() + 1);
  }
}

}  // namespace pl
