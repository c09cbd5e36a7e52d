#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <vp/signal.h>

namespace vp {

/// When the edges of a clock fall: edge n at round(n · 10¹² / f) ps after the clock's last change.
///
/// Invariant: the anchor is an edge since that change; its time and remainder are exact. Edges up
/// to `reach_cycles` or `reach_ps_` after it are computed in 64 bits. A query for any other edge
/// moves the anchor, which takes 128-bit divisions.
class EdgeTimes {
 public:
  static constexpr std::uint64_t never = ~std::uint64_t{0};
  static constexpr std::uint64_t ps_per_second = 1'000'000'000'000;

  /// An edge, its time rounded down, and the remainder of the time in 1 / f ps.
  struct Edge {
    std::uint64_t cycle;
    std::uint64_t ps;
    std::uint64_t remainder;
  };

  /// Restarts the clock after `cycles` edges; the next one comes one period after `ps`. 0 Hz stops
  /// the clock.
  void restart(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz);
  /// Stops the clock after `cycles` edges, the last one at or before `ps`. hertz() is unchanged.
  void halt(std::uint64_t cycles, std::uint64_t ps);
  /// Continues after `cycles` edges with the edges of `source` after its edge `source_cycle`, which
  /// must not be earlier than the last change of `source`.
  void join(std::uint64_t cycles, const EdgeTimes& source, std::uint64_t source_cycle);

  std::uint64_t hertz() const { return hertz_; }
  bool stopped() const { return stopped_; }

  /// Edge number `cycle`, which must not precede the last change. The clock must be running.
  Edge edge(std::uint64_t cycle) const;
  /// The edge after `edge`, without a division.
  Edge after(Edge edge) const;
  /// An edge and its time.
  struct Moment {
    std::uint64_t cycle;
    std::uint64_t ps;
  };
  /// The first edge at or after `ps`; at `never` if the clock is stopped.
  Moment edge_at_or_after(std::uint64_t ps) const;
  /// Its number.
  std::uint64_t cycle_at_or_after(std::uint64_t ps) const;
  /// Number of edges up to and including `ps`.
  std::uint64_t cycles_until(std::uint64_t ps) const {
    return stopped() || ps < origin_.ps ? origin_.cycle : cycle_at_or_after(ps + 1) - 1;
  }

 private:
  static constexpr std::uint64_t reach_cycles = std::uint64_t{1} << 23;

  void set_anchor(std::uint64_t cycle) const;
  std::uint64_t edges_from_anchor(std::uint64_t ps) const;
  Moment far_edge_at_or_after(std::uint64_t ps) const;
  std::uint64_t time_from_anchor(std::uint64_t edges) const {
    const std::uint64_t ps = anchor_.ps + edges * period_ps_;
    if (period_remainder_ == 0) return ps;
    return ps + (edges * period_remainder_ + anchor_.remainder) / hertz_;
  }

  std::uint64_t hertz_ = 0;
  bool stopped_ = true;
  Edge origin_{0, 0, 0};                ///< the last change: not an edge, but edges count from it
  std::uint64_t period_ps_ = 0;         ///< rounded down
  std::uint64_t period_remainder_ = 0;  ///< remainder of the rounding, in 1 / f ps
  std::uint64_t reach_ps_ = 0;          ///< 0 while the clock is stopped
  mutable Edge anchor_{0, 0, 0};
};

/// The minimum of numbered times, for use where mostly the earliest one changes: the alarms of a
/// clock's modules, the next edges of several clocks.
///
/// Invariant: `others_` is a lower bound on every time except that of `first_`. Updating a time is
/// therefore O(1); all times are rescanned only when the earliest passes `others_`.
class Earliest {
 public:
  static constexpr std::uint64_t never = EdgeTimes::never;

  /// Appends a place.
  void push(std::uint64_t time);
  /// Removes a place; later places move down by one.
  void erase(std::size_t place);
  void set(std::size_t place, std::uint64_t time);
  std::uint64_t operator[](std::size_t place) const { return times_[place]; }

  /// The earliest time, or `never`.
  std::uint64_t time() {
    if (times_[first_] > others_) look();
    return times_[first_];
  }
  /// The place of the earliest time, as of the last call of time(); a set() of an earlier time
  /// updates it.
  std::size_t place() const { return first_; }
  /// True if every time except that of place() is after `time`.
  bool others_are_after(std::uint64_t time) const { return others_ > time; }
  /// A lower bound on all times.
  std::uint64_t bound() const { return std::min(others_, times_[first_]); }

