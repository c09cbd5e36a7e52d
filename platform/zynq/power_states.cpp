#include <zynq/power_states.h>

#include <zynq/design.h>
#include <algorithm>
#include <stdexcept>
#include <string>

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
    const vp::Clock& clock = source->clk;
    source->clk.add_listener(*this);
    pl_clocks_.push_back({&clock, vp::PiecewiseConstant(hz(clock)),
                          vp::PiecewiseConstant(frame_runs() ? hz(clock) : 0),
                          clock.frequency_hz()});
  }
  zynq.ps.cpu.asleep.attach(*this);
  if (busy_) busy_->attach(*this);
}

PowerStates::~PowerStates() {
  zynq_.ps.cpu.asleep.detach(*this);
  if (busy_) busy_->detach(*this);
}

std::uint64_t PowerStates::fastest_hz(const vp::Clock& clock) const {
  return &clock == &zynq_.ps.cpu_clk.clk ? fastest_cpu_hz_ : pl_clock(clock).fastest_hz;
}

const PowerStates::PlClock& PowerStates::pl_clock(const vp::Clock& clock) const {
  for (const PlClock& known : pl_clocks_) {
    if (known.clock == &clock) return known;
  }
  throw std::logic_error(std::string(clock.name()) + " is no clock that the PS makes for the PL");
}

// The processor falls asleep and wakes with every burst of an upload: nothing else is looked at.
void PowerStates::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (&signal != &zynq_.ps.cpu.asleep) return update();
  const std::uint64_t now = zynq_.scheduler.now_ps();
  cpu_awake_hz.set(now, awake() ? hz(zynq_.ps.cpu_clk.clk) : 0);
  if (observer_) observer_->states_changed(now);
}

void PowerStates::update() {
  const std::uint64_t now = zynq_.scheduler.now_ps();
  const double cpu = hz(zynq_.ps.cpu_clk.clk);
  fastest_cpu_hz_ = std::max(fastest_cpu_hz_, zynq_.ps.cpu_clk.clk.frequency_hz());
  cpu_hz.set(now, cpu);
  cpu_awake_hz.set(now, awake() ? cpu : 0);
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
