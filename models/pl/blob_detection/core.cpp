#include <pl/blob_detection/core.h>

#include <algorithm>
#include <utility>

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

namespace {

/// Clocks from the one in which a blob retires to the one in which it leaves.
constexpr std::uint64_t latency = 1;

}  // namespace

void BlobFrame::Row::clear() {
  if (!used) return;
  std::fill(labels.begin(), labels.end(), Label{0});
  starts.clear();
  used = false;
}

BlobFrame::BlobFrame(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side)
    : geometry_(geometry),
      minimum_side_(minimum_side),
      pool_(labels),
      boxes_(labels),
      widths_(labels),
      above_(geometry.width),
      here_(geometry.width),
      dark_(geometry.width) {}

void BlobFrame::reset() {
  pool_.reset();
  in_frame_ = flushing_ = false;
  clock_ = 0;
  number_ = overflow_ = 0;
}

void BlobFrame::begin() {
  above_.clear();
  here_.clear();
  pool_.rebase(clock_);
  clock_ = 0;
  position_ = y_ = 0;
  number_ = 0;
  in_frame_ = true;
}

void BlobFrame::advance(const std::uint32_t* words, std::uint32_t pixels,
                        std::vector<StampedBlob>& blobs) {
  blobs_ = &blobs;
  const std::uint32_t width = geometry_.width;
  while (position_ < pixels) {
    const std::uint32_t x = position_ - y_ * width;
    if (x == 0 && pixels - position_ >= width && !flushing_) {
      label_row(words + position_ / 32);
    } else {
      label_pixel(words[position_ / 32] >> position_ % 32 & 1, x);
    }
  }
  if (!flushing_ && clock_ > 0) {
    pool_.retire(clock_ - 1, [this](Label label, std::uint64_t clock) { emit(label, clock); });
  }
}

void BlobFrame::rest(std::uint64_t clocks, std::vector<StampedBlob>& blobs) {
  blobs_ = &blobs;
  const std::uint64_t end = clock_ + clocks;
  if (in_frame_ && clock_ < end) {
    pool_.forget_expiries();
    in_frame_ = false;
    flushing_ = true;
    ++clock_;
  }
  for (; flushing_ && clock_ < end; ++clock_) {
    const Label label = pool_.lowest_active();
    if (label == 0) {
      flushing_ = false;
    } else {
      emit(label, clock_);
      pool_.retire_now(label, clock_);
    }
  }
  clock_ = end;
}

void BlobFrame::finish(std::vector<StampedBlob>& blobs) {
  while (in_frame_ || flushing_) rest(1, blobs);
}

void BlobFrame::label_row(const std::uint32_t* words) {
  const std::uint32_t width = geometry_.width;
  dark_.load(words, width / 32);
  for (std::uint32_t first = dark_.next_set(0); first < width;) {
    const std::uint32_t end = std::min(width, dark_.next_clear(first));
    label_run(first, end - 1);
    first = dark_.next_set(end);
  }
  position_ += width;
  clock_ += width;
  end_row();
}

void BlobFrame::label_run(std::uint32_t first, std::uint32_t last) {
  const std::uint32_t seen = std::min(last + 2, geometry_.width - 1);  // of the row above
  std::uint32_t start = first, x = first;
  Label label = widest_neighbour(x);
  if (label == 0) label = start_blob(x);
  for (;;) {
    if (label == 0) {
      // None is free: the next pixel sees one more of the row above, and tries again.
      if (x == last) return;
      start = ++x;
      label = above_[x + 2];
      if (label == 0) label = start_blob(x);
      continue;
    }
    const std::uint32_t rival_start = above_.starts.next_set(x + 3);
    if (rival_start > seen) break;
    x = rival_start - 2;
    grow(label, start, x - 1);
    const Label rival = above_[rival_start];
    if (widths_[rival] > widths_[label]) {
      fill(label, start, x - 1);
      label = rival;
      start = x;
    }
  }
  grow(label, start, last);
  fill(label, start, last);
}

// One clock as the hardware does it; everything looks at the registers as they stood before it.
void BlobFrame::label_pixel(bool dark, std::uint32_t x) {
  const Label flushed = flushing_ ? pool_.lowest_active() : Label{0};
  if (flushed != 0) emit(flushed, clock_);
  flushing_ = flushed != 0;
  if (dark) {
    Label label = widest_neighbour(x);
    if (label == 0) label = start_blob(x);
    if (label != 0) {
      grow(label, x, x);
      here_[x] = label;
      here_.used = true;
      if (x == 0 || here_[x - 1] != label) here_.starts.set(x);
    }
  }
  if (flushed != 0) pool_.retire_now(flushed, clock_);
  ++clock_;
  if (++position_ % geometry_.width == 0) end_row();
}

