#pragma once

#include <ps/cpu/poll_grid.h>
#include <vp/clock_scheduler.h>
#include <vp/register_route.h>
#include <cstdint>
#include <optional>

namespace ps {

/// Lets the time of a poll pass without making the reads that cannot see anything new.
///
/// It goes on until a read has to be made: the first that may return another word, or the last one;
/// and stops where something else happens: an interrupt, a change of a clock, SystemC's turn. What
/// the processor is at then, between two reads or in one, follows from the grid.
class PollSkip {
 public:
  /// `last`: the read that is made whatever happens. `interrupt`: what stops it besides; may be
  /// null.
  PollSkip(const vp::RegisterRoute& route, const PollGrid& grid, std::uint64_t last,
           vp::ClockScheduler& scheduler, vp::ClockScheduler::Condition interrupt,
           const void* context)
      : route_(route),
        grid_(grid),
        goal_(last),
        scheduler_(scheduler),
        interrupt_(interrupt),
        context_(context) {}

  void run();
  /// A clock is about to change its frequency, now: what comes is not on the grid.
  void clock_changes();

  /// Reads that reached the register before the present time; all returned what it held.
  std::uint64_t done() const { return done_; }
  /// The read that has left and not reached it; nothing while the processor is between two.
  const std::optional<vp::RegisterRoute::Access>& on_its_way() const { return on_its_way_; }

 private:
  static bool stop(const void* skip);
  void plan();
  void take_stock();

  const vp::RegisterRoute& route_;
  const PollGrid& grid_;
  std::uint64_t goal_;
  vp::ClockScheduler& scheduler_;
  vp::ClockScheduler::Condition interrupt_;
  const void* context_;
  std::uint64_t goal_ps_ = 0;
  std::uint64_t stable_until_ps_ = 0;  ///< when it was planned
  bool off_grid_ = false;              ///< a clock has changed
  std::uint64_t done_ = 0;
  std::optional<vp::RegisterRoute::Access> on_its_way_;
};

}  // namespace ps
