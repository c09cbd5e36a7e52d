#include <pl/blob_detection/clocked.h>

#include <pl/common/packet.h>

namespace pl {

BlobDetectionClocked::BlobDetectionClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                           const Geometry& geometry)
    : BlobDetection(name, clk, geometry), core_(geometry, label_count) {}

void BlobDetectionClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  const bool frame = ena;
  blob_out = retired_ && filter();
  if (frame && !ena_before_) number_ = 0;
  ena_before_ = frame;
  retired_ = core_.step(frame, pixel, x, y);
  idle = !frame && !retired_ && !core_.flushing();
  if (core_.overflow() != label_overflow) label_overflow = core_.overflow();
  if (!frame && !retired_ && !blob_out.written() && core_.quiescent()) sleep();
}

bool BlobDetectionClocked::filter() {
  const BoundingBox& box = core_.retired();
  if (!box.at_least(minimum_side)) return false;
  blob_start = packet::blob_start(number_, box.sx, box.sy);
  blob_end = packet::blob_end(number_, box.ex, box.ey);
  ++number_;
  return true;
}

void BlobDetectionClocked::reset() {
  core_.reset();
  retired_ = ena_before_ = false;
  number_ = 0;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  sleep();
}

}  // namespace pl
