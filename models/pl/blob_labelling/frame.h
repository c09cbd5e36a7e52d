#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <pl/blob_labelling/core.h>
#include <pl/common/bit_row.h>
#include <pl/common/geometry.h>

namespace pl {

/// A component with the clock at which it is shown.
struct StampedExtremes {
  std::uint64_t clock = 0;
  Extremes extremes;
};

/// Dark pixels without a label since the last reset, from a clock on.
struct StampedLoss {
  std::uint64_t clock = 0;
  std::uint32_t lost = 0;
};

/// Labels that are done with, on their way from LabellingCore's queue to its output.
class LabelQueue {
 public:
  /// `labels`: as LabellingCore has them.
  explicit LabelQueue(std::uint32_t labels) : usable_(labels - 1) {}

  /// At clock `now`, which never goes back: false if no label is free.
  bool take(std::uint64_t now);
  /// A label is done with at clock `now`. Returns the clock at which it leaves the output; `shown`:
  /// with its component.
  std::uint64_t leave(std::uint64_t now, bool shown);
  /// From this clock on nothing waits.
  std::uint64_t empty_from() const { return empty_from_; }

 private:
  std::uint32_t usable_;
  std::uint32_t taken_ = 0;            ///< those in returns_ included
  std::deque<std::uint64_t> returns_;  ///< clocks at which labels leave
  std::uint64_t next_leave_ = 0;       ///< the first clock at which one may leave
  std::uint64_t next_shown_ = 0;       ///< with its component
  std::uint64_t empty_from_ = 0;
};

/// Blob Labelling over whole frames: what LabellingCore shows, at the same clocks.
///
/// Components are sets of runs, joined by a forest; that is another way than the core's, and checks
/// it.
class LabellingFrame {
 public:
  LabellingFrame(const Geometry& geometry, std::uint32_t minimum_side)
      : geometry_(geometry), minimum_side_(minimum_side), dark_(geometry.width) {}

  /// Appends what is shown of a frame whose first pixel is taken at clock `begin`, one on each
  /// clock. `words`: bit i of word w is pixel 32w + i, 1 is dark. `queue` holds what is left of the
  /// frames before, `losses` what was lost so far.
  void find(const std::uint32_t* words, std::uint64_t begin, LabelQueue& queue,
            std::vector<StampedExtremes>& blobs, std::vector<StampedLoss>& losses);

 private:
  using Component = std::uint32_t;
  struct Run {
    std::uint32_t first, last;
    Component component;
    std::uint32_t number;  ///< within the frame
  };

  void label(Run& run, std::size_t& above);
  void create(Run& run);
  void join(Component& mine, Component other, std::uint64_t clock);
  void pass(const Run& run);
  void leave(std::uint64_t clock, bool shown, const Extremes& extremes);
  Component root(Component component);
  /// The clock of the step that looks at column `x` of the present row.
  std::uint64_t step(std::uint32_t x) const { return row_ + x + 2; }

  const Geometry geometry_;
  const std::uint32_t minimum_side_;
  BitRow dark_;
  std::vector<Run> above_, here_;
  // Of components; a joined one has the place of another.
  std::vector<Component> parents_;
  std::vector<std::uint32_t> latest_;  ///< number of the run that belongs to it, in raster order
  std::vector<Extremes> extremes_;

  std::uint32_t y_ = 0;
  std::uint64_t row_ = 0;  ///< the clock that takes the present row's first pixel
  std::uint32_t runs_ = 0;
  // During a call.
  LabelQueue* queue_ = nullptr;
  std::vector<StampedExtremes>* blobs_ = nullptr;
  std::vector<StampedLoss>* losses_ = nullptr;
};

}  // namespace pl
