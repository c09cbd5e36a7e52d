#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_detection/bit_row.h>
#include <pl/blob_detection/core.h>
#include <pl/blob_detection/label_pool.h>
#include <pl/common/geometry.h>
#include <pl/common/stamped_word.h>

namespace pl {

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
