#include <pl/global_threshold/global_threshold.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<GlobalThreshold>& GlobalThreshold::models() {
  static Models<GlobalThreshold> models{
      "global_threshold",
      {model<GlobalThreshold, GlobalThresholdClocked>("clocked", by_pixel, by_pixel),
       model<GlobalThreshold, GlobalThresholdTlm>("tlm", by_frame, by_frame)},
      rtl_model<GlobalThreshold, GlobalThresholdClocked>()};
  return models;
}

void GlobalThreshold::connect(IpPorts& ports) {
  ports.input(por);
  ports.input(rst);
  ports.input(frame_ena);
  ports.input(wr_thresh);
  ports.input(threshold);
  ports.input(pixel, more_pixels);
  ports.input(x, geometry_.words().x_bits());
  ports.input(y, geometry_.words().y_bits());
  ports.output(binary_ena);
  ports.output(binary_out, more_binary, &binary_ena);
  ports.output(binary_x, &binary_ena);
  ports.output(binary_y, &binary_ena);
  ports.output(thresh_out);
  ports.output(thresh_data, &thresh_out);
  ports.report(active_threshold);
  ports.parameter("WIDTH", "pl.width", geometry_.width);
  ports.parameter("HEIGHT", "pl.height", geometry_.height);
  ports.pixels_per_clock(geometry_.pixels_per_clock);
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
  if (frame) {
    take_pixels();
  } else {
    take_found(clock().cycle());
  }
  if (frame_ended) end_frame(clock().cycle());
  const std::uint64_t next = frame ? vp::Clock::never : search_.due();
  if (wr_thresh) core_.set_threshold(threshold);  // wins over the frame's own
  if (!frame || wr_thresh) active_threshold = core_.threshold();
  if (!frame && !frame_before_ && !wr_thresh) {
    sleep();
    wake_at(next);
  }
  frame_before_ = frame;
}

void GlobalThresholdClocked::take_found(std::uint64_t cycle) {
  if (const auto found = search_.take(cycle)) core_.set_threshold(*found);
}

void GlobalThresholdClocked::end_frame(std::uint64_t cycle) {
  if (geometry_.pixels_per_clock == 1) {
    core_.end_frame();
  } else {
    search_.start(cycle + peak_search_clocks, core_.next_threshold());
    core_.clear_histogram();
  }
}

void GlobalThresholdClocked::take_pixels() {
  const std::uint32_t column = x;
  binary_out = take_pixel(pixel);
  for (std::size_t lane = 0; lane < more_pixels.size(); ++lane)
    more_binary[lane] = take_pixel(more_pixels[lane]);
  binary_x = static_cast<std::uint16_t>(column);
  binary_y = y;
  if ((column + geometry_.pixels_per_clock) % 32 == 0) {
    thresh_out = true;
    thresh_data = word_;
  }
}

bool GlobalThresholdClocked::take_pixel(std::uint8_t grey) {
  const bool dark = core_.push(grey);
  word_ = word_ >> 1 | std::uint32_t{dark} << 31;
  return dark;
}

void GlobalThresholdClocked::reset() {
  if (por) core_.set_threshold(ThresholdCore::default_threshold);
  core_.clear_histogram();
  search_.stop();
  active_threshold = core_.threshold();
  binary_ena = false;
  thresh_out = false;
  frame_before_ = false;
  sleep();
}

vp::IpEstimate GlobalThreshold::own_estimate() const {
  const std::uint32_t pixels = geometry_.pixels_per_clock;
  if (pixels > 1) return synthesised_ip("global_threshold", {{"PIXELS_PER_CLOCK", pixels}});
  vp::IpEstimate e = rtl_ip("global_threshold", {{"PIXELS_PER_CLOCK", pixels}});
  e.fmax_documentation = "runs comfortably at 100 MHz (thesis 4.6.1)";
  return e;
}

GlobalThresholdTlm::GlobalThresholdTlm(sc_core::sc_module_name name, const Site& site)
    : GlobalThreshold(name, site), frame_(geometry_) {
  wake_on(threshold);
}

void GlobalThresholdTlm::end_of_elaboration() {
  GlobalThreshold::end_of_elaboration();
  frames.channel().add_listener(*this);
}

void GlobalThresholdTlm::edge() {
  sleep();
  if (por || rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  const bool frame = frame_ena;
  binary_ena = frame;
  if (!frame) take_found(cycle);
  if (frame && !running_) begin(cycle);
  if (!frame && running_) end(cycle);
  std::uint64_t next = running_ ? vp::Clock::never : search_.due();
  if (wr_thresh) load(cycle);
  active_threshold = frame_.threshold();
  if (!binary_frames.taken_whole()) {
    if (emit(cycle)) {
      next = cycle + 1;
    } else if (running_ && next_word_ < binary_frames.size()) {
      next = next_word_leaves();
    }
  }
  wake_at(next);
}

void GlobalThresholdTlm::take_found(std::uint64_t cycle) {
  if (const auto found = search_.take(cycle)) frame_.set_threshold(*found);
}

void GlobalThresholdTlm::end_frame(std::uint64_t cycle) {
  if (geometry_.pixels_per_clock == 1) {
    frame_.end();
  } else {
    search_.start(cycle + peak_search_clocks, frame_.next_threshold());
  }
}

void GlobalThresholdTlm::begin(std::uint64_t cycle) {
  running_ = true;
  first_cycle_ = cycle;
  next_word_ = 0;
  binary_frames.announce();
  frame_.begin(frames->data());
  frame_.advance(geometry_.pixels());
  const std::vector<std::uint32_t>& words = frame_.words();
  binary_frames.begin(words.data(), static_cast<std::uint32_t>(words.size()), cycle,
                      geometry_.pixels_per_clock);
}

void GlobalThresholdTlm::end(std::uint64_t cycle) {
  end_frame(cycle);
  running_ = false;
}

// Wins over the frame's own; counts from the next pixel on.
void GlobalThresholdTlm::load(std::uint64_t cycle) {
  if (frame_.threshold() == threshold) return;
  frame_.set_threshold(threshold);
  if (!running_) return;
  const std::uint64_t next_pixel = (cycle + 1 - first_cycle_) * geometry_.pixels_per_clock;
  if (next_pixel >= geometry_.pixels()) return;
  const auto pixel = static_cast<std::uint32_t>(next_pixel);
  frame_.rewind(pixel);
  frame_.advance(geometry_.pixels());
  binary_frames.change(pixel, geometry_.pixels() - pixel);
}

void GlobalThresholdTlm::pixels_changed(std::uint32_t first, std::uint32_t count) {
  // A pixel of a frame that begins here only in the next clocks is not known yet.
  if (!running_ || binary_frames.leaves_at(first) <= clock().cycle()) return;
  frame_.refresh(first, count);
  binary_frames.change(first, count);
}

// With the last of its pixels.
std::uint64_t GlobalThresholdTlm::next_word_leaves() const {
  return binary_frames.leaves_at(32 * next_word_ + 31);
}

bool GlobalThresholdTlm::emit(std::uint64_t cycle) {
  const bool leaves = running_ && next_word_ < binary_frames.size() && next_word_leaves() == cycle;
  if (leaves) thresh_data = frame_.words()[next_word_++];
  thresh_out = leaves;
  return leaves;
}

void GlobalThresholdTlm::reset() {
  if (por) frame_.set_threshold(ThresholdCore::default_threshold);
  search_.stop();
  active_threshold = frame_.threshold();
  binary_ena = false;
  thresh_out = false;
  binary_frames.cut();
  running_ = false;
  wake_at(vp::Clock::never);
}

}  // namespace pl
