#include <pl/corner_detection/clocked.h>

#include <pl/common/packet.h>

namespace pl {

CornerDetectionClocked::CornerDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                               const Geometry& geometry)
    : CornerDetection(name, clk), core_(geometry, threshold) {}

void CornerDetectionClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  const bool leaves = in_flight_ & 1;
  in_flight_ >>= 1;
  slot_ = slot_ == CornerCore::latency ? 0 : slot_ + 1;
  corner_out = leaves;
  if (leaves) corner_data = data_[slot_];
  if (ena) {
    Corner corner;
    if (core_.push(pixel, x, y, corner)) {
      in_flight_ |= 1u << (CornerCore::latency - 1);
      const unsigned last = slot_ == 0 ? CornerCore::latency : slot_ - 1;
      data_[last] = packet::corner(corner.strength, corner.direction, corner.x, corner.y);
    }
  } else if (!leaves && in_flight_ == 0) {
    sleep();
  }
}

void CornerDetectionClocked::reset() {
  core_.reset();
  in_flight_ = 0;
  corner_out = false;
  sleep();
}

}  // namespace pl
