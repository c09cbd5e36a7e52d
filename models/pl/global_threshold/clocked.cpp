#include <pl/global_threshold/clocked.h>

namespace pl {

GlobalThresholdClocked::GlobalThresholdClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                               const Geometry& geometry)
    : GlobalThreshold(name, clk, geometry) {}

void GlobalThresholdClocked::edge() {
  if (por || rst) {
    reset();
    return;
  }
  const bool frame = frame_ena;
  binary_ena = frame;
  thresh_out = false;
  const bool frame_ended = !frame && frame_before_;
  if (frame) take_pixel();
  if (frame_ended) core_.end_frame();
  if (wr_thresh) core_.set_threshold(threshold);  // wins over the frame's own
  if (frame_ended || wr_thresh) active_threshold = core_.threshold();
  if (!frame && !frame_before_ && !wr_thresh) sleep();
  frame_before_ = frame;
}

void GlobalThresholdClocked::take_pixel() {
  const bool dark = core_.push(pixel);
  const std::uint16_t column = x;
  binary_out = dark;
  binary_x = column;
  binary_y = y;
  word_ = word_ >> 1 | std::uint32_t{dark} << 31;
  if (column % 32 == 31) {
    thresh_out = true;
    thresh_data = word_;
  }
}

void GlobalThresholdClocked::reset() {
  if (por) core_.set_threshold(ThresholdCore::default_threshold);
  core_.clear_histogram();
  active_threshold = core_.threshold();
  binary_ena = false;
  thresh_out = false;
  frame_before_ = false;
  sleep();
}

}  // namespace pl
