#include <pl/blob_detection/label_pool.h>

namespace pl {

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
