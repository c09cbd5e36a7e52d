#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <pl/blob_labelling/run_labeller.h>

namespace pl {

/// Several pixels a clock. Ends of runs, of which a clock may bring more than one, go into a FIFO;
/// behind it happens one thing a clock, as the runs of two rows lie beside each other:
///
/// - the run above passes, where it ends before the present one touches it;
/// - it is touched, and passes if it ends no later than the present run does;
/// - the present run ends, touching the run above if that continues;
/// - after the last run of both, the row is over.
///
/// So a row takes a clock for each of its runs, for each of the row above, and one more. Where
/// more come for longer than the FIFO lasts, as in noise, runs that find no room are lost: they are
/// counted, and bright.
///
/// A frame may begin when this is done with the one before.
class GroupLabellingCore final : public RunLabeller {
 public:
  /// Clocks from the one that takes a run's end until it comes into the FIFO. The ends are found in
  /// one, and after the next the FIFO may hold them; what happens to a run is decided a clock
  /// before it does.
  static constexpr unsigned clocks_to_fifo = 3;

  /// `fifo_depth`: runs.
  GroupLabellingCore(const Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side,
                     std::uint32_t fifo_depth);

  void clock(bool ena, std::uint32_t dark, std::uint32_t x, std::uint32_t y) override;
  void reset() override;
  bool ready() const override { return !busy_; }

 private:
  /// Pixels of a clock.
  struct Group {
    bool valid = false;
    std::uint32_t dark = 0, x = 0, y = 0;
  };

  bool work();
  bool end_row();
  void find_runs(const Group& group, std::size_t room);
  void end_run(std::uint32_t last, std::uint32_t y, std::size_t& room);

  const std::uint32_t fifo_depth_;
  std::vector<Run> places_;  ///< of the ring's runs
  std::deque<Run> fifo_;

  std::array<Group, clocks_to_fifo> groups_;  ///< captured, the newest one first
  std::uint32_t run_first_ = 0;               ///< of the run that has begun
  bool dark_ = false;       ///< the pixel before the group is dark: a run has begun
  std::uint32_t rows_ = 0;  ///< of the frame, whose runs all are in the FIFO or beyond it

  std::uint32_t row_ = 0;  ///< that is worked on
  std::uint32_t above_ = 0,
                here_ = 0;  ///< runs of the row above that are to be taken, and of this one
  bool taken_ = false;      ///< one of the row above is
  Run above_run_;           ///< that one
};

}  // namespace pl
