#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <pl/blob_labelling/run_labeller.h>
#include <pl/common/bit_row.h>
#include <pl/common/geometry.h>

namespace pl {

/// A component with the clock at which it is shown.
struct StampedExtremes {
  std::uint64_t clock = 0;
  Extremes extremes;
};

/// Dark pixels of runs that got lost since the last reset, from a clock on.
struct StampedLoss {
  std::uint64_t clock = 0;
  std::uint32_t lost = 0;
};

/// Labels that are done with, on their way from RunLabeller's queue to its output.
class LabelQueue {
 public:
  /// `labels`: as RunLabeller has them.
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

/// Blob Labelling over whole frames: what LabellingCore shows, or GroupLabellingCore where more
/// than a pixel comes a clock, at the same clocks.
///
/// Components are sets of runs, joined by a forest; that is another way than the cores', and checks
/// them.
class LabellingFrame {
 public:
  /// `fifo_depth`: as GroupLabellingCore has it.
  LabellingFrame(const Geometry& geometry, std::uint32_t minimum_side, std::uint32_t fifo_depth = 0)
      : geometry_(geometry),
        minimum_side_(minimum_side),
        fifo_depth_(fifo_depth),
        dark_(geometry.width) {}

  /// Appends what is shown of a frame whose first pixel is taken at clock `begin`, one on each
  /// clock. `words`: bit i of word w is pixel 32w + i, 1 is dark. `queue` holds what is left of the
  /// frames before, `losses` what was lost so far.
  void find(const std::uint32_t* words, std::uint64_t begin, LabelQueue& queue,
            std::vector<StampedExtremes>& blobs, std::vector<StampedLoss>& losses);
  /// The frame that was found last: the clock from which on the core is done with it, and the first
  /// one that may take a pixel of the next.
  std::uint64_t done_from() const { return done_from_; }
  std::uint64_t next_from() const { return groups() ? done_from_ + 1 : done_from_ - 1; }

 private:
  using Component = std::uint32_t;
  static constexpr Component none = ~Component{0};  ///< of a run that found no label
  struct Run {
    std::uint32_t first, last;
    Component component;
    std::uint32_t number;  ///< within the frame
  };

  bool groups() const { return geometry_.pixels_per_clock != 1; }
  // One pixel a clock.
  void find_row();
  void label(Run& run, std::size_t& above);
  // More than one.
  void find_row_of_groups();
  void label_in_group(Run& run, std::size_t& above);
  std::uint64_t known_at(std::uint32_t x) const;
  bool queue_up(const Run& run);
  std::uint64_t work();

  void touch(Run& run, bool& labelled, const Run& above, std::uint64_t clock);
  void finish(Run& run, bool labelled, std::uint64_t clock);
  void create(Run& run, std::uint64_t clock);
  void lose(const Run& run, std::uint64_t clock);
  void add_up_losses(std::size_t from);
  void join(Component& mine, Component other, std::uint64_t clock);
  void pass(const Run& run, std::uint64_t clock);
  void leave(std::uint64_t clock, bool shown, const Extremes& extremes);
  Component root(Component component);
  /// The clock of the step that looks at column `x` of the present row.
  std::uint64_t step(std::uint32_t x) const { return row_ + x + 2; }

  const Geometry geometry_;
  const std::uint32_t minimum_side_, fifo_depth_;
  BitRow dark_;
  std::vector<Run> above_, here_;
  // Of components; a joined one has the place of another.
  std::vector<Component> parents_;
  std::vector<std::uint32_t> latest_;  ///< number of the run that belongs to it, in raster order
  std::vector<Extremes> extremes_;

  std::uint32_t y_ = 0;
  std::uint64_t row_ = 0;  ///< the clock that takes the present row's first pixel
  std::uint32_t runs_ = 0;
  std::uint64_t done_from_ = 0;
  // Of groups.
  std::uint64_t worked_ = 0;          ///< the last clock in which something happened to runs
  std::uint64_t known_ = 0;           ///< the clock from which on the next thing may
  std::deque<std::uint64_t> queued_;  ///< clocks in which runs leave the FIFO
  // During a call.
  LabelQueue* queue_ = nullptr;
  std::vector<StampedExtremes>* blobs_ = nullptr;
  std::vector<StampedLoss>* losses_ = nullptr;
};

}  // namespace pl
