#include <chip/cost/power_states.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <chip/system/design.h>

namespace platform {

namespace {

double hz(const vp::Clock& clock) {
  return static_cast<double>(clock.frequency_hz());
}

}  // namespace

PowerStates::PowerStates(Zynq& zynq)
    : cpu_hz(hz(zynq.ps.cpu_clk.clk)),
      cpu_awake_hz(hz(zynq.ps.cpu_clk.clk)),
      zynq_(zynq),
      busy_(zynq.design().busy()),
      fastest_cpu_hz_(zynq.ps.cpu_clk.clk.frequency_hz()) {
  zynq.ps.cpu_clk.clk.add_listener(*this);
  for (const auto& [number, source] : zynq.ps.fclks()) {
    source->clk.add_listener(*this);
    add_pl_clock(source->clk, false);
  }
  for (const Design::ClockRole& role : zynq.design().clock_roles()) {
    if (!knows(*role.clock)) add_pl_clock(*role.clock, true);
  }
  for (ps::Cpu* core : zynq.ps.cpus()) core->asleep.attach(*this);
  if (busy_) busy_->attach(*this);
}

PowerStates::~PowerStates() {
  for (ps::Cpu* core : zynq_.ps.cpus()) core->asleep.detach(*this);
  if (busy_) busy_->detach(*this);
}

unsigned PowerStates::awake_cores() const {
  const auto* second = zynq_.ps.second_core();
  return (zynq_.ps.cpu.asleep ? 0u : 1u) + (second && !second->cpu.asleep ? 1u : 0u);
}

std::uint64_t PowerStates::fastest_hz(const vp::Clock& clock) const {
  return &clock == &zynq_.ps.cpu_clk.clk ? fastest_cpu_hz_ : pl_clock(clock).fastest_hz;
}

void PowerStates::add_pl_clock(const vp::Clock& clock, bool external) {
  pl_clocks_.push_back({&clock, vp::PiecewiseConstant(hz(clock)),
                        vp::PiecewiseConstant(frame_runs() ? hz(clock) : 0), clock.frequency_hz(),
                        external});
}

bool PowerStates::knows(const vp::Clock& clock) const {
  return std::any_of(pl_clocks_.begin(), pl_clocks_.end(),
                     [&](const PlClock& known) { return known.clock == &clock; });
}

const PowerStates::PlClock& PowerStates::pl_clock(const vp::Clock& clock) const {
  for (const PlClock& known : pl_clocks_) {
    if (known.clock == &clock) return known;
  }
  throw std::logic_error(std::string(clock.name()) +
                         " is no clock that the PS makes for the PL, nor one of the design's");
}

// A core falls asleep and wakes with every burst of an upload: nothing else is looked at.
void PowerStates::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (&signal == busy_) return update();
  const std::uint64_t now = zynq_.scheduler.now_ps();
  cpu_awake_hz.set(now, awake_cores() * hz(zynq_.ps.cpu_clk.clk));
  if (observer_) observer_->states_changed(now);
}

void PowerStates::update() {
  const std::uint64_t now = zynq_.scheduler.now_ps();
  const double cpu = hz(zynq_.ps.cpu_clk.clk);
  fastest_cpu_hz_ = std::max(fastest_cpu_hz_, zynq_.ps.cpu_clk.clk.frequency_hz());
  cpu_hz.set(now, cpu);
  cpu_awake_hz.set(now, awake_cores() * cpu);
  for (PlClock& pl : pl_clocks_) {
    pl.hz.set(now, hz(*pl.clock));
    pl.frame_hz.set(now, frame_runs() ? hz(*pl.clock) : 0);
    pl.fastest_hz = std::max(pl.fastest_hz, pl.clock->frequency_hz());
  }
  if (observer_) observer_->states_changed(now);
}

template <class Visit>
void PowerStates::for_each_history(Visit visit) {
  visit(cpu_hz);
  visit(cpu_awake_hz);
  for (PlClock& pl : pl_clocks_) {
    visit(pl.hz);
    visit(pl.frame_hz);
  }
}

std::vector<std::uint64_t> PowerStates::changes(std::uint64_t from_ps, std::uint64_t to_ps) {
  std::vector<std::uint64_t> times;
  for_each_history([&](const vp::PiecewiseConstant& history) {
    for (const auto& step : history.steps()) {
      if (step.ps > from_ps && step.ps < to_ps) times.push_back(step.ps);
    }
  });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void PowerStates::forget_before(std::uint64_t ps) {
  for_each_history([ps](vp::PiecewiseConstant& history) { history.forget_before(ps); });
}

}  // namespace platform
