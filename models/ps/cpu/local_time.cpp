#include <ps/cpu/local_time.h>
#include <algorithm>

namespace ps {

namespace {

constexpr LocalTime::Wide fs_per_second = 1'000'000'000'000'000;

}  // namespace

void LocalTime::set_frequency(std::uint64_t hertz) {
  if (hertz == hertz_) return;
  hertz_ = hertz;
  cycle_remainder_ = 0;  // less than a femtosecond
}

void LocalTime::add_cycles(Wide fraction_cycles) {
  cycles_ = std::min(cycles_ + std::min(fraction_cycles, most_cycles), most_cycles);
}

void LocalTime::add_stall_fs(Wide femtoseconds) {
  stall_fs_ = std::min(stall_fs_ + std::min(femtoseconds, most_stall_fs), most_stall_fs);
}

std::uint64_t LocalTime::take_ps() {
  const Wide denominator = Wide{hertz_} << fraction_bits;
  const Wide numerator = cycles_ * fs_per_second + cycle_remainder_;
  cycle_remainder_ = numerator % denominator;
  const Wide total_fs = numerator / denominator + stall_fs_ + fs_remainder_;
  fs_remainder_ = static_cast<std::uint64_t>(total_fs % fs_per_ps);
  cycles_ = stall_fs_ = 0;
  constexpr Wide most_ps = Wide{1} << 62;
  return static_cast<std::uint64_t>(std::min(total_fs / fs_per_ps, most_ps));
}

}  // namespace ps
