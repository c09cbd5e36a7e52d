#pragma once

#include <marker/feature_set.h>

#include <array>
#include <cstdint>

namespace marker {

/// Most labels a blob grouping may have, the background's 0 included.
inline constexpr std::uint32_t max_labels = 1024;

/// Labels, their boxes, and when they come back: a label is free again when no pixel can join its
/// blob any more. The PL looks for one such label a clock (thesis 4.3.6); here they are found in
/// arrears, in the same order, so that blobs come and labels are used again exactly as there.
/// Times are raster indices of pixels.
class LabelPool {
 public:
  /// All labels free. `labels` 4 to max_labels.
  void reset(std::uint32_t labels, std::uint32_t width);

  /// A label for the blob that starts at raster index `now`; 0 if none is free. Blobs that ended
  /// before are handed to `ended`, in order.
  template <class Ended>
  std::uint32_t take(std::uint32_t now, Ended ended);

  /// Hands over the blobs that ended up to raster index `last`, which was labelled.
  template <class Ended>
  void retire(std::uint32_t last, Ended ended);

  /// The frame is over: hands over the others, lowest label first.
  template <class Ended>
  void flush(Ended ended);

  BoundingBox& box(std::uint32_t label) { return boxes_[label]; }
  /// Columns of the blob; 0 for the background.
  std::uint32_t columns(std::uint32_t label) const {
    return label == 0 ? 0 : static_cast<std::uint32_t>(boxes_[label].ex - boxes_[label].sx + 1);
  }
  /// Labels looked at by retire().
  std::uint32_t checks() const { return checks_; }

 private:
  struct Expiry {
    std::uint32_t time;
    std::uint16_t label;
  };

  std::uint32_t expiry(const BoundingBox& box) const;
  std::uint32_t collect(std::uint32_t last);
  void give_back(std::uint32_t label, std::uint32_t now);
  std::uint32_t pop();

  std::uint32_t labels_ = 0, width_ = 0;
  std::array<std::uint16_t, max_labels> fifo_{};
  std::uint32_t read_ = 0, write_ = 0, count_ = 0;
  std::uint32_t next_ = 0;       ///< read ahead; 0: none was free
  std::uint32_t next_from_ = 0;  ///< the first pixel that may take it
  std::uint32_t highest_ = 0;    ///< no active label lies above
  std::uint32_t retire_from_ = 0;
  std::uint32_t checks_ = 0;
  std::array<bool, max_labels> active_{};
  std::array<bool, max_labels> waiting_{};  ///< ended, but one a pixel is handed over
  std::array<BoundingBox, max_labels> boxes_{};
  std::array<Expiry, max_labels> due_{};
};

template <class Ended>
std::uint32_t LabelPool::take(std::uint32_t now, Ended ended) {
  if (next_ == 0 && now > 0) retire(now - 1, ended);
  if (next_ == 0 || now < next_from_) return 0;
  const std::uint32_t label = next_;
  next_ = count_ == 0 ? 0 : pop();
  active_[label] = true;
  if (label > highest_) highest_ = label;
  return label;
}

template <class Ended>
void LabelPool::retire(std::uint32_t last, Ended ended) {
  const std::uint32_t count = collect(last);
  if (count == 0) return;
  std::uint32_t now = retire_from_, waiting = 0;
  for (std::uint32_t i = 0; waiting != 0 || i < count; ++now) {
    if (waiting == 0 && now < due_[i].time) now = due_[i].time;
    for (; i < count && due_[i].time <= now; ++i, ++waiting) waiting_[due_[i].label] = true;
    if (now > last) break;
    std::uint32_t label = 1;
    while (!waiting_[label]) ++label;
    waiting_[label] = false;
    --waiting;
    ended(boxes_[label]);
    give_back(label, now);
  }
  for (std::uint32_t i = 0; i < count; ++i) waiting_[due_[i].label] = false;
  retire_from_ = now;
}

template <class Ended>
void LabelPool::flush(Ended ended) {
  for (std::uint32_t label = 1; label <= highest_; ++label) {
    if (active_[label]) ended(boxes_[label]);
    active_[label] = false;
  }
  highest_ = 0;
}

}  // namespace marker
