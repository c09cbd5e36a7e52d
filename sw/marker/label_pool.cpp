#include <marker/label_pool.h>

namespace marker {

void LabelPool::reset(std::uint32_t labels, std::uint32_t width) {
  labels_ = labels;
  width_ = width;
  for (std::uint32_t i = 0; i < labels; ++i) {
    fifo_[i] = static_cast<std::uint16_t>(i + 2);
    active_[i] = false;
  }
  read_ = 0;
  write_ = count_ = labels - 2;  // label 1 is next, 0 is the background
  next_ = 1;
  next_from_ = highest_ = retire_from_ = checks_ = 0;
}

/// The first pixel that cannot join any more: two right of the end, in the row below.
std::uint32_t LabelPool::expiry(const BoundingBox& box) const {
  const std::uint32_t x = box.ex + 3u < width_ ? box.ex + 3u : width_;
  return (box.ey + 1u) * width_ + x;
}

/// Active labels that ended up to `last`, in the order of their ends.
std::uint32_t LabelPool::collect(std::uint32_t last) {
  std::uint32_t count = 0;
  checks_ += highest_;
  for (std::uint32_t label = 1; label <= highest_; ++label) {
    if (!active_[label]) continue;
    const std::uint32_t time = expiry(boxes_[label]);
    if (time > last) continue;
    std::uint32_t place = count++;
    for (; place > 0 && due_[place - 1].time > time; --place) due_[place] = due_[place - 1];
    due_[place] = {time, static_cast<std::uint16_t>(label)};
  }
  return count;
}

void LabelPool::give_back(std::uint32_t label, std::uint32_t now) {
  active_[label] = false;
  while (highest_ > 0 && !active_[highest_]) --highest_;
  if (next_ == 0) {
    next_ = label;
    next_from_ = now + 2;  // read ahead in the next clock
    return;
  }
  fifo_[write_] = static_cast<std::uint16_t>(label);
  write_ = write_ + 1 == labels_ ? 0 : write_ + 1;
  ++count_;
}

std::uint32_t LabelPool::pop() {
  const std::uint32_t label = fifo_[read_];
  read_ = read_ + 1 == labels_ ? 0 : read_ + 1;
  --count_;
  return label;
}

}  // namespace marker
