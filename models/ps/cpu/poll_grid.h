#pragma once

#include <ps/cpu/local_time.h>
#include <vp/register_route.h>
#include <cstdint>

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

}  // namespace ps
