#include <ps/cpu/local_time.h>

namespace ps {

void LocalTime::set_frequency(std::uint64_t hertz) {
  if (hertz == hertz_) return;
  hertz_ = hertz;
  denominator_ = hertz << denominator_bits;
  cycle_fs_ = fs_per_second / hertz;
  cycle_rest_ = fs_per_second % hertz << denominator_bits;
  cycle_remainder_ = 0;  // less than a femtosecond
  // whole · cycle_rest_ and whole · cycle_fs_ below 2^62; the fraction adds less than 2^55.
  const std::uint64_t whole = little_limit / std::max(cycle_rest_, cycle_fs_);
  little_cycles_ = std::min(whole, little_limit / one_cycle) * one_cycle;
}

// take_little() in 128 bits.
std::uint64_t LocalTime::take_much() {
  const Wide numerator = cycles_.value() * numerator_factor + cycle_remainder_;
  const Wide cycles_fs = numerator / denominator_;
  cycle_remainder_ = static_cast<std::uint64_t>(numerator - cycles_fs * denominator_);
  const Wide fs = cycles_fs + stall_fs_.value() + fs_remainder_;
  fs_remainder_ = static_cast<std::uint64_t>(fs % fs_per_ps);
  cycles_.little = stall_fs_.little = 0;
  constexpr Wide most_ps = Wide{1} << 62;
  return static_cast<std::uint64_t>(std::min(fs / fs_per_ps, most_ps));
}

}  // namespace ps