 private:
  void look();

  std::vector<std::uint64_t> times_{never};  ///< the last one is a sentinel, not a place
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

// The fast path, for an anchor shortly before `ps`. The anchor's own edge, and the first edge of a
// clock that has just changed, take the general path. Called for every register access.
[[gnu::always_inline]] inline EdgeTimes::Moment EdgeTimes::edge_at_or_after(
    std::uint64_t ps) const {
  const std::uint64_t ahead = ps - anchor_.ps;
  const std::uint64_t distance = ahead * hertz_;
  if (ahead - 1 >= reach_ps_ || distance <= anchor_.remainder) return far_edge_at_or_after(ps);
  const std::uint64_t n = (distance - anchor_.remainder + ps_per_second - 1) / ps_per_second;
  return {anchor_.cycle + n, time_from_anchor(n)};
}

inline void Earliest::set(std::size_t place, std::uint64_t time) {
  times_[place] = time;
  if (place == first_) return;
  const std::uint64_t known = times_[first_];
  others_ = std::min(others_, std::max(known, time));
  if (time < known) first_ = place;
}

class Clock;
class ClockPin;
class ClockScheduler;

/// A module that does something on the rising edges of one clock.
///
/// edge() samples inputs (their values before the edge) and writes outputs. A module that would do
/// nothing on further edges with the same inputs calls sleep(); it wakes when a signal it listens
/// to changes, or at an alarm.
class Clocked : public sc_core::sc_module, public SignalListener {
 public:
  Clocked(sc_core::sc_module_name name, Clock& clock);
  ~Clocked() override;

  Clock& clock() const { return clock_; }
  bool awake() const;
  /// Runs edge() from the next edge of the clock on.
  void wake();
  /// Runs edge() on edge number `cycle` (as Clock::cycle() counts) even if asleep. Clock::never: no
  /// alarm. Throws std::logic_error if that edge lies in the past: a model that keeps stamps must
  /// check whether one has passed.
  void wake_at(std::uint64_t cycle);
  /// Wakes the module when a bound input changes.
  void wake_on(InBase& input);

 protected:
  friend class Clock;
  friend class ClockScheduler;
  friend class InBase;

  virtual void edge() = 0;
  void sleep();
  /// The number of the current edge, for use in edge(): Clock::cycle() without the time query.
  std::uint64_t this_edge() const;
  /// At the end of edge(): sleeps until edge number `cycle`, a later one. Clock::never: until
  /// woken.
  void sleep_until(std::uint64_t cycle);
  void on_change(SignalBase& signal, std::uint32_t id) override;
  void end_of_elaboration() override;

 private:
  [[noreturn]] void refuse_alarm(std::uint64_t cycle) const;

  Clock& clock_;
  std::size_t place_ = 0;  ///< in the clock's running order
  std::vector<InBase*> inputs_;
  std::vector<InBase*> wake_inputs_;
};

/// Called when the frequency of a clock changes: for models that keep times derived from it.
class ClockListener {
 public:
  virtual ~ClockListener() = default;
  /// All edges up to now have run; the old frequency is still in effect.
  virtual void before_change(Clock& clock) = 0;
  /// The new frequency is in effect.
  virtual void after_change(Clock& clock) = 0;
};

/// One clock: edge n falls round(n · 10¹² / f) ps after the clock's last change, n = 1, 2, 3 …
class Clock : public sc_core::sc_object {
 public:
  static constexpr std::uint64_t never = EdgeTimes::never;

  /// `hertz` 1 to 10¹²; 0 stops the clock.
  Clock(const char* name, ClockScheduler& scheduler, std::uint64_t hertz);
  ~Clock() override;

  const char* kind() const override { return "vp::Clock"; }
  std::uint64_t frequency_hz() const { return times_.hertz(); }
  /// Changes the frequency now: the next edge comes one new period from now. 0 stops the clock.
  void set_frequency(std::uint64_t hertz);
  void add_listener(ClockListener& listener) { listeners_.push_back(&listener); }
  /// The clock as a SystemC signal, for the ports of foreign modules: high for the first half of
  /// each period, low while stopped. Call during elaboration; it costs nothing if never called.
  /// Processes sensitive to it see our signals as they were before the edge.
  const sc_core::sc_signal_in_if<bool>& pin();

