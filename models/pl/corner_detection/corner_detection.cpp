#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <pl/corner_detection/models.h>

namespace pl {

Models<CornerDetection>& CornerDetection::models() {
  static Models<CornerDetection> models{
      "corner_detection",
      {model<CornerDetection, CornerDetectionClocked>("clocked", by_pixel, no_image),
       model<CornerDetection, CornerDetectionTlm>("tlm", by_frame, no_image)},
      rtl_model<CornerDetection, CornerDetectionClocked>()};
  return models;
}

void CornerDetection::connect(RtlPins& pins) {
  pins.input(ena);
  pins.input(rst);
  pins.input(pixel);
  pins.input(x, 10);
  pins.input(y, 9);
  pins.output(corner_out);
  pins.output(corner_data, &corner_out);
  pins.parameter("WIDTH", "pl.width", geometry_.width);
  pins.parameter("THRESHOLD", threshold.name(), threshold);
}

CornerDetectionClocked::CornerDetectionClocked(sc_core::sc_module_name name, const Site& site)
    : CornerDetection(name, site), core_(geometry_, threshold) {}

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
      data_[last] = geometry_.words().corner(corner.strength, corner.direction, corner.x, corner.y);
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

// Window, nine FAST modules side by side, and eight line FIFOs of a write depth of 1024.
//
// The non-maximum suppression is the thesis' pipelined one. To see what one would allow that
// compares nine strengths in one clock, set timing.corner_detection.fmax to 36.63 MHz (4.3.4.4).
vp::IpEstimate CornerDetection::own_estimate() const {
  constexpr std::uint32_t fast_modules = 9, circle = 16, lines = 8;
  const std::uint32_t line_depth = 1u << marker_logic::bits_for(geometry_.width, 10);
  constexpr std::uint32_t compare_and_subtract = 25, sum = 150, contiguous = 60, direction = 40;
  constexpr std::uint32_t fast_lut = circle * compare_and_subtract + sum + contiguous + direction;
  constexpr std::uint32_t fast_ff = circle * 9 + 15;  // differences, then strength and direction
  constexpr std::uint32_t window_ff = 9 * 9 * 8;

  vp::IpEstimate e;
  e.kind = "corner_detection";
  e.lut = fast_modules * fast_lut + lines * 45 + 250;
  e.ff = fast_modules * fast_ff + window_ff + lines * 30 + 250;
  e.bram36 = lines * xilinx::block_ram_36(line_depth, 8);
  e.uncertainty_percent = 40;
  e.source = "derived from the structure of thesis 4.3.4: 9 FAST modules of 650 LUT, 8 line FIFOs";
  e.fmax_hz = 100 * mhz;
  // Its structure through Yosys' synthesis for the 7 series, without any wire.
  e.fmax_high_hz = 236 * mhz;
  e.fmax_origin = vp::FmaxOrigin::published;
  e.fmax_documentation =
      "runs comfortably at it (thesis 4.6.1); the cells of its longest path alone take 4.23 ns "
      "(Yosys)";
  return e;
}

}  // namespace pl
