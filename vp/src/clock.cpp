#include <vp/clock.h>

#include <vp/clock_scheduler.h>
#include <algorithm>

namespace vp {

namespace {

constexpr std::uint64_t ps_per_second = 1'000'000'000'000;
using Wide = unsigned __int128;

}  // namespace

Clocked::Clocked(sc_core::sc_module_name name, Clock& clock) : sc_module(name), clock_(clock) {
  clock_.modules_.push_back(this);
  ++clock_.awake_;
}

Clocked::~Clocked() {
  sleep();
  auto& modules = clock_.modules_;
  modules.erase(std::remove(modules.begin(), modules.end(), this), modules.end());
}

void Clocked::wake() {
  if (awake_) return;
  awake_ = true;
  ++clock_.awake_;
  clock_.plan_next(clock_.scheduler().now_ps());
}

void Clocked::wake_at(std::uint64_t cycle) {
  alarm_ = cycle;
  clock_.plan_next(clock_.scheduler().now_ps());
}

void Clocked::wake_on(InBase& input) {
  wake_inputs_.push_back(&input);
}

void Clocked::on_change(SignalBase&, std::uint32_t) {
  wake();
}

void Clocked::end_of_elaboration() {
  for (InBase* input : wake_inputs_) {
    if (input->signal()) input->signal()->attach(*this);
  }
}

Clock::Clock(const char* name, ClockScheduler& scheduler, std::uint64_t hertz)
    : sc_object(name), scheduler_(scheduler), hertz_(hertz) {
  scheduler_.clocks_.push_back(this);
  seek(1);
}

void Clock::set_frequency(std::uint64_t hertz) {
  scheduler_.synchronise();
  for (ClockListener* listener : listeners_) listener->before_change(*this);
  const std::uint64_t now = scheduler_.now_ps();
  origin_cycle_ = cycle();
  origin_ps_ = now;
  hertz_ = hertz;
  seek(origin_cycle_ + 1);
  plan_next(now);
  for (ClockListener* listener : listeners_) listener->after_change(*this);
}

std::uint64_t Clock::time_of(std::uint64_t cycle) const {
  if (hertz_ == 0) return never;
  const Wide numerator = Wide(cycle - origin_cycle_) * ps_per_second + hertz_ / 2;
  return origin_ps_ + static_cast<std::uint64_t>(numerator / hertz_);
}

std::uint64_t Clock::cycle_at_or_after(std::uint64_t ps) const {
  if (hertz_ == 0) return never;
  if (ps <= origin_ps_) return origin_cycle_ + 1;
  // An estimate that is at most one too small, then the exact edge.
  std::uint64_t n = static_cast<std::uint64_t>(Wide(ps - origin_ps_) * hertz_ / ps_per_second);
  std::uint64_t cycle = origin_cycle_ + std::max<std::uint64_t>(n, 1);
  while (time_of(cycle) < ps) ++cycle;
  return cycle;
}

std::uint64_t Clock::cycle() const {
  const std::uint64_t now = scheduler_.now_ps();
  if (hertz_ == 0 || now < origin_ps_) return origin_cycle_;
  // The last edge at or before now.
  return cycle_at_or_after(now + 1) - 1;
}

std::uint64_t Clock::duration_ps(double cycles) const {
  if (hertz_ == 0) return never;
  return static_cast<std::uint64_t>(
      cycles * static_cast<double>(ps_per_second) / static_cast<double>(hertz_) + 0.5);
}

void Clock::seek(std::uint64_t cycle) {
  next_cycle_ = cycle;
  next_ps_ = time_of(cycle);
  if (hertz_ == 0) return;
  step_quotient_ = ps_per_second / hertz_;
  step_remainder_ = ps_per_second % hertz_;
  const Wide numerator = Wide(cycle - origin_cycle_) * ps_per_second + hertz_ / 2;
  remainder_ = static_cast<std::uint64_t>(numerator % hertz_);
}

// time_of(next_cycle_ + 1) without a division.
inline void Clock::step() {
  ++next_cycle_;
  next_ps_ += step_quotient_;
  remainder_ += step_remainder_;
  if (remainder_ >= hertz_) {
    remainder_ -= hertz_;
    ++next_ps_;
  }
}

void Clock::run_edge() {
  ++edges_run_;
  in_edge_ = true;
  const std::uint64_t cycle = next_cycle_;
  for (Clocked* module : modules_) {
    const bool due = module->alarm_ == cycle;
    if (due) module->alarm_ = never;
    if (module->awake_ || due) module->edge();
  }
  in_edge_ = false;
  if (awake_ > 0) {
    step();
  } else {
    seek_alarm();
  }
}

void Clock::seek_alarm() {
  std::uint64_t alarm = never;
  for (const Clocked* module : modules_) alarm = std::min(alarm, module->alarm_);
  if (alarm == never || hertz_ == 0) {
    next_ps_ = never;
  } else {
    seek(alarm);
  }
}

// A module woke or set an alarm: the clock runs again from its first edge after `after_ps`.
void Clock::plan_next(std::uint64_t after_ps) {
  // run_edge() plans when all modules have run; an edge of this very instant that is still to come
  // is not passed over.
  if (in_edge_ || next_ps_ == after_ps) return;
  if (awake_ > 0 && hertz_ != 0) {
    seek(cycle_at_or_after(after_ps + 1));
  } else {
    seek_alarm();
  }
  scheduler_.reschedule();
}

}  // namespace vp
