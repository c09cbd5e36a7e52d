// Polling: read after read, but for those that cannot see anything new.
#include <ps/cpu/cpu.h>

#include <algorithm>

namespace ps {

namespace {

constexpr double ps_per_second = 1e12;

/// A skip that listeners find while it runs.
class Shown {
 public:
  Shown(PollSkip*& place, PollSkip& skip) : place_(place) { place_ = &skip; }
  ~Shown() { place_ = nullptr; }
  Shown(const Shown&) = delete;
  Shown& operator=(const Shown&) = delete;

 private:
  PollSkip*& place_;
};

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

void PollSkip::run() {
  bool met = true;
  while (met && !off_grid_ && !(interrupt_ && interrupt_(context_))) {
    plan();
    if (goal_ps_ <= scheduler_.now_ps()) break;
    met = scheduler_.run_ahead_until(goal_ps_, stop, this);
  }
  if (!off_grid_) take_stock();
}

void PollSkip::plan() {
  stable_until_ps_ = std::max(route_.stable_until_ps(), scheduler_.now_ps());
  const PollGrid::Read read = grid_.first_from(stable_until_ps_, goal_);
  goal_ = read.number;
  goal_ps_ = read.arrives_ps;
}

bool PollSkip::stop(const void* skip) {
  const auto& self = *static_cast<const PollSkip*>(skip);
  return self.off_grid_ || (self.interrupt_ && self.interrupt_(self.context_)) ||
         self.route_.stable_until_ps() < self.stable_until_ps_;
}

void PollSkip::clock_changes() {
  if (!off_grid_) take_stock();
  off_grid_ = true;
}

// What happens at this very time may concern a read that reaches the register now: it counts as on
// its way.
void PollSkip::take_stock() {
  const std::uint64_t now = scheduler_.now_ps();
  done_ = now == goal_ps_ ? goal_ : grid_.first_from(now, goal_).number;
  const std::uint64_t left = grid_.leaves(done_);
  if (left >= now) return;
  route_.begin(on_its_way_.emplace(), true, left);
  route_.follow(*on_its_way_, now);
}

// The poll grid: read n + 1 leaves when read n is answered and the loop's cycles have passed, later
// by the interrupts that came in between.
hal_poll_result Cpu::poll_until_changed(std::uint32_t address, std::uint32_t previous,
                                        std::uint32_t cycles, std::uint32_t limit) {
  hal_poll_result result{previous, 0, false};
  while (result.polls < limit && !result.changed) {
    signs_.note_poll(address, previous, limit - result.polls);
    catch_up();
    Skipped skipped = skip_reads(address, previous, cycles, limit - result.polls);
    result.polls += static_cast<std::uint32_t>(skipped.reads);
    if (skipped.reads != 0 && !skipped.on_its_way) continue;  // between two reads
    if (skipped.on_its_way) {
      on_bus(skipped.until_ps, true, address,
             [&] { return skipped.route->complete(*skipped.on_its_way, result.value); });
    } else {
      result.value = read32(address);
    }
    ++result.polls;
    ++polls;
    result.changed = result.value != previous;
    spend_cycles(cycles);
  }
  if (result.changed) signs_.end_poll(address, result.value);
  return result;
}

// Only where the device tells how long its register stays as it is, and a read takes the same time
// whenever it begins. It is no different for anybody: not for the counters either.
Cpu::Skipped Cpu::skip_reads(std::uint32_t address, std::uint32_t previous, std::uint32_t cycles,
                             std::uint32_t limit) {
  Skipped none;
  const std::uint64_t start = now_ps();
  vp::RegisterRoute* route = poll_elision_ ? routes_.find(address) : nullptr;
  if (!route || route->stable_until_ps() <= start || route->peek() != previous) return none;
  const auto read_ps = route->read_time_ps();
  if (!read_ps || *read_ps == 0 || start >= deadline_.ps() || hertz_ != clock_.frequency_hz() ||
      route->arrival_ps(start) == vp::Clock::never) {
    return none;
  }
  const PollGrid grid(*route, start, *read_ps, cycles, local_time_, hertz_);
  const std::uint64_t last = grid.one_before(deadline_.ps(), limit - 1);
  PollSkip skip(*route, grid, last, scheduler_, irq_.interruptible() ? irq_is_low : nullptr, this);
  {
    const Shown shown(skip_, skip);
    skip.run();
  }
  const std::uint64_t reads = skip.done();
  const std::uint64_t until = skip.on_its_way() ? grid.leaves(reads) : now_ps();
  polls.add(reads);
  skipped_polls_ += reads;
  route->credit_reads(reads, previous);
  activity_.busy(until - start);
  local_time_ = grid.time_at(reads);
  if (!skip.on_its_way() && reads != 0) go_on_between(grid.ends(reads - 1), grid.leaves(reads));
  return {reads, until, route, skip.on_its_way()};
}

// The last read ends and the next one leaves then; part of that may have passed.
void Cpu::go_on_between(std::uint64_t end_ps, std::uint64_t leave_ps) {
  access_end_ps_ = end_ps;
  const std::uint64_t loop_from = std::max(end_ps, now_ps());
  if (leave_ps > loop_from) {
    local_time_.add_stall_fs(LocalTime::Wide{leave_ps - loop_from} * LocalTime::fs_per_ps);
  }
}

// A clock that changes in the middle of an edge: what follows is not on the poll grid.
void Cpu::before_change(vp::Clock&) {
  if (skip_) skip_->clock_changes();
}

}  // namespace ps
