#pragma once

#include <algorithm>
#include <cstdint>

namespace ps {

/// The time a processor has spent since it last looked at the clock, in CPU cycles and in
/// nanoseconds that do not scale with its frequency.
///
/// Sums are exact integers: 2^-20 cycles and femtoseconds. Only take_ps() rounds, and keeps what it
/// cut off for the next call: the picoseconds taken in total do not depend on how the work was
/// split, and never drift.
class LocalTime {
 public:
  using Wide = unsigned __int128;

  static constexpr unsigned fraction_bits = 20;
  static constexpr std::uint64_t one_cycle = std::uint64_t{1} << fraction_bits;
  static constexpr std::uint64_t fs_per_ps = 1'000;

  /// Longest time that one call adds: more than any run lasts, less than what overflows.
  static constexpr Wide most_cycles = Wide{1} << 76;  ///< in 2^-20 cycles: three years at 667 MHz
  static constexpr Wide most_stall_fs = Wide{1} << 100;

  /// `hertz` 1 to 10^12: the frequency at which cycles added before are taken.
  void set_frequency(std::uint64_t hertz);

  void add_cycles(Wide fraction_cycles) {
    cycles_ = std::min(cycles_ + std::min(fraction_cycles, most_cycles), most_cycles);
  }
  void add_stall_fs(Wide femtoseconds) {
    stall_fs_ = std::min(stall_fs_ + std::min(femtoseconds, most_stall_fs), most_stall_fs);
  }

  bool empty() const { return (cycles_ | stall_fs_) == 0; }
  /// Whole picoseconds added since the last call.
  std::uint64_t take_ps();

 private:
  Wide take_cycles();

  std::uint64_t hertz_ = 1;
  Wide cycles_ = 0;  ///< in 2^-20 cycles
  Wide stall_fs_ = 0;
  std::uint64_t cycle_remainder_ = 0;  ///< in 1 / (hertz · 2^5) of a femtosecond, less than one
  std::uint64_t fs_remainder_ = 0;
};

}  // namespace ps
