#pragma once

#include <ps/cpu/local_time.h>
#include <vp/clock_scheduler.h>
#include <vp/register_route.h>
#include <cstdint>
#include <optional>

namespace ps {

/// The reads of a poll as long as nothing comes in between, numbered from 0: when each leaves the
/// processor and when it reaches the register. Computed for any number, exact to the picosecond.
class PollGrid {
 public:
  /// Read 0 leaves at `start_ps`. Each takes `read_ps`, the loop around it `cycles` at `hertz`;
  /// `time` holds what the processor cut off before.
  PollGrid(const vp::RegisterRoute& route, std::uint64_t start_ps, std::uint64_t read_ps,
           std::uint32_t cycles, const LocalTime& time, std::uint64_t hertz);

  std::uint64_t leaves(std::uint64_t read) const;
  std::uint64_t arrives(std::uint64_t read) const { return route_.arrival_ps(leaves(read)); }
  std::uint64_t ends(std::uint64_t read) const { return leaves(read) + read_ps_; }

  /// One of the reads.
  struct Read {
    std::uint64_t number;
    std::uint64_t arrives_ps;
  };
  /// The first read that arrives at `ps` or later; `last` if none before it does.
  Read first_from(std::uint64_t ps, std::uint64_t last) const;
  /// A read, `last` at most, that leaves before `ps`; not far from the last that does. `ps` >
  /// start.
  std::uint64_t one_before(std::uint64_t ps, std::uint64_t last) const;
  /// The processor's time when read number `read` leaves.
  LocalTime time_at(std::uint64_t read) const;

 private:
  const vp::RegisterRoute& route_;
  std::uint64_t start_ps_;
  std::uint64_t read_ps_;
  std::uint64_t cycles_;
  LocalTime time_;
  double step_ps_;  ///< from read to read
  std::uint64_t first_arrival_ps_;
};

/// Lets the time of a poll pass without making the reads that cannot see anything new.
///
/// It continues until a read has to be made (the first that may return another word, or the last
/// one), and stops where something else happens: an interrupt, a change of a clock, SystemC's turn.
/// The grid tells whether the processor is then between two reads or in one.
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
