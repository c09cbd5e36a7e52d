#include <ps/cpu/local_time.h>
#include <algorithm>

namespace ps {

namespace {

/// 2^-20 of a cycle is 5^15 / (hertz · 2^5) femtoseconds: 10^15 / (hertz · 2^20), reduced.
constexpr std::uint64_t numerator_factor = 30'517'578'125;
constexpr unsigned denominator_bits = 5;
/// Fewer cycles than this are computed in 64 bits.
constexpr LocalTime::Wide few_cycles = std::uint64_t{1} << 28;
static_assert(((std::uint64_t{1} << 28) - 1) <=
              ((std::uint64_t{1} << 63) - (std::uint64_t{1} << 46)) / numerator_factor);

}  // namespace

void LocalTime::set_frequency(std::uint64_t hertz) {
  if (hertz == hertz_) return;
  hertz_ = hertz;
  cycle_remainder_ = 0;  // less than a femtosecond
}

// Femtoseconds of the cycles, and what that cuts off.
LocalTime::Wide LocalTime::take_cycles() {
  const std::uint64_t denominator = hertz_ << denominator_bits;
  const Wide cycles = cycles_;
  cycles_ = 0;
  if (cycles < few_cycles) {
    const std::uint64_t numerator =
        static_cast<std::uint64_t>(cycles) * numerator_factor + cycle_remainder_;
    cycle_remainder_ = numerator % denominator;
    return numerator / denominator;
  }
  const Wide numerator = cycles * numerator_factor + cycle_remainder_;
  const Wide femtoseconds = numerator / denominator;
  cycle_remainder_ = static_cast<std::uint64_t>(numerator - femtoseconds * denominator);
  return femtoseconds;
}

std::uint64_t LocalTime::take_ps() {
  const Wide total_fs = take_cycles() + stall_fs_ + fs_remainder_;
  stall_fs_ = 0;
  if (total_fs >> 64 == 0) {
    const auto fs = static_cast<std::uint64_t>(total_fs);
    fs_remainder_ = fs % fs_per_ps;
    return fs / fs_per_ps;
  }
  fs_remainder_ = static_cast<std::uint64_t>(total_fs % fs_per_ps);
  constexpr Wide most_ps = Wide{1} << 62;
  return static_cast<std::uint64_t>(std::min(total_fs / fs_per_ps, most_ps));
}

}  // namespace ps
