#pragma once

#include <cstdint>
#include <systemc>
#include <unordered_map>
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
/// At coincident edges every module samples the values from before the edge, whatever the order of
/// the clocks. While nothing else can happen (no SystemC event before), it runs many edges in one
/// activation.
class ClockScheduler : public sc_core::sc_module {
 public:
  explicit ClockScheduler(sc_core::sc_module_name name);

  /// Runs all edges up to and including the present simulation time. A process must call it before
  /// it reads or writes clocked state: its writes are then seen by later edges only.
  void synchronise() { synchronised_ps(); }
  /// The same; returns the present time.
  std::uint64_t synchronised_ps() {
    const std::uint64_t now = now_ps();
    if (next_ps_ <= now) run_due_instants();
    return now;
  }

  /// The present time in ps: that of the instant being run, or as far as pass_until() got.
  /// SystemC's own time may lag behind it, never lead.
  std::uint64_t now_ps() const {
    const std::uint64_t kernel = kernel_ps();
    return running_ || instant_ps_ > kernel ? instant_ps_ : kernel;
  }

  /// What ends pass_until() early; checked after every instant.
  using Condition = bool (*)(const void* context);

  /// How far pass_until() may leave SystemC's time behind; 0 (default): not at all. No result
  /// depends on it.
  void set_lookahead(std::uint64_t ps) {
    lookahead_ps_ = ps;
    forget_horizon();
  }

  /// Lets time pass up to `ps` for the process (an SC_THREAD) that calls. As long as no SystemC
  /// event lies before, it runs the clock edges itself and SystemC's time stays behind; otherwise
  /// it waits as others do. Returns early, at the end of an instant in which `condition` holds. A
  /// model that is called meanwhile and wants to wait uses pass_until(), too, or calls rejoin()
  /// first.
  ///
  /// A process that has run ahead notifies SystemC events through notify(); code that may do
  /// otherwise (a foreign target) is followed by forget_horizon().
  void pass_until(std::uint64_t ps, Condition condition = nullptr, const void* context = nullptr) {
    pass_from(now_ps(), ps, condition, context);
  }
  /// pass_until() for callers that know the present time.
  void pass_from(std::uint64_t now_ps, std::uint64_t ps, Condition condition = nullptr,
                 const void* context = nullptr) {
    if (ps > now_ps && !pass_quietly(ps)) pass_instants(now_ps, ps, condition, context);
  }
  /// The same, up to a later time, if nothing happens meanwhile. False: no time passes.
  bool pass_quietly(std::uint64_t ps) {
    if (!is_quiet_until(ps)) return false;
    instant_ps_ = ps;
    return true;
  }
  /// Something will still happen by itself before `ps`: an edge that a module waits for, or an
  /// event. Clock::never: at any time.
  bool has_more(std::uint64_t ps) const;
  /// Nothing happens up to `ps`, as far as that is known.
  bool is_quiet_until(std::uint64_t ps) const { return ps < next_ps_ && ps <= known_horizon(); }
  /// No clock edge up to now is left to run.
  bool up_to_date(std::uint64_t now_ps) const { return next_ps_ > now_ps; }

  /// The same, but never waits for SystemC: stops before its next event. True if `condition` ended
  /// it.
  bool run_ahead_until(std::uint64_t ps, Condition condition, const void* context);

  /// SystemC events may have been notified behind the scheduler's back: looks again before it runs
  /// ahead.
  void forget_horizon() { horizon_ps_ = 0; }

  /// The condition of the process in pass_until() may have become true outside of a clock edge:
  /// looks at it.
  void check_condition();

  /// Lets SystemC's time catch up with now_ps().
  void rejoin();

  /// Of processes that pass_until() brings to the same time, the calling one resumes last.
  void come_last() { last_ = sc_core::sc_get_current_process_handle(); }
  /// For that process: all others that are due now have their turn, and those that a clock edge of
  /// this time wakes.
  void let_others_go_first();

  /// Notifies `event` at the instant being run (which may lie ahead of the simulation time).
  void notify(sc_core::sc_event& event);

  /// Many edges in one activation, up to the next SystemC event. Off (default): one activation an
  /// instant, so that a run ended by sc_start(duration) has run no edge after its end.
  void set_batch(bool batch) { batch_ = batch; }

  /// All clocks, in the order in which they were made.
  const std::vector<Clock*>& clocks() const { return clocks_; }
  /// How often the frequency of a clock has changed.
  std::uint64_t clock_changes() const { return clock_changes_; }

  /// States that at coincident edges the modules of `first` run before those of `second`: for a
  /// module that looks into both domains at once. Signals need no such order, nor does any result
  /// depend on that in which clocks are made. To be said during elaboration; throws
  /// std::logic_error at its end if statements contradict each other.
  void run_before(const Clock& first, const Clock& second) {
    precedences_.emplace_back(&first, &second);
  }

