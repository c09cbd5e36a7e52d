#include <ps/cpu/poll_grid.h>
#include <algorithm>

namespace ps {

namespace {

constexpr double ps_per_second = 1e12;

}  // namespace

PollGrid::PollGrid(const vp::RegisterRoute& route, std::uint64_t start_ps, std::uint64_t read_ps,
                   std::uint32_t cycles, const LocalTime& time, std::uint64_t hertz)
    : route_(route),
      start_ps_(start_ps),
      read_ps_(read_ps),
      cycles_(cycles),
      time_(time),
      step_ps_(static_cast<double>(read_ps) +
               static_cast<double>(cycles) * ps_per_second / static_cast<double>(hertz)),
      first_arrival_ps_(route.arrival_ps(start_ps)) {}

// What LocalTime cuts off does not depend on how cycles are split: all rounds are taken at once.
std::uint64_t PollGrid::leaves(std::uint64_t read) const {
  return start_ps_ + read * read_ps_ + time_.ps_after(cycles_ * read);
}

LocalTime PollGrid::time_at(std::uint64_t read) const {
  LocalTime time = time_;
  time.add_cycles(LocalTime::Wide{cycles_ * read} << LocalTime::fraction_bits);
  time.take_ps();
  return time;
}

// A guess that is one or two off, then the exact one.
PollGrid::Read PollGrid::first_from(std::uint64_t ps, std::uint64_t last) const {
  if (first_arrival_ps_ >= ps) return {0, first_arrival_ps_};
  const double guess = static_cast<double>(ps - first_arrival_ps_) / step_ps_;
  std::uint64_t read = guess < static_cast<double>(last) ? static_cast<std::uint64_t>(guess) : last;
  std::uint64_t at = arrives(read);
  if (at < ps) {
    while (read < last && at < ps) at = arrives(++read);
    return {read, at};
  }
  for (; read > 0; --read) {
    const std::uint64_t before = arrives(read - 1);
    if (before < ps) break;
    at = before;
  }
  return {read, at};
}

std::uint64_t PollGrid::one_before(std::uint64_t ps, std::uint64_t last) const {
  // Sums stay far from what LocalTime and the times can hold.
  constexpr std::uint64_t most_cycles = std::uint64_t{1} << 56;
  if (cycles_ != 0) last = std::min(last, most_cycles / cycles_);
  const double guess = static_cast<double>(ps - start_ps_) / step_ps_;
  std::uint64_t read = guess < static_cast<double>(last) ? static_cast<std::uint64_t>(guess) : last;
  while (read > 0 && leaves(read) >= ps) --read;
  return read;
}

}  // namespace ps
