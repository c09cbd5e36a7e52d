#pragma once

#include <cstdint>

namespace drivers {

struct PrivateTimerConfig {
  unsigned prescaler = 1;  ///< ticks a count, 1 … 256; a tick is 2 CPU cycles
  bool periodic = false;   ///< starts again at 0
  bool interrupt = true;   ///< raises interrupt 29 at 0
};

/// The Cortex-A9's private timer: counts down to 0, once or again and again.
class PrivateTimer {
 public:
  /// Stopped, nothing pending.
  void initialise(const PrivateTimerConfig& config);

  /// Runs for `counts` (1 …): the event comes then; a periodic timer has it every `counts`.
  void start(std::uint32_t counts) const;
  /// Stops at the present count.
  void stop() const;
  /// Counts until the event.
  std::uint32_t remaining() const;
  /// True if the event came since it was acknowledged.
  bool expired() const;
  /// Clears the event. Also what a handler does.
  void acknowledge() const;

 private:
  std::uint32_t control_;  ///< without Enable
};

/// The Cortex-A9's private watchdog in watchdog mode: resets the CPU unless it is fed in time.
class PrivateWatchdog {
 public:
  /// Expires after `counts` of `prescaler` ticks (1 … 256) without feed().
  void start(std::uint32_t counts, unsigned prescaler = 1);
  void feed() const;
  /// Leaves watchdog mode and stops.
  void stop() const;
  /// True if it was the watchdog that reset the CPU; forgets it.
  bool take_reset_flag() const;

 private:
  std::uint32_t counts_;
};

/// The Cortex-A9 MPCore's 64-bit counter, one count per 2 CPU cycles, and its comparator as a
/// one-shot alarm.
class GlobalTimer {
 public:
  static constexpr std::uint32_t cycles_per_count = 2;  ///< of the CPU's clock

  /// Counts a second at the CPU clock that Vivado states, 666,666,687 Hz.
  static constexpr std::uint64_t counts_per_second = 333'333'343;

  /// Starts the counter unless it runs (the boot code leaves it running); no alarm.
  void initialise() const;

  /// The counter, read high, low, high: 64 bits of one moment.
  std::uint64_t now() const;

  /// Raises interrupt 27 when the counter reaches `count`, at once if it did already.
  void set_alarm(std::uint64_t count) const;

  /// No alarm, and none pending. Also what a handler of the alarm does.
  void clear_alarm() const;
};

}  // namespace drivers
