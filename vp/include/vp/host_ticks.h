#pragma once

#include <sys/types.h>

#include <cstdint>

namespace vp {

/// Ticks of the host, ten a second, for listeners that must notice when something takes too long,
/// whatever code runs. Without a listener there are no ticks.
///
/// Ticks come from a signal (SIGALRM, ITIMER_REAL) in the main thread, so they cost the running
/// code nothing. They do not continue in a forked process.
class HostTicks {
 public:
  static constexpr std::uint64_t period_ns = 100'000'000;

  class Listener {
   public:
    /// Called in a signal handler; may leave it with siglongjmp(). `spent_ns` is the host time
    /// since the last tick: the processor time of this process, so that a busy machine takes
    /// nothing away from it, or the time that passed if it only waited, and those that it follows
    /// did not compute. `context` is a ucontext_t.
    virtual void on_host_tick(std::uint64_t spent_ns, void* context) = 0;

   protected:
    ~Listener() = default;
  };

  /// At most eight at a time. Both may be called in signal handlers.
  static void add(Listener& listener);
  static void remove(Listener& listener);
  /// The processor time of a process and of its descendants counts as this process' own, which
  /// waits for them. 0: of none.
  static void follow(pid_t process);
  /// For listeners: the next tick comes after a hundredth of the period.
  static void hurry();
};

}  // namespace vp