void BlobFrame::end_row() {
  std::swap(above_, here_);
  here_.clear();
  ++y_;
}

BlobFrame::Label BlobFrame::widest_neighbour(std::uint32_t x) {
  // Left near, left far, above from left to right; the first of the widest wins.
  const Label* here = &here_[x];
  const Label* above = &above_[x];
  Label best = here[-1];
  for (Label label : {here[-2], above[-2], above[-1], above[0], above[1], above[2]}) {
    if (widths_[label] > widths_[best]) best = label;
  }
  return best;
}

BlobFrame::Label BlobFrame::start_blob(std::uint32_t x) {
  const std::uint64_t now = std::uint64_t{y_} * geometry_.width + x;
  const Label label =
      pool_.take(now, [this](Label retired, std::uint64_t clock) { emit(retired, clock); });
  if (label == 0) {
    ++overflow_;
    return 0;
  }
  const auto px = static_cast<std::uint16_t>(x), py = static_cast<std::uint16_t>(y_);
  boxes_[label] = {px, py, px, py};
  grow(label, x, x);
  return label;
}

void BlobFrame::grow(Label label, std::uint32_t first, std::uint32_t last) {
  BoundingBox& box = boxes_[label];
  box.sx = std::min(box.sx, static_cast<std::uint16_t>(first));
  box.ex = std::max(box.ex, static_cast<std::uint16_t>(last));
  box.ey = static_cast<std::uint16_t>(y_);
  widths_[label] = static_cast<std::uint16_t>(box.ex - box.sx + 1);
  if (flushing_) return;
  // No pixel can join from two right of its end in the next row on.
  const std::uint32_t x = std::min(box.ex + 3u, geometry_.width);
  pool_.expires(label, std::uint64_t{y_ + 1} * geometry_.width + x);
}

void BlobFrame::fill(Label label, std::uint32_t first, std::uint32_t last) {
  std::fill(&here_[first], &here_[last] + 1, label);
  here_.starts.set(first);
  here_.used = true;
}

void BlobFrame::emit(Label label, std::uint64_t clock) {
  const BoundingBox& box = boxes_[label];
  if (!box.at_least(minimum_side_)) return;
  const marker_logic::WordFormat words = geometry_.words();
  blobs_->push_back({latency + clock, words.blob_start(number_, box.sx, box.sy),
                     words.blob_end(number_, box.ex, box.ey)});
  ++number_;
}

LabelPool::LabelPool(std::uint32_t labels)
    : labels_(labels), fifo_(labels), active_(labels), expiry_(labels), waiting_(labels) {
  reset();
}

void LabelPool::reset() {
  for (std::uint32_t i = 0; i < labels_; ++i) fifo_[i] = static_cast<Label>(i + 2);
  read_ = 0;
  write_ = count_ = labels_ - 2;  // label 1 is next, 0 is the background
  next_ = 1;
  next_from_ = 0;
  active_.clear();
  forget_expiries();
  retire_from_ = 0;
}

void LabelPool::forget_expiries() {
  std::fill(expiry_.begin(), expiry_.end(), never);
  earliest_ = never;
  waiting_.clear();
  waiting_count_ = 0;
}

void LabelPool::expires(Label label, std::uint64_t at) {
  if (!active_[label]) return;
  expiry_[label] = at;
  earliest_ = std::min(earliest_, at);
}

LabelPool::Label LabelPool::lowest_active() const {
  const std::uint32_t lowest = active_.next_set(0);
  return lowest == active_.capacity() ? Label{0} : static_cast<Label>(lowest);
}

void LabelPool::rebase(std::uint64_t clocks) {
  next_from_ -= std::min(next_from_, clocks);
  retire_from_ = 0;
}

void LabelPool::collect(std::uint64_t last) {
  due_.clear();
  earliest_ = never;
  for (std::uint32_t label = 1; label < labels_; ++label) {
    if (expiry_[label] <= last) {
      due_.push_back({expiry_[label], static_cast<Label>(label)});
      expiry_[label] = never;
    } else {
      earliest_ = std::min(earliest_, expiry_[label]);
    }
  }
  std::sort(due_.begin(), due_.end(),
            [](const Expiry& a, const Expiry& b) { return a.clock < b.clock; });
}

void LabelPool::give_back(Label label, std::uint64_t now) {
  active_.reset(label);
  if (next_ == 0) {
    next_ = label;
    next_from_ = now + 2;  // read ahead in the next clock
    return;
  }
  fifo_[write_] = label;
  write_ = write_ + 1 == labels_ ? 0 : write_ + 1;
  ++count_;
}

LabelPool::Label LabelPool::pop() {
  const Label label = fifo_[read_];
  read_ = read_ + 1 == labels_ ? 0 : read_ + 1;
  --count_;
  return label;
}

}  // namespace pl
