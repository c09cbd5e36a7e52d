#include <pl/global_threshold/tlm.h>

namespace pl {

GlobalThresholdTlm::GlobalThresholdTlm(sc_core::sc_module_name name, vp::Clock& clk,
                                       const Geometry& geometry, FrameChannel& view)
    : GlobalThreshold(name, clk, geometry), view_(view), frame_(geometry) {
  wake_on(threshold);
  view_.add_listener(*this);
}

void GlobalThresholdTlm::edge() {
  sleep();
  if (por || rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  const bool frame = frame_ena;
  binary_ena = frame;
  if (frame && !running_) begin(cycle);
  if (!frame && running_) end();
  if (wr_thresh) load(cycle);
  active_threshold = frame_.threshold();
  const bool leaves = show_words_ && emit(cycle);
  if (leaves) {
    wake_at(cycle + 1);
  } else if (running_ && show_words_ && next_word_ < binary.size()) {
    wake_at(binary.leaves_at(next_word_));
  }
}

void GlobalThresholdTlm::begin(std::uint64_t cycle) {
  running_ = true;
  first_cycle_ = cycle;
  next_word_ = 0;
  binary.prepare();
  frame_.begin(view_.pixels());
  frame_.advance(geometry_.pixels());
  binary.begin(frame_.words(), cycle);
}

void GlobalThresholdTlm::end() {
  frame_.end();
  running_ = false;
}

// Wins over the frame's own; counts from the next pixel on.
void GlobalThresholdTlm::load(std::uint64_t cycle) {
  if (frame_.threshold() == threshold) return;
  frame_.set_threshold(threshold);
  if (!running_) return;
  const std::uint64_t next_pixel = cycle + 1 - first_cycle_;
  if (next_pixel >= geometry_.pixels()) return;
  const auto pixel = static_cast<std::uint32_t>(next_pixel);
  frame_.rewind(pixel);
  frame_.advance(geometry_.pixels());
  binary.change(pixel);
}

void GlobalThresholdTlm::pixels_changed(std::uint32_t first, std::uint32_t count) {
  // A pixel of a frame that begins here only in the next clocks is not known yet.
  if (!running_ || first_cycle_ + first <= clock().cycle()) return;
  frame_.refresh(first, count);
  binary.change(first);
}

bool GlobalThresholdTlm::emit(std::uint64_t cycle) {
  const bool leaves =
      running_ && next_word_ < binary.size() && binary.leaves_at(next_word_) == cycle;
  if (leaves) thresh_data = frame_.words()[next_word_++];
  thresh_out = leaves;
  return leaves;
}

void GlobalThresholdTlm::reset() {
  if (por) frame_.set_threshold(ThresholdCore::default_threshold);
  active_threshold = frame_.threshold();
  binary_ena = false;
  thresh_out = false;
  binary.cut();
  running_ = false;
  wake_at(vp::Clock::never);
}

}  // namespace pl
