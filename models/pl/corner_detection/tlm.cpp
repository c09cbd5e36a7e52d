#include <pl/corner_detection/models.h>

#include <algorithm>

namespace pl {

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
  append_corners();
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
  frame_.rewind(row);
  append_corners();
  corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(kept),
                 first_at_or_after(cycle, kept));
  changed_cycle_ = vp::Clock::never;
}

void CornerDetectionTlm::append_corners() {
  const std::size_t old = corners_.size();
  frame_.advance(geometry_.height, corners_);
  for (std::size_t i = old; i < corners_.size(); ++i) corners_[i].clock += begin_;
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
