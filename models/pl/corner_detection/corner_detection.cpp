#include <pl/corner_detection/corner_detection.h>

#include <algorithm>

#include <pl/common/estimate.h>
#include <pl/common/known_frames.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<CornerDetection>& CornerDetection::models() {
  static Models<CornerDetection> models{
      "corner_detection",
      {model<CornerDetection, CornerDetectionClocked>("clocked", by_pixel, no_image),
       model<CornerDetection, CornerDetectionTlm>("tlm", by_frame, no_image)},
      rtl_model<CornerDetection, CornerDetectionClocked>()};
  return models;
}

void CornerDetection::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(pixel);
  ports.input(x, geometry_.words().x_bits());
  ports.input(y, geometry_.words().y_bits());
  ports.output(corner_out);
  ports.output(corner_data, &corner_out);
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("THRESHOLD", threshold.name(), threshold);
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
  constexpr std::uint32_t lines = 8;
  const std::uint32_t line_depth = 1u << marker_logic::bits_for(geometry_.width, 10);
  vp::IpEstimate e = rtl_ip("corner_detection", {{"LEAN", 0}});
  e.bram36 = lines * xilinx::block_ram_36(line_depth, 8);
  e.fmax_documentation = "runs comfortably at 100 MHz (thesis 4.6.1)";
  return e;
}

CornerDetectionTlm::CornerDetectionTlm(sc_core::sc_module_name name, const Site& site)
    : CornerDetection(name, site), frame_(geometry_, threshold) {}

void CornerDetectionTlm::end_of_elaboration() {
  CornerDetection::end_of_elaboration();
  frames.channel().add_listener(*this);
}

void CornerDetectionTlm::edge() {
  sleep();
  if (rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  if (ena && !ena_before_) begin(cycle);
  ena_before_ = ena;
  if (cycle >= changed_cycle_) find_again(cycle);
  emit(cycle);
  wake_at(next_change(cycle));
}

void CornerDetectionTlm::emit(std::uint64_t cycle) {
  const bool leaves = next_ < corners_.size() && corners_[next_].clock == cycle;
  if (leaves) corner_data = corners_[next_++].word;
  corner_out = leaves;
}

std::uint64_t CornerDetectionTlm::next_change(std::uint64_t cycle) const {
  if (corner_out.written()) return cycle + 1;
  const std::uint64_t corner = next_ < corners_.size() ? corners_[next_].clock : vp::Clock::never;
  return std::min(corner, changed_cycle_);
}

// The last corners of the frame before may still be under way.
void CornerDetectionTlm::begin(std::uint64_t cycle) {
  corners_.erase(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  begin_ = cycle;
  changed_cycle_ = vp::Clock::never;
  frame_.begin(frames->data());
  static KnownFrames<std::vector<StampedWord>> known;
  const std::uint64_t parameter = std::uint64_t{geometry_.width} << 32 | threshold;
  const std::vector<StampedWord> corners =
      known.result(frames->data(), geometry_.pixels(), parameter, [&] {
        std::vector<StampedWord> found;
        frame_.advance(geometry_.height, found);
        return found;
      });
  append(corners);
}

void CornerDetectionTlm::pixels_changed(std::uint32_t first, std::uint32_t) {
  const std::uint64_t taken = begin_ + first;
  // A pixel of a frame that begins here only in the next clocks is not known yet.
  const std::uint64_t cycle = clock().cycle();
  if (taken <= cycle || taken >= changed_cycle_) return;
  changed_ = first;
  changed_cycle_ = taken;
  wake_at(next_change(cycle));
}

// Corners that a changed row completes are found again; what left already stays.
void CornerDetectionTlm::find_again(std::uint64_t cycle) {
  const std::uint32_t row = changed_ / geometry_.width;
  const std::uint64_t row_begin =
      begin_ + CornerCore::latency + std::uint64_t{row} * geometry_.width;
  corners_.erase(first_at_or_after(row_begin, next_), corners_.end());
  const std::size_t kept = corners_.size();
  std::vector<StampedWord> found;
  frame_.advance(row, found);  // those before are there, also of a frame that was known
  found.clear();
  frame_.rewind(row);
  frame_.advance(geometry_.height, found);
  append(found);
  corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(kept),
                 first_at_or_after(cycle, kept));
  changed_cycle_ = vp::Clock::never;
}

void CornerDetectionTlm::append(const std::vector<StampedWord>& corners) {
  for (const StampedWord& corner : corners)
    corners_.push_back({corner.clock + begin_, corner.word});
}

std::vector<StampedWord>::iterator CornerDetectionTlm::first_at_or_after(std::uint64_t cycle,
                                                                         std::size_t from) {
  return std::lower_bound(corners_.begin() + static_cast<std::ptrdiff_t>(from), corners_.end(),
                          cycle,
                          [](const StampedWord& c, std::uint64_t at) { return c.clock < at; });
}

void CornerDetectionTlm::reset() {
  corners_.clear();
  next_ = 0;
  ena_before_ = false;
  changed_cycle_ = vp::Clock::never;
  corner_out = false;
  wake_at(vp::Clock::never);
}

}  // namespace pl
