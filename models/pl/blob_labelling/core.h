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

/// The labels that nobody has. The next one is read ahead, so one that comes back may be taken two
/// clocks later.
class FreeLabels {
 public:
  using Label = std::uint16_t;

  /// `labels`: 0, which stands for none, included.
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

/// Finds the connected components (8 neighbours) of a frame's dark pixels in one pass, one pixel a
/// clock: one record for each, whatever its shape.
///
/// What happens, happens to runs of dark pixels, at most one start in two clocks. A run takes the
/// label of the first run above that it touches, joins the components of the others, and asks for a
/// new label if it ends without any. Nothing is renamed afterwards. That needs no table of
/// equivalences, because components cannot cross: seen along a row, they nest like brackets. A run
/// in the row above says only whether its component has another run to its left and to its right;
/// one that has none to its left brings the label, and those that are still open lie on a stack.
/// Each is popped where its last run has passed. If no pixel of the present row has touched the
/// component by then, it is complete: its label waits for its turn to be shown, and is free again.
///
/// A run without a label counts as bright, and its pixels as lost.
class LabellingCore {
 public:
  using Label = FreeLabels::Label;
  /// At most one component is shown in so many clocks.
  static constexpr unsigned clocks_per_blob = 8;

  /// `labels` 4 to 2048, of which 0 means none. Smaller components than `minimum_side` (of both
  /// sides of the bounding box, last - first, px) are not shown.
  LabellingCore(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side);

  /// One clock. Pixels come in raster order, with any number of clocks between them; whole frames,
  /// and at least width + 1 clocks without a pixel after each.
  void clock(bool ena, bool dark, std::uint32_t x, std::uint32_t y);
  void reset();

  /// A component is shown: shown().
  bool shows() const { return shows_; }
  const Extremes& shown() const { return shown_; }
  /// No frame, and all of its components were shown.
  bool idle() const;
  /// Nothing would change in further clocks without a pixel.
  bool quiescent() const { return idle() && free_.settled() && spacing_ == 0; }
  /// A pixel may come: the frame before is over.
  bool ready() const { return flush_ == 0; }
  /// Dark pixels of runs that found no free label since the last reset.
  std::uint32_t overflow() const { return overflow_; }

  // For traces.
  std::size_t free_labels() const { return free_.count(); }
  std::size_t waiting() const { return leaving_.size(); }
  std::size_t open_components() const { return open_.size(); }
  Label label() const { return label_; }

 private:
  struct Pixel {
    bool valid = false, dark = false;
    std::uint32_t x = 0, y = 0;
  };
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

  void capture(bool ena, bool dark, std::uint32_t x, std::uint32_t y);
  Label leave();
  void step();
  void take_above();
  void touch();
  void join();
  void pass();
  bool finish_run();
  void write_run();

  const std::uint32_t width_, height_, minimum_side_;
  FreeLabels free_;
  std::vector<Extremes> extremes_;                  ///< of labels
  std::vector<std::uint32_t> first_, last_;         ///< places of a label's runs in this row
  std::vector<std::uint8_t> line_;                  ///< pixels of the row above
  std::vector<Label> runs_;                         ///< a ring: what is left of the row above, and
  std::vector<std::uint8_t> has_left_, has_right_;  ///< what there is of this row
  std::uint32_t read_ = 0, write_ = 0;

  Pixel pixel_;                             ///< captured
  Pixel decided_;                           ///< captured a clock before, looked at in the next one
  std::uint32_t flush_ = 0;                 ///< clocks of the bright row behind the frame to come
  bool busy_ = false;                       ///< a frame, or the row behind it
  bool dark_ = false, dark_above_ = false;  ///< the pixel before, and above it
  Above above_;
  std::vector<Above> open_;  ///< components of the row above with runs on both sides

  // The run of this row.
  std::uint32_t run_first_ = 0, run_last_ = 0, run_y_ = 0;
  bool run_ended_ = false;
  bool linked_ = false;  ///< its component has a run further left in this row
  Label label_ = 0;      ///< 0: none yet

  Leaving done_;                   ///< comes into the queue next
  std::deque<Leaving> leaving_;    ///< the queue
  std::array<Leaving, 4> stages_;  ///< behind it: address, memory, keys, output
  unsigned spacing_ = 0;
  bool shows_ = false;
  Extremes shown_;
  std::uint32_t overflow_ = 0;
};

}  // namespace pl
