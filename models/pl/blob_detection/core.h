#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pl/common/bit_row.h>
#include <pl/common/geometry.h>

namespace pl {

/// Limits of a blob in pixels, both ends included.
struct BoundingBox {
  std::uint16_t sx = 0, sy = 0, ex = 0, ey = 0;

  /// Large enough for a marker: both sides at least `side` (Ex − Sx and Ey − Sy, thesis 4.3.6.4).
  bool at_least(std::uint32_t side) const {
    return static_cast<std::uint32_t>(ex - sx) >= side &&
           static_cast<std::uint32_t>(ey - sy) >= side;
  }
};

/// Labels dark pixels as they come, grows a box for each label and retires labels that no pixel can
/// join any more (thesis 4.3.6). Labels are never merged: the widest neighbouring blob wins.
class BlobCore {
 public:
  using Label = std::uint16_t;

  /// `labels` 4 to 1024, the background's 0 included.
  BlobCore(const Geometry& geometry, std::uint32_t labels);

  /// One clock. `ena` false between frames. True if a label retired in this clock: its box is
  /// retired().
  bool step(bool ena, bool dark, std::uint32_t x, std::uint32_t y);

  const BoundingBox& retired() const { return retired_; }
  Label retired_label() const { return retired_label_; }
  /// The label that step() gave the pixel, 0 for a bright one.
  Label label() const { return left_[0]; }
  /// The label that the next new blob will take; 0 if none was free.
  Label next_label() const { return next_; }
  std::uint32_t free_labels() const { return fifo_count_; }
  bool active(Label label) const { return active_[label]; }
  const BoundingBox& box(Label label) const { return boxes_[label]; }
  /// The frame is over and labels that are still active retire, one a clock.
  bool flushing() const { return flush_; }
  /// Nothing would change in further clocks with ena low.
  bool quiescent() const { return !flush_ && !ena_before_ && !(next_ == 0 && fifo_count_ != 0); }
  /// Dark pixels that found no free label since the last reset.
  std::uint32_t overflow() const { return overflow_; }

  void reset();

 private:
  std::uint32_t raster(std::uint32_t x, std::uint32_t y) const { return y * 4096 + x; }
  /// The first position at which no pixel can join the box: two right of its end in the row below
  /// it.
  std::uint32_t expiry(const BoundingBox& box) const { return raster(box.ex + 3u, box.ey + 1u); }
  Label widest_neighbour(std::uint32_t x, std::uint32_t y) const;
  Label find_expired(bool ena, std::uint32_t x, std::uint32_t y);
  void grow(Label label, bool is_new, std::uint32_t x, std::uint32_t y);
  void shift_window(Label label, std::uint32_t x);
  void prefetch(bool taken);
  void give_back(Label label);

  std::uint32_t width_;
  std::uint32_t labels_;
  std::vector<std::uint8_t> active_;
  std::vector<BoundingBox> boxes_;
  std::vector<Label> line_;  ///< labels of the last line
  Label above_[5] = {};      ///< row above: x − 2 … x + 2
  Label left_[2] = {};       ///< x − 1, x − 2
  std::vector<Label> fifo_;
  std::uint32_t fifo_read_ = 0, fifo_write_ = 0, fifo_count_ = 0;
  Label next_ = 1;
  bool ena_before_ = false;
  bool flush_ = false;
  std::uint32_t active_count_ = 0;
  Label highest_ = 0;           ///< no active label lies above
  std::uint32_t earliest_ = 0;  ///< no active label expires before this position
  BoundingBox retired_;
  Label retired_label_ = 0;
  std::uint32_t overflow_ = 0;
};

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

  /// A new blob at clock `now`: returns the next free label, active from now on and without an
  /// expiry, or 0. `retired(label, clock)` is called as by retire().
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
  /// The active label of the lowest index, or 0.
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

/// Blob Detection over whole rows: the packets of BlobDetectionClocked at the same clocks.
///
/// Inside a run of dark pixels a pixel takes the label of its left neighbour, which was the widest
/// and only grew since, unless a wider blob enters the window at its right end. So labels are
/// decided at the start of a run and where a label of the row above starts.
///
/// Works in bands that may end at any pixel. What is to be tried and taken back is tried on a copy:
/// copies are cheap.
class BlobFrame {
 public:
  using Label = LabelPool::Label;

  /// `labels` 4 to 1024, the background's included. Smaller boxes than `minimum_side` (Ex - Sx and
  /// Ey - Sy, px) are not reported.
  BlobFrame(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side);

  /// A new frame; clocks count from its `ena` from now on. At least one clock of rest() comes
  /// between two frames.
  void begin();
  /// Labels up to the pixel of raster index `pixels` - 1, and appends the blobs that retire
  /// meanwhile in the order of their clocks. `words` is the frame's binary image: bit i of word w
  /// is pixel 32w + i, 1 is dark.
  void advance(const std::uint32_t* words, std::uint32_t pixels, std::vector<StampedBlob>& blobs);
  /// `clocks` clocks without frame: the first one ends it, then one label retires per clock.
  void rest(std::uint64_t clocks, std::vector<StampedBlob>& blobs);
  /// rest() until all labels are retired.
  void finish(std::vector<StampedBlob>& blobs);
  /// What `rst` does.
  void reset();

  std::uint32_t pixels() const { return position_; }
  /// Labels in use; after a frame's last pixel, as many as the end of the frame flushes.
  std::uint32_t active_labels() const { return pool_.active(); }
  /// The frame is over and labels still retire.
  bool flushing() const { return flushing_; }
  /// Dark pixels that found no free label since the last reset.
  std::uint32_t overflow() const { return overflow_; }

 private:
  /// Labels of one row, with room for the window left and right of it.
  struct Row {
    explicit Row(std::uint32_t width) : labels(width + 2 * margin), starts(width) {}
    Label& operator[](std::uint32_t x) { return labels[x + margin]; }
    void clear();

    static constexpr std::uint32_t margin = 2;
    std::vector<Label> labels;
    BitRow starts;  ///< labelled pixels whose left neighbour has another label
    bool used = false;
  };

  void label_row(const std::uint32_t* words);
  void label_run(std::uint32_t first, std::uint32_t last);
  void label_pixel(bool dark, std::uint32_t x);
  void end_row();
  Label widest_neighbour(std::uint32_t x);
  Label start_blob(std::uint32_t x);
  /// Pixels `first` to `last` of the present row join the blob.
  void grow(Label label, std::uint32_t first, std::uint32_t last);
  void fill(Label label, std::uint32_t first, std::uint32_t last);
  void emit(Label label, std::uint64_t clock);

  Geometry geometry_;
  std::uint32_t minimum_side_;
  LabelPool pool_;
  std::vector<BoundingBox> boxes_;
  std::vector<std::uint16_t> widths_;  ///< Ex - Sx + 1 of the boxes; 0 for the background
  Row above_, here_;
  BitRow dark_;
  std::uint32_t position_ = 0;  ///< the next pixel
  std::uint32_t y_ = 0;         ///< its row
  std::uint64_t clock_ = 0;     ///< the next clock; 0 takes the frame's first pixel
  bool in_frame_ = false;
  bool flushing_ = false;
  std::uint32_t number_ = 0;
  std::uint32_t overflow_ = 0;
  std::vector<StampedBlob>* blobs_ = nullptr;  ///< where results go during a call
};

}  // namespace pl
