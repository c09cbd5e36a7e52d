#pragma once

#include <cstdint>
#include <vector>

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

}  // namespace pl