  void add_observer(InstantObserver& observer);
  bool observed() const { return !observers_.empty(); }
  void remove_observer(InstantObserver& observer);

 private:
  friend class Clock;
  friend class Clocked;
  friend class SignalBase;

  std::uint64_t kernel_ps() const { return kernel_time_.value(); }
  /// Asked for with every stretch of time that passes: flattened, SystemC's getter is two loads.
  [[gnu::flatten]] static sc_dt::uint64 kernel_delta() {
    // There is a simulation: so SystemC's code need not be ready to make one.
    if (sc_core::sc_curr_simcontext == nullptr) __builtin_unreachable();
    return sc_core::sc_delta_count();
  }
  /// Up to where no SystemC event lies, if that was found out since SystemC ran last; else 0.
  std::uint64_t known_horizon() const { return horizon_delta_ == kernel_delta() ? horizon_ps_ : 0; }
  std::uint64_t find_horizon();
  std::uint64_t look_for_horizon();

  void start_of_simulation() override;
  void run();
  void run_due_instants();
  void pass_instants(std::uint64_t now_ps, std::uint64_t ps, Condition condition,
                     const void* context);
  void wait_in_kernel(std::uint64_t ps, Condition condition, const void* context);
  enum class Ahead { reached, met, stopped };
  Ahead run_ahead(std::uint64_t ps, Condition condition, const void* context);
  void run_instant(std::uint64_t ps);
  void run_edges(std::size_t from, std::uint64_t ps);
  void commit_deferred();
  void order_modules();
  static std::unordered_map<const Clocked*, unsigned> bits_read(
      const std::vector<Clocked*>& modules);
  void mark_deferred_signals();
  void run_edge_of(std::size_t clock);
  void reschedule(const Clock& clock);
  void plan_wake_up();
  void order_clocks();
  void defer(SignalBase& signal) { deferred_.push_back(&signal); }
  void show_later(SignalBase& signal);
  void show_signals();

  /// Turns the evaluation of a delta cycle into its update.
  class ShowUpdate : public sc_core::sc_prim_channel {
   public:
    explicit ShowUpdate(ClockScheduler& scheduler)
        : sc_prim_channel("show_update"), scheduler_(scheduler) {}
    using sc_prim_channel::request_update;

   private:
    void update() override;
    ClockScheduler& scheduler_;
  };

  std::vector<Clock*> clocks_;
  std::vector<Clock*> ticking_;  ///< those with modules, in the same order
  std::vector<SignalBase*> deferred_;
  std::vector<std::pair<const Clock*, const Clock*>> precedences_;
  std::vector<SignalBase*> stale_;  ///< SystemC has not seen their values yet
  ShowUpdate show_update_{*this};
  sc_core::sc_event stale_signals_;
  bool sampled_ = false;  ///< the processes on clocks' pins have run since signals became stale
  std::vector<InstantObserver*> observers_;
  sc_core::sc_event wake_up_;

  sc_core::sc_event condition_met_;
  std::vector<std::pair<Condition, const void*>>
      waiting_;  ///< of processes in pass_until() while the kernel runs
  const sc_core::sc_time& kernel_time_ = sc_core::sc_time_stamp();  ///< one object, always current
  std::uint64_t lookahead_ps_ = 0;
  std::uint64_t instant_ps_ = 0;
  Earliest edges_;                        ///< the next edge of each clock in ticking_, in ps
  std::uint64_t next_ps_ = Clock::never;  ///< the earliest of them
  std::uint64_t horizon_ps_ = 0;          ///< no SystemC event lies before or at it; 0 unknown
  sc_dt::uint64 horizon_delta_ = 0;       ///< when that was found out
  std::uint64_t clock_changes_ = 0;
  sc_core::sc_process_handle last_;  ///< comes last
  bool running_ = false;
  bool keeps_pace_ = false;  ///< foreign processes may do anything at any time: nothing runs ahead
  bool batch_ = false;
  bool stop_batch_ = false;
  bool started_ = false;
};

// The clock's next edge has moved. A process that ran ahead wakes us when it waits.
inline void ClockScheduler::reschedule(const Clock& clock) {
  if (!started_ || clock.places_.empty()) return;
  edges_.set(clock.number_, clock.next_.ps);
  if (running_) return;  // it looks when the instant is over
  next_ps_ = edges_.time();
  if (instant_ps_ <= kernel_ps()) plan_wake_up();
}

/// SystemC's default resolution of 1 ps is assumed everywhere: a time's value is its picoseconds.
inline std::uint64_t to_ps(const sc_core::sc_time& time) {
  return time.value();
}
inline sc_core::sc_time from_ps(std::uint64_t ps) {
  return sc_core::sc_time::from_value(ps);
}

}  // namespace vp
