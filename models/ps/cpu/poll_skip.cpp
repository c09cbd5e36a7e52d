#include <ps/cpu/poll_skip.h>
#include <algorithm>

namespace ps {

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

}  // namespace ps
