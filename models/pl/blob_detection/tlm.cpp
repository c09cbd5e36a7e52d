#include <pl/blob_detection/models.h>

#include <algorithm>

namespace pl {

BlobDetectionTlm::BlobDetectionTlm(sc_core::sc_module_name name, const Site& site)
    : BlobDetection(name, site),
      frame_(geometry_, label_count, minimum_side),
      start_(frame_),
      rest_(frame_) {}

void BlobDetectionTlm::end_of_elaboration() {
  BlobDetection::end_of_elaboration();
  frames.channel().add_listener(*this);
}

void BlobDetectionTlm::edge() {
  sleep();
  if (rst) return reset();
  const std::uint64_t cycle = clock().cycle();
  if (ena && !ena_before_) begin(cycle);
  ena_before_ = ena;
  if (cycle >= changed_cycle_) find_again(cycle);
  emit(cycle);
  idle = cycle >= idle_cycle_;
  if (!ena) label_overflow = frame_.overflow();
  wake_at(next_change(cycle));
}

// The frame is found as a whole: how many labels were missing until now, its begin tells again.
void BlobDetectionTlm::settle() {
  const std::uint64_t cycle = clock().cycle();
  if (!begun_ || cycle < begin_ || cycle >= frame_end()) return;
  BlobFrame until_now = start_;
  std::vector<StampedBlob> ignored;
  until_now.advance(frames->data(), static_cast<std::uint32_t>(cycle + 1 - begin_), ignored);
  label_overflow = until_now.overflow();
}

void BlobDetectionTlm::emit(std::uint64_t cycle) {
  const bool leaves = next_ < blobs_.size() && blobs_[next_].clock == cycle;
  if (leaves) {
    blob_start = blobs_[next_].start;
    blob_end = blobs_[next_].end;
    ++next_;
  }
  blob_out = leaves;
}

std::uint64_t BlobDetectionTlm::next_change(std::uint64_t cycle) const {
  if (blob_out.written()) return cycle + 1;
  const std::uint64_t blob = next_ < blobs_.size() ? blobs_[next_].clock : vp::Clock::never;
  const std::uint64_t idle_from = cycle < idle_cycle_ ? idle_cycle_ : vp::Clock::never;
  return std::min({blob, idle_from, changed_cycle_});
}

void BlobDetectionTlm::begin(std::uint64_t cycle) {
  blobs_.erase(blobs_.begin(), blobs_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  if (begun_) catch_up(cycle);
  begun_ = true;
  begin_ = cycle;
  changed_cycle_ = vp::Clock::never;
  frame_.begin();
  start_ = frame_;
  find();
}

// A frame may begin while labels of the one before still retire: what was foreseen behind this
// clock does not come then.
void BlobDetectionTlm::catch_up(std::uint64_t cycle) {
  blobs_.clear();
  frame_.rest(cycle - frame_end(), blobs_);
  stamp(0);
  forget_before(cycle, 0);
}

void BlobDetectionTlm::find() {
  const std::size_t old = blobs_.size();
  frame_.advance(frames->data(), geometry_.pixels(), blobs_);
  idle_cycle_ = frame_end() + frame_.active_labels() + 1;
  rest_ = frame_;
  rest_.finish(blobs_);
  stamp(old);
}

void BlobDetectionTlm::stamp(std::size_t from) {
  for (std::size_t i = from; i < blobs_.size(); ++i) blobs_[i].clock += begin_;
}

void BlobDetectionTlm::forget_before(std::uint64_t cycle, std::size_t from) {
  const auto first = blobs_.begin() + static_cast<std::ptrdiff_t>(from);
  blobs_.erase(first, std::find_if(first, blobs_.end(), [cycle](const StampedBlob& blob) {
                 return blob.clock >= cycle;
               }));
}

void BlobDetectionTlm::pixels_changed(std::uint32_t first, std::uint32_t) {
  // A pixel of a frame that begins here only in the next clock is not known yet.
  if (!begun_ || begin_ + first <= clock().cycle()) return;
  changed_cycle_ = std::min(changed_cycle_, begin_ + first);
  wake_at(next_change(clock().cycle()));
}

void BlobDetectionTlm::find_again(std::uint64_t cycle) {
  changed_cycle_ = vp::Clock::never;
  blobs_.clear();
  next_ = 0;
  frame_ = start_;
  find();
  forget_before(cycle, 0);
}

void BlobDetectionTlm::reset() {
  frame_.reset();
  blobs_.clear();
  next_ = 0;
  ena_before_ = begun_ = false;
  idle_cycle_ = 0;
  changed_cycle_ = vp::Clock::never;
  blob_out = false;
  idle = true;
  label_overflow = 0;
  wake_at(vp::Clock::never);
}

}  // namespace pl