  /// Number of edges so far, including those slept through. Inside edge(): the number of this edge;
  /// the first one is 1.
  std::uint64_t cycle() const;
  /// Time of edge number `cycle` in ps, assuming that the frequency does not change. The edge must
  /// come after the last change.
  std::uint64_t time_of(std::uint64_t cycle) const {
    return times_.stopped() ? never : times_.edge(cycle).ps;
  }
  /// Number of the first edge at or after `ps` (not before the clock's last change).
  std::uint64_t cycle_at_or_after(std::uint64_t ps) const { return times_.cycle_at_or_after(ps); }
  /// Time in ps of the first edge at or after `ps`; `never` if the clock is stopped. The edge's
  /// number is cached, because callers that wait for an edge then call cycle().
  std::uint64_t edge_at_or_after(std::uint64_t ps) const {
    ahead_ = times_.edge_at_or_after(ps);
    return ahead_.ps;
  }
  /// `cycles` periods in ps, rounded to the nearest.
  std::uint64_t duration_ps(double cycles) const;

  ClockScheduler& scheduler() const { return scheduler_; }
  /// Edges on which at least one module ran, for performance reports.
  std::uint64_t edges_run() const { return edges_run_; }
  /// The clock whose edges these are: this one, unless it is a gated clock.
  virtual const Clock& source() const { return *this; }

 protected:
  /// Stops the clock now.
  void halt();
  /// From now on, the edges are those of `source`.
  void join(const Clock& source);

 private:
  friend class ClockScheduler;
  friend class Clocked;

  /// A module in running order. Its alarm is in alarms_.
  struct Place {
    Clocked* module;
    bool awake = true;
  };

  [[gnu::noinline]] std::uint64_t count_cycles(std::uint64_t now_ps) const;
  void start(std::uint64_t cycles, std::uint64_t ps, std::uint64_t hertz);
  void run_edge();
  void run_alarm(std::size_t at);
  void run_attended(std::size_t from);
  void plan_next(std::uint64_t after_ps);
  void go_to_alarm(std::uint64_t cycle);
  void plan_alarm(std::uint64_t before, std::uint64_t cycle);
  void set_order(const std::vector<Clocked*>& modules);
  void attend_to(std::size_t place);
  void attend_to_all();
  template <class Visit>
  void for_each_attended(std::size_t from, Visit visit) const;

  ClockScheduler& scheduler_;
  std::size_t number_ = 0;  ///< among the scheduler's clocks that have modules
  EdgeTimes times_;
  EdgeTimes::Edge next_{1, never, 0};          ///< the next edge that runs; at `never` while asleep
  mutable std::uint64_t cycle_ps_ = never;     ///< the time of the last query,
  mutable std::uint64_t cycle_ = 0;            ///< and the number of edges at that time
  mutable EdgeTimes::Moment ahead_{0, never};  ///< the last result of edge_at_or_after()
  std::uint64_t edges_run_ = 0;
  std::size_t awake_ = 0;  ///< modules that run on every edge
  bool in_edge_ = false;
  std::vector<Place> places_;            ///< in running order: consumers first
  Earliest alarms_;                      ///< cycles, by place
  std::vector<std::uint64_t> attended_;  ///< a bit for each place that is awake or has an alarm
  std::vector<ClockListener*> listeners_;
  std::unique_ptr<ClockPin> pin_;
};

inline void Clock::attend_to(std::size_t place) {
  const std::uint64_t bit = std::uint64_t{1} << place % 64;
  std::uint64_t& word = attended_[place / 64];
  word = places_[place].awake || alarms_[place] != never ? word | bit : word & ~bit;
}

inline bool Clocked::awake() const {
  return clock_.places_[place_].awake;
}

inline void Clocked::sleep() {
  Clock::Place& place = clock_.places_[place_];
  if (!place.awake) return;
  place.awake = false;
  --clock_.awake_;
  if (clock_.alarms_[place_] == Clock::never) clock_.attend_to(place_);
}

inline std::uint64_t Clocked::this_edge() const {
  return clock_.cycle_;
}

// The clock checks alarms at the end of the edge.
inline void Clocked::sleep_until(std::uint64_t cycle) {
  Clock::Place& place = clock_.places_[place_];
  if (place.awake) --clock_.awake_;
  place.awake = false;
  clock_.alarms_.set(place_, cycle);
}

}  // namespace vp
