#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vp {

/// When the edges of a clock fall: edge n at round(n · 10¹² / f) ps after the clock's last change.
///
/// Invariant: the anchor is an edge since that change, its time exact down to what was cut off.
/// Edges up to `reach_cycles` or `reach_ps_` behind it follow in 64 bits; a question about any
/// other moves the anchor, which takes divisions of 128 bits.
class EdgeTimes {
 public:
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  static constexpr std::uint64_t ps_per_second = 1'000'000'000'000;

  /// An edge and what was cut off its time, in 1 / f ps.
  struct Edge {
    std::uint64_t cycle;
    std::uint64_t ps;
    std::uint64_t remainder;
  };

  /// `cycles` edges have been; the next one comes one period after `ps`. 0 Hz: the clock stands.
  void restart(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz);

  std::uint64_t hertz() const { return hertz_; }
  bool stands() const { return hertz_ == 0; }

  /// Edge number `cycle`, since the last change of a clock that runs.
  Edge edge(std::uint64_t cycle) const;
  /// The edge after `edge`, without a division.
  Edge after(Edge edge) const;
  /// Time of the first edge at or after `ps`; never if the clock stands.
  std::uint64_t edge_at_or_after(std::uint64_t ps) const;
  /// Its number.
  std::uint64_t cycle_at_or_after(std::uint64_t ps) const;
  /// How many edges there were until `ps`, one at `ps` included.
  std::uint64_t cycles_until(std::uint64_t ps) const {
    return stands() || ps < origin_.ps ? origin_.cycle : cycle_at_or_after(ps + 1) - 1;
  }

 private:
  static constexpr std::uint64_t reach_cycles = std::uint64_t{1} << 23;

  void set_anchor(std::uint64_t cycle) const;
  std::uint64_t edges_from_anchor(std::uint64_t ps) const;
  std::uint64_t far_edge_at_or_after(std::uint64_t ps) const;
  std::uint64_t time_from_anchor(std::uint64_t edges) const {
    const std::uint64_t ps = anchor_.ps + edges * period_ps_;
    if (period_remainder_ == 0) return ps;
    return ps + (edges * period_remainder_ + anchor_.remainder) / hertz_;
  }

  std::uint64_t hertz_ = 0;
  Edge origin_{0, 0, 0};                ///< the last change: no edge, but they count from there
  std::uint64_t period_ps_ = 0;         ///< rounded down
  std::uint64_t period_remainder_ = 0;  ///< what that cut off, in 1 / f ps
  std::uint64_t reach_ps_ = 0;          ///< 0 while the clock stands
  mutable Edge anchor_{0, 0, 0};
};

/// Numbered times, of which mostly the first one moves while the others wait: the alarms of a
/// clock's modules, the next edges of several clocks.
///
/// Invariant: no time but that of `first_` lies before `others_`. So a move costs a store and a
/// comparison, and all times are looked at only when the first one has passed the others.
class Earliest {
 public:
  static constexpr std::uint64_t never = EdgeTimes::never;

  /// A place more, behind the others.
  void push(std::uint64_t time);
  /// A place less; those behind it move up.
  void erase(std::size_t place);
  void set(std::size_t place, std::uint64_t time);
  std::uint64_t operator[](std::size_t place) const { return times_[place]; }

  /// The earliest time; never if there is none.
  std::uint64_t time() {
    if (times_[first_] > others_) look();
    return times_[first_];
  }
  /// Where time() was found when it was last called; after a set() the place of an earlier time, if
  /// that was one.
  std::size_t place() const { return first_; }
  /// No time but that of place() is at or before `time`.
  bool others_are_after(std::uint64_t time) const { return others_ > time; }
  /// No time at all lies before this one.
  std::uint64_t bound() const { return std::min(others_, times_[first_]); }

 private:
  void look();

  std::vector<std::uint64_t> times_{never};  ///< one more than there are places
  std::size_t first_ = 0;
  std::uint64_t others_ = 0;
};

inline EdgeTimes::Edge EdgeTimes::edge(std::uint64_t cycle) const {
  if (cycle - anchor_.cycle > reach_cycles) set_anchor(cycle);
  const std::uint64_t n = cycle - anchor_.cycle;
  Edge edge{cycle, anchor_.ps + n * period_ps_, anchor_.remainder};
  if (period_remainder_ != 0) {
    const std::uint64_t cut_off = n * period_remainder_ + anchor_.remainder;
    edge.ps += cut_off / hertz_;
    edge.remainder = cut_off % hertz_;
  }
  return edge;
}

inline EdgeTimes::Edge EdgeTimes::after(Edge edge) const {
  ++edge.cycle;
  edge.ps += period_ps_;
  edge.remainder += period_remainder_;
  if (edge.remainder >= hertz_) {
    edge.remainder -= hertz_;
    ++edge.ps;
  }
  return edge;
}

// From an anchor near before it; its own edge and those of a clock that has just changed are left
// to the general way.
inline std::uint64_t EdgeTimes::edge_at_or_after(std::uint64_t ps) const {
  const std::uint64_t ahead = ps - anchor_.ps;
  const std::uint64_t distance = ahead * hertz_;
  if (ahead - 1 >= reach_ps_ || distance <= anchor_.remainder) return far_edge_at_or_after(ps);
  return time_from_anchor((distance - anchor_.remainder + ps_per_second - 1) / ps_per_second);
}

inline void Earliest::set(std::size_t place, std::uint64_t time) {
  times_[place] = time;
  if (place == first_) return;
  const std::uint64_t known = times_[first_];
  others_ = std::min(others_, std::max(known, time));
  if (time < known) first_ = place;
}

}  // namespace vp
