#pragma once

#include <cstdint>

namespace drivers {

/// The Cortex-A9 MPCore's 64-bit counter, one count per 2 CPU cycles, and its comparator as a
/// one-shot alarm.
class GlobalTimer {
 public:
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
