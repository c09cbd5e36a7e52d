#pragma once

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

#include <vp/signal.h>

namespace vp {

class Clock;
class ClockScheduler;

/// A module that does something on the rising edges of one clock.
///
/// edge() samples inputs (what stood before the edge) and writes outputs. A module that would do
/// nothing on further edges with the same inputs calls sleep(); it wakes when a signal it listens
/// to changes, or at an alarm.
class Clocked : public sc_core::sc_module, public SignalListener {
 public:
  Clocked(sc_core::sc_module_name name, Clock& clock);
  ~Clocked() override;

  Clock& clock() const { return clock_; }
  bool awake() const { return awake_; }
  /// Runs edge() from the next edge of the clock on.
  void wake();
  /// Runs edge() on edge number `cycle` (as Clock::cycle() counts) even if asleep.
  void wake_at(std::uint64_t cycle);
  /// Wakes the module when a bound input changes.
  void wake_on(InBase& input);

 protected:
  friend class Clock;
  friend class ClockScheduler;
  friend class InBase;

  virtual void edge() = 0;
  void sleep();
  void on_change(SignalBase& signal, std::uint32_t id) override;
  void end_of_elaboration() override;

 private:
  Clock& clock_;
  bool awake_ = true;
  std::uint64_t alarm_ = ~std::uint64_t{0};
  std::vector<InBase*> inputs_;
  std::vector<InBase*> wake_inputs_;
};

/// Told when the frequency of a clock changes: who keeps times that follow from it.
class ClockListener {
 public:
  virtual ~ClockListener() = default;
  /// All edges up to now have run; the old frequency still stands.
  virtual void before_change(Clock& clock) = 0;
  /// The new frequency stands.
  virtual void after_change(Clock& clock) = 0;
};

/// One clock: edge n falls round(n · 10¹² / f) ps after the clock's last change, n = 1, 2, 3 …
class Clock : public sc_core::sc_object {
 public:
  static constexpr std::uint64_t never = ~std::uint64_t{0};

  /// `hertz` 1 to 10¹²; 0 stops the clock.
  Clock(const char* name, ClockScheduler& scheduler, std::uint64_t hertz);

  const char* kind() const override { return "vp::Clock"; }
  std::uint64_t frequency_hz() const { return hertz_; }
  /// Changes the frequency now: the next edge comes one new period from now. 0 stops the clock.
  void set_frequency(std::uint64_t hertz);
  void add_listener(ClockListener& listener) { listeners_.push_back(&listener); }

  /// Number of edges so far, those slept through included. Inside edge(): the number of this edge,
  /// the first one is 1.
  std::uint64_t cycle() const;
  /// Time of edge number `cycle` in ps, if the frequency stays; cycle > cycles before the last
  /// change.
  std::uint64_t time_of(std::uint64_t cycle) const;
  /// Number of the first edge at or after `ps` (not before the clock's last change).
  std::uint64_t cycle_at_or_after(std::uint64_t ps) const;
  /// Time in ps of the first edge at or after `ps`; `never` if the clock stands.
  std::uint64_t edge_at_or_after(std::uint64_t ps) const { return time_of(cycle_at_or_after(ps)); }
  /// `cycles` periods in ps, rounded to the nearest.
  std::uint64_t duration_ps(double cycles) const;

  ClockScheduler& scheduler() const { return scheduler_; }
  /// Edges on which at least one module ran, for performance reports.
  std::uint64_t edges_run() const { return edges_run_; }

 private:
  friend class ClockScheduler;
  friend class Clocked;

  void run_edge();
  void plan_next(std::uint64_t after_ps);
  void seek(std::uint64_t cycle);
  void seek_alarm();
  void step();

  ClockScheduler& scheduler_;
  std::uint64_t hertz_;
  std::uint64_t origin_ps_ = 0;     ///< time of the last change
  std::uint64_t origin_cycle_ = 0;  ///< edges before the last change
  std::uint64_t next_cycle_ = 1;    ///< the next edge that runs
  std::uint64_t next_ps_ = 0;       ///< its time; `never` while asleep
  std::uint64_t quotient_ = 0, remainder_ = 0, step_quotient_ = 0, step_remainder_ = 0;
  std::uint64_t edges_run_ = 0;
  std::size_t awake_ = 0;  ///< modules that run on every edge
  bool in_edge_ = false;
  std::vector<Clocked*> modules_;  ///< in running order: consumers first
  std::vector<ClockListener*> listeners_;
};

inline void Clocked::sleep() {
  if (!awake_) return;
  awake_ = false;
  --clock_.awake_;
}

}  // namespace vp
