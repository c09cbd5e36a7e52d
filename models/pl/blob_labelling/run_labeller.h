#pragma once

#include <blob_stream.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <pl/common/geometry.h>

namespace pl {

/// The outermost pixels of a set in eight directions, in the order of blob_stream::Extreme.
///
/// Each is one number, of which the least wins: how far out the pixel lies comes first, then what
/// comes first in raster order among pixels equally far out. The union of two sets is eight minima.
class Extremes {
 public:
  Extremes() = default;
  /// Of the pixels `first` to `last` of row `y`; all below 2048.
  Extremes(std::uint32_t first, std::uint32_t last, std::uint32_t y)
      : keys_{key(y, first),          key(far + y - last, y), key(far - last, y),
              key(far - last - y, y), key(far - y, first),    key(far + first - y, y),
              key(first, y),          key(first + y, y)} {}

  void join(const Extremes& other) {
    for (std::size_t i = 0; i < keys_.size(); ++i) keys_[i] = std::min(keys_[i], other.keys_[i]);
  }
  /// As blob_stream::point() has it.
  std::uint32_t point(std::size_t extreme) const;
  /// Both sides of the bounding box are at least `side` (last - first, px).
  bool at_least(std::uint32_t side) const {
    using namespace blob_stream;
    const auto distance = [this](Extreme i) { return keys_[i] >> 16; };
    return far - distance(greatest_x) - distance(least_x) >= side &&
           far - distance(greatest_y) - distance(least_y) >= side;
  }

  bool operator==(const Extremes& other) const { return keys_ == other.keys_; }
  bool operator<(const Extremes& other) const { return keys_ < other.keys_; }

 private:
  static constexpr std::uint32_t far = 4096;  ///< beyond every x + y
  static constexpr std::uint32_t key(std::uint32_t distance, std::uint32_t then) {
    return distance << 16 | then;
  }

  std::array<std::uint32_t, blob_stream::words_per_blob> keys_{};
};

/// The free labels. The next one is read ahead, so a returned label can be taken again two clocks
/// later.
class FreeLabels {
 public:
  using Label = std::uint16_t;

  /// `labels` includes 0, which means no label.
  explicit FreeLabels(std::uint32_t labels) : labels_(labels) { reset(); }
  void reset();
  /// One clock: whether the next label was taken, and the one that comes back (0: none does).
  void clock(bool taken, Label returned);
  /// 0 if none is free.
  Label next() const { return next_; }
  /// The next one included.
  std::size_t count() const { return free_.size() + (next_ != 0); }
  bool settled() const { return next_ != 0 || free_.empty(); }

 private:
  std::uint32_t labels_;
  std::deque<Label> free_;
  Label next_ = 0;
};

/// Labels the connected components (8 neighbours) of a frame's dark pixels in one pass: one record
/// for each, whatever its shape.
///
/// What happens, happens to runs of dark pixels. A run takes the label of the first run above that
/// it touches, joins the components of the others, and asks for a new label if it ends without any.
/// Nothing is renamed afterwards. That needs no table of equivalences, because components cannot
/// cross: seen along a row, they nest like brackets. A run in the row above says only whether its
/// component has another run to its left and to its right; one that has none to its left brings the
/// label, and those that are still open lie on a stack. Each is popped where its last run has
/// passed. If no pixel of the present row has touched the component by then, it is complete: its
/// label waits for its turn to be shown, and is free again.
///
/// A run without a label counts as bright, and its pixels as lost. Derived classes decide in which
/// clock each step happens.
class RunLabeller {
 public:
  using Label = FreeLabels::Label;
  /// At most one component is shown in so many clocks.
  static constexpr unsigned clocks_per_blob = 8;

  virtual ~RunLabeller() = default;

  /// One clock. `ena`: the next pixels of the frame come, as many as Geometry says; bit i of `dark`
  /// is pixel (x + i, y). They come in raster order, with any number of clocks between them, and
  /// frames are whole.
  virtual void clock(bool ena, std::uint32_t dark, std::uint32_t x, std::uint32_t y) = 0;
  virtual void reset();
  /// A frame may begin: the one before is over.
  virtual bool ready() const = 0;

  /// A component is shown: shown().
  bool shows() const { return shows_; }
  const Extremes& shown() const { return shown_; }
  /// No frame, and all of its components were shown.
  bool idle() const;
  /// Nothing would change in further clocks without a pixel.
  bool quiescent() const { return idle() && free_.settled() && spacing_ == 0; }
  /// Dark pixels of runs that got lost since the last reset.
  std::uint32_t overflow() const { return overflow_; }

  // For traces.
  std::size_t free_labels() const { return free_.count(); }
  std::size_t waiting() const { return leaving_.size(); }
  std::size_t open_components() const { return open_.size(); }
  Label label() const { return label_; }

 protected:
  /// Dark pixels from one column to another.
  struct Run {
    std::uint32_t first = 0, last = 0, y = 0;
  };

  /// `labels` 4 to 2048, of which 0 means none. Smaller components than `minimum_side` (of both
  /// sides of the bounding box, last - first, px) are not shown.
  RunLabeller(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side);

  // What may happen in a clock, in this order. leave(): the label that comes back.
  Label leave();
  /// The next run of the row above becomes the present one.
  void take_above();
  /// The present run touches that of the row above.
  void touch();
  /// That of the row above passes.
  void pass();
  /// The present run ends. True if it took a new label.
  bool finish_run(const Run& run);
  void move_free_labels(bool taken, Label returned) { free_.clock(taken, returned); }

  void lose(std::uint32_t pixels) { overflow_ += pixels; }
  /// The place in the ring of the run that take_above() takes next, and of the one that ends next.
  std::uint32_t next_above() const { return read_; }
  std::uint32_t next_here() const { return write_; }

  const Geometry geometry_;
  bool busy_ = false;  ///< a frame, or what follows it
  Label label_ = 0;    ///< of the present run; 0: none yet

 private:
  /// A run of the row above, or what is known of its component.
  struct Above {
    Label label = 0;
    bool seen = false;  ///< a run of this row belongs to it
    bool left = false;  ///< it has a run further left in the row above
    std::uint32_t place = 0;
  };
  /// A label that is done with; `blob`: its component is complete, and not part of another one.
  struct Leaving {
    Label label = 0;
    bool blob = false;
  };

  void join();
  void write_run();
  std::uint32_t behind(std::uint32_t place) const {
    return place + 1 == geometry_.width ? 0 : place + 1;
  }

  const std::uint32_t minimum_side_;
  FreeLabels free_;
  std::vector<Extremes> extremes_;                  ///< of labels
  std::vector<std::uint32_t> first_, last_;         ///< places of a label's runs in this row
  std::vector<Label> runs_;                         ///< a ring: what is left of the row above, and
  std::vector<std::uint8_t> has_left_, has_right_;  ///< what there is of this row
  std::uint32_t read_ = 0, write_ = 0;

  Above above_;
  std::vector<Above> open_;  ///< components of the row above with runs on both sides
  bool linked_ = false;      ///< the present run's component has a run further left in this row

  Leaving done_;                   ///< comes into the queue next
  std::deque<Leaving> leaving_;    ///< the queue
  std::array<Leaving, 4> stages_;  ///< behind it: address, memory, keys, output
  unsigned spacing_ = 0;
  bool shows_ = false;
  Extremes shown_;
  std::uint32_t overflow_ = 0;
};

}  // namespace pl
