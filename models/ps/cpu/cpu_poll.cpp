// Polling: read after read, but for those that cannot see anything new.
#include <ps/cpu/cpu.h>
#include <ps/cpu/poll_grid.h>
#include <ps/cpu/poll_skip.h>
#include <algorithm>

namespace ps {

namespace {

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

// The poll grid: read n + 1 leaves when read n is answered and the loop's cycles have passed, later
// by the interrupts that came in between.
hal_poll_result Cpu::poll_until_changed(std::uint32_t address, std::uint32_t previous,
                                        std::uint32_t cycles, std::uint32_t limit) {
  hal_poll_result result{previous, 0, false};
  while (result.polls < limit && !result.changed) {
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
  if (!read_ps || *read_ps == 0 || start >= deadline_ps_ || hertz_ != clock_.frequency_hz() ||
      route->arrival_ps(start) == vp::Clock::never) {
    return none;
  }
  const PollGrid grid(*route, start, *read_ps, cycles, local_time_, hertz_);
  const std::uint64_t last = grid.one_before(deadline_ps_, limit - 1);
  PollSkip skip(*route, grid, last, scheduler_, interruptible() ? irq_is_low : nullptr, this);
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
