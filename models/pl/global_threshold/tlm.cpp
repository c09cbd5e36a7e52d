#include <pl/global_threshold/models.h>

namespace pl {

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
  if (frame && !running_) begin(cycle);
  if (!frame && running_) end();
  if (wr_thresh) load(cycle);
  active_threshold = frame_.threshold();
  if (binary_frames.taken_whole()) return;
  if (emit(cycle)) {
    wake_at(cycle + 1);
  } else if (running_ && next_word_ < binary_frames.size()) {
    wake_at(next_word_leaves());
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
  binary_frames.begin(words.data(), static_cast<std::uint32_t>(words.size()), cycle);
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
  binary_frames.change(pixel, geometry_.pixels() - pixel);
}

void GlobalThresholdTlm::pixels_changed(std::uint32_t first, std::uint32_t count) {
  // A pixel of a frame that begins here only in the next clocks is not known yet.
  if (!running_ || first_cycle_ + first <= clock().cycle()) return;
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
  active_threshold = frame_.threshold();
  binary_ena = false;
  thresh_out = false;
  binary_frames.cut();
  running_ = false;
  wake_at(vp::Clock::never);
}

}  // namespace pl
