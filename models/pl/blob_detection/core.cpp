#include <pl/blob_detection/core.h>

#include <algorithm>

namespace pl {

BlobCore::BlobCore(const Geometry& geometry, std::uint32_t labels)
    : width_(geometry.width),
      labels_(labels),
      active_(labels),
      boxes_(labels),
      line_(geometry.width),
      fifo_(labels) {
  reset();
}

void BlobCore::reset() {
  std::fill(active_.begin(), active_.end(), 0);
  for (std::uint32_t i = 0; i < labels_; ++i) fifo_[i] = static_cast<Label>(i + 2);
  fifo_read_ = 0;
  fifo_write_ = fifo_count_ = labels_ - 2;  // label 1 waits in next_, 0 is the background
  next_ = 1;
  std::fill(std::begin(above_), std::end(above_), 0);
  std::fill(std::begin(left_), std::end(left_), 0);
  ena_before_ = flush_ = false;
  active_count_ = 0;
  highest_ = 0;
  earliest_ = 0;
  overflow_ = 0;
}

bool BlobCore::step(bool ena, bool dark, std::uint32_t x, std::uint32_t y) {
  // Everything looks at the registers as they stood before this clock; the label that retires is
  // found first.
  const Label expired = find_expired(ena, x, y);
  if (expired != 0) {
    retired_ = boxes_[expired];
    retired_label_ = expired;
  }
  bool is_new = false;
  if (ena) {
    Label label = 0;
    if (dark) {
      label = widest_neighbour(x, y);
      is_new = label == 0;
      if (is_new) {
        label = next_;
        if (label == 0) ++overflow_;
      }
      if (label != 0) grow(label, is_new, x, y);
    }
    shift_window(label, x);
  }
  prefetch(is_new);
  if (expired != 0) give_back(expired);
  if (ena_before_ && !ena) {
    flush_ = true;
  } else if (flush_ && expired == 0) {
    flush_ = false;
  }
  ena_before_ = ena;
  return expired != 0;
}

BlobCore::Label BlobCore::find_expired(bool ena, std::uint32_t x, std::uint32_t y) {
  if (active_count_ == 0 || !(flush_ || (ena && raster(x, y) >= earliest_))) return 0;
  const std::uint32_t here = raster(x, y);
  std::uint32_t earliest = ~0u;
  for (std::uint32_t label = 1; label <= highest_; ++label) {
    if (!active_[label]) continue;
    const std::uint32_t end = expiry(boxes_[label]);
    if (flush_ || end <= here) return static_cast<Label>(label);
    earliest = std::min(earliest, end);
  }
  earliest_ = earliest;  // boxes only grow, so labels expire later, never earlier
  return 0;
}

BlobCore::Label BlobCore::widest_neighbour(std::uint32_t x, std::uint32_t y) const {
  Label best = 0;
  std::uint32_t widest = 0;
  auto consider = [&](Label label) {
    if (label == 0) return;
    const std::uint32_t width = boxes_[label].ex - boxes_[label].sx + 1u;
    if (width > widest) {
      widest = width;
      best = label;
    }
  };
  if (x >= 1) consider(left_[0]);
  if (x >= 2) consider(left_[1]);
  if (y == 0) return best;
  if (x >= 2) consider(above_[0]);
  if (x >= 1) consider(above_[1]);
  consider(above_[2]);
  if (x + 1 < width_) consider(above_[3]);
  if (x + 2 < width_) consider(above_[4]);
  return best;
}

void BlobCore::grow(Label label, bool is_new, std::uint32_t x, std::uint32_t y) {
  BoundingBox& box = boxes_[label];
  const auto px = static_cast<std::uint16_t>(x), py = static_cast<std::uint16_t>(y);
  if (is_new) {
    box = {px, py, px, py};
    if (!active_[label]) {
      active_[label] = 1;
      if (active_count_++ == 0) earliest_ = ~0u;
    }
    highest_ = std::max(highest_, label);
    earliest_ = std::min(earliest_, expiry(box));
  } else {
    box.sx = std::min(box.sx, px);
    box.ex = std::max(box.ex, px);
    box.ey = py;
  }
}

void BlobCore::shift_window(Label label, std::uint32_t x) {
  const std::uint32_t ahead = x + 3 < width_ ? x + 3 : x + 3 - width_;
  above_[0] = above_[1];
  above_[1] = above_[2];
  above_[2] = above_[3];
  above_[3] = above_[4];
  above_[4] = line_[ahead];
  line_[x] = label;
  left_[1] = left_[0];
  left_[0] = label;
}

// The next label is read ahead. An empty FIFO leaves 0, and is looked at again in every clock.
void BlobCore::prefetch(bool taken) {
  if (!taken && next_ != 0) return;
  if (fifo_count_ == 0) {
    next_ = 0;
    return;
  }
  next_ = fifo_[fifo_read_];
  fifo_read_ = fifo_read_ + 1 == labels_ ? 0 : fifo_read_ + 1;
  --fifo_count_;
}

void BlobCore::give_back(Label label) {
  active_[label] = 0;
  --active_count_;
  fifo_[fifo_write_] = label;
  fifo_write_ = fifo_write_ + 1 == labels_ ? 0 : fifo_write_ + 1;
  ++fifo_count_;
  while (highest_ > 0 && !active_[highest_]) --highest_;
}

}  // namespace pl
