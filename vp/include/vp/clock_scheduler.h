#pragma once

#include <algorithm>
#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

#include <vp/clock.h>

namespace vp {

/// Called at the end of every instant in which a clock edge ran; for tracers.
class InstantObserver {
 public:
  virtual ~InstantObserver() = default;
  virtual void end_of_instant(std::uint64_t ps) = 0;
};

/// Runs the edges of all clocks of a simulation in the order of time, in one SystemC process.
///
/// At coincident edges every module samples what stood before the edge, whatever the order of the
/// clocks. While nothing else can happen (no SystemC event before), it runs many edges in one
/// activation.
class ClockScheduler : public sc_core::sc_module {
 public:
  explicit ClockScheduler(sc_core::sc_module_name name);

  /// Runs all edges up to and including the present simulation time. Whoever reads or writes
  /// clocked state from another process calls it first: what he writes is seen by later edges only.
  void synchronise();

  /// The present time in ps: that of the instant being run, or as far as pass_until() got.
  /// SystemC's own time may lag behind it, never lead.
  std::uint64_t now_ps() const {
    return running_ ? instant_ps_
                    : std::max(instant_ps_, std::uint64_t{sc_core::sc_time_stamp().value()});
  }

  /// What ends pass_until() early; checked after every instant.
  using Condition = bool (*)(const void* context);

  /// How far pass_until() may leave SystemC's time behind; 0 (default): not at all. No result
  /// depends on it.
  void set_lookahead(std::uint64_t ps) { lookahead_ps_ = ps; }

  /// Lets time pass up to `ps` for the process (an SC_THREAD) that calls. As long as no SystemC
  /// event lies before, it runs the clock edges itself and SystemC's time stays behind; otherwise
  /// it waits as others do. Returns early, at the end of an instant in which `condition` holds. A
  /// model that is called meanwhile and wants to wait uses pass_until(), too, or calls rejoin()
  /// first.
  void pass_until(std::uint64_t ps, Condition condition = nullptr, const void* context = nullptr);

  /// The condition of the process in pass_until() may have become true outside of a clock edge:
  /// looks at it.
  void check_condition();

  /// Lets SystemC's time catch up with now_ps().
  void rejoin();

  /// Notifies `event` at the instant being run (which may lie ahead of the simulation time).
  void notify(sc_core::sc_event& event);

  /// Many edges in one activation, up to the next SystemC event. Off (default): one activation an
  /// instant, so that a run ended by sc_start(duration) has run no edge after its end.
  void set_batch(bool batch) { batch_ = batch; }

  /// At coincident edges the clock that was made first runs first.
  bool runs_before(const Clock& first, const Clock& second) const;

  void add_observer(InstantObserver& observer);
  void remove_observer(InstantObserver& observer);

 private:
  friend class Clock;
  friend class Clocked;
  friend class SignalBase;

  void start_of_simulation() override;
  void run();
  void wait_in_kernel(std::uint64_t ps, Condition condition, const void* context);
  enum class Ahead { reached, met, stopped };
  Ahead run_ahead(std::uint64_t ps, Condition condition, const void* context);
  void run_instant(std::uint64_t ps);
  void order_modules();
  void mark_deferred_signals();
  std::uint64_t next_instant() const;
  void reschedule();
  void defer(SignalBase& signal) { deferred_.push_back(&signal); }

  std::vector<Clock*> clocks_;
  std::vector<SignalBase*> deferred_;
  std::vector<InstantObserver*> observers_;
  sc_core::sc_event wake_up_;

  sc_core::sc_event condition_met_;
  std::vector<std::pair<Condition, const void*>>
      waiting_;  ///< of processes in pass_until() while the kernel runs
  std::uint64_t lookahead_ps_ = 0;
  std::uint64_t instant_ps_ = 0;
  bool running_ = false;
  bool batch_ = false;
  bool stop_batch_ = false;
  bool started_ = false;
};

/// SystemC's default resolution of 1 ps is assumed everywhere: a time's value is its picoseconds.
inline std::uint64_t to_ps(const sc_core::sc_time& time) {
  return time.value();
}
inline sc_core::sc_time from_ps(std::uint64_t ps) {
  return sc_core::sc_time::from_value(ps);
}

}  // namespace vp
