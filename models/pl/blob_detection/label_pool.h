#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_detection/bit_row.h>

namespace pl {

/// The labels of BlobCore over stretches of clocks: which are free, in which order, and when those
/// of finished blobs come back.
///
/// A finished blob can not grow any more, so it does not matter when it is looked for: labels
/// expire at a known clock, and are retired in arrears, but each at its own clock. That has to be
/// done only where the next label depends on it, that is when none is waiting, and before results
/// are read. Clocks count from the frame's first pixel, which is clock 0.
class LabelPool {
 public:
  using Label = std::uint16_t;

  /// `labels` 4 to 1024, the background's 0 included.
  explicit LabelPool(std::uint32_t labels);

  void reset();

  /// A new blob at clock `now`: the next free label, active from now on and never to expire unless
  /// told; 0 if there is none. `retired(label, clock)` is called as by retire().
  template <class Retired>
  Label take(std::uint64_t now, Retired retired);

  /// The label expires at clock `at` or later, when it is its turn. Nothing happens if it is not
  /// active.
  void expires(Label label, std::uint64_t at);

  /// Retires what expired: calls `retired(label, clock)` in the order of the clocks, up to and
  /// including `last`. Everything before `last` must have been labelled.
  template <class Retired>
  void retire(std::uint64_t last, Retired retired);

  /// No active label expires any more: the end of a frame flushes them all.
  void forget_expiries();
  /// Retires an active label at clock `now`, whether it expired or not.
  void retire_now(Label label, std::uint64_t now) { give_back(label, now); }
  /// The active label of the lowest index, 0 if there is none.
  Label lowest_active() const;
  std::uint32_t active() const { return active_.count(); }

  /// Clocks count from `clocks` later on: a new frame. No active label may have an expiry.
  void rebase(std::uint64_t clocks);

 private:
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  struct Expiry {
    std::uint64_t clock;
    Label label;
  };

  /// Moves labels that expire up to `last` into due_, in the order of their clocks.
  void collect(std::uint64_t last);
  void give_back(Label label, std::uint64_t now);
  Label pop();

  std::uint32_t labels_;
  std::vector<Label> fifo_;
  std::uint32_t read_ = 0, write_ = 0, count_ = 0;
  Label next_ = 1;               ///< the next label, read ahead; 0 if none was free
  std::uint64_t next_from_ = 0;  ///< the first clock at which next_ may be taken
  BitRow active_;
  std::vector<std::uint64_t> expiry_;  ///< of active labels; never for others and for waiting ones
  std::uint64_t earliest_ = never;     ///< nothing in expiry_ lies before
  BitRow waiting_;                     ///< expired, but one a clock is retired
  std::uint32_t waiting_count_ = 0;
  std::uint64_t retire_from_ = 0;  ///< the first clock at which nothing was retired yet
  std::vector<Expiry> due_;
};

template <class Retired>
LabelPool::Label LabelPool::take(std::uint64_t now, Retired retired) {
  if (next_ == 0 && now > 0) retire(now - 1, retired);
  if (next_ == 0 || now < next_from_) return 0;
  const Label label = next_;
  next_ = count_ == 0 ? Label{0} : pop();
  active_.set(label);
  return label;
}

template <class Retired>
void LabelPool::retire(std::uint64_t last, Retired retired) {
  if (waiting_count_ == 0 && last < earliest_) return;
  collect(last);
  std::uint64_t now = retire_from_;
  for (std::size_t i = 0; waiting_count_ != 0 || i < due_.size(); ++now) {
    if (waiting_count_ == 0 && now < due_[i].clock) now = due_[i].clock;
    for (; i < due_.size() && due_[i].clock <= now; ++i, ++waiting_count_) {
      waiting_.set(due_[i].label);
    }
    if (now > last) break;
    const auto label = static_cast<Label>(waiting_.next_set(0));
    retired(label, now);
    waiting_.reset(label);
    --waiting_count_;
    give_back(label, now);
  }
  retire_from_ = now;
}

}  // namespace pl
