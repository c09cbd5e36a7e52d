#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <pl/global_threshold/models.h>

namespace pl {

Models<GlobalThreshold>& GlobalThreshold::models() {
  static Models<GlobalThreshold> models{
      "global_threshold",
      {model<GlobalThreshold, GlobalThresholdClocked>("clocked", by_pixel, by_pixel),
       model<GlobalThreshold, GlobalThresholdTlm>("tlm", by_frame, by_frame)},
      rtl_model<GlobalThreshold, GlobalThresholdClocked>()};
  return models;
}

void GlobalThreshold::connect(RtlPins& pins) {
  pins.input(por);
  pins.input(rst);
  pins.input(frame_ena);
  pins.input(wr_thresh);
  pins.input(threshold);
  pins.input(pixel);
  pins.input(x, 10);
  pins.input(y, 9);
  pins.output(binary_ena);
  pins.output(binary_out, &binary_ena);
  pins.output(binary_x, &binary_ena);
  pins.output(binary_y, &binary_ena);
  pins.output(thresh_out);
  pins.output(thresh_data, &thresh_out);
  pins.report(active_threshold);
  pins.parameter("WIDTH", "pl.width", geometry_.width);
  pins.parameter("HEIGHT", "pl.height", geometry_.height);
}

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

// The histogram is cleared in one clock, so its 256 counters are registers, each as wide as the
// number of pixels, read through a multiplexer.
vp::IpEstimate GlobalThreshold::own_estimate() const {
  constexpr std::uint32_t levels = 256;
  std::uint32_t bits = 1;
  while ((std::uint64_t{1} << bits) <= geometry_.pixels()) ++bits;

  vp::IpEstimate e;
  e.kind = "global_threshold";
  e.lut = 150 + levels * 3 / 2 + levels * bits / 3;  // clock enables, multiplexer
  e.ff = 150 + levels * bits;
  e.uncertainty_percent = 40;
  e.source = "derived from the structure of thesis 4.3.5: 256 counters in registers";
  e.fmax_hz = 100 * mhz;
  e.fmax_origin = vp::FmaxOrigin::published;
  e.fmax_documentation = "runs comfortably at it (thesis 4.6.1)";
  return e;
}

}  // namespace pl
