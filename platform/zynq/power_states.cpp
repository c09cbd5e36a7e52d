#include <zynq/power_states.h>

#include <algorithm>
#include <array>

namespace platform {

namespace {

double hz(const vp::Clock& clock) {
  return static_cast<double>(clock.frequency_hz());
}

}  // namespace

PowerStates::PowerStates(Zynq& zynq)
    : cpu_hz(hz(zynq.ps.cpu_clk.clk)),
      cpu_awake_hz(hz(zynq.ps.cpu_clk.clk)),
      system_hz(hz(zynq.ps.fclk_clk0.clk)),
      pixel_hz(hz(zynq.ps.fclk_clk1.clk)),
      zynq_(zynq),
      fastest_system_hz_(zynq.ps.fclk_clk0.clk.frequency_hz()),
      fastest_pixel_hz_(zynq.ps.fclk_clk1.clk.frequency_hz()) {
  for (ClockSource* source : {&zynq.ps.cpu_clk, &zynq.ps.fclk_clk0, &zynq.ps.fclk_clk1}) {
    source->clk.add_listener(*this);
  }
  zynq.ps.cpu.asleep.attach(*this);
  zynq.pl.sensor_input.frame_ena.attach(*this);
}

PowerStates::~PowerStates() {
  zynq_.ps.cpu.asleep.detach(*this);
  zynq_.pl.sensor_input.frame_ena.detach(*this);
}

std::uint64_t PowerStates::fastest_hz(const vp::Clock& clock) const {
  return &clock == &zynq_.ps.fclk_clk1.clk ? fastest_pixel_hz_ : fastest_system_hz_;
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
  const double system = hz(zynq_.ps.fclk_clk0.clk);
  const double pixel = hz(zynq_.ps.fclk_clk1.clk);
  cpu_hz.set(now, cpu);
  cpu_awake_hz.set(now, awake() ? cpu : 0);
  system_hz.set(now, system);
  system_frame_hz.set(now, frame_runs() ? system : 0);
  pixel_hz.set(now, pixel);
  pixel_frame_hz.set(now, frame_runs() ? pixel : 0);
  fastest_system_hz_ = std::max(fastest_system_hz_, zynq_.ps.fclk_clk0.clk.frequency_hz());
  fastest_pixel_hz_ = std::max(fastest_pixel_hz_, zynq_.ps.fclk_clk1.clk.frequency_hz());
  if (observer_) observer_->states_changed(now);
}

std::vector<std::uint64_t> PowerStates::changes(std::uint64_t from_ps, std::uint64_t to_ps) const {
  std::vector<std::uint64_t> times;
  for (const vp::PiecewiseConstant* history :
       {&cpu_hz, &cpu_awake_hz, &system_hz, &system_frame_hz, &pixel_hz, &pixel_frame_hz}) {
    for (const auto& step : history->steps()) {
      if (step.ps > from_ps && step.ps < to_ps) times.push_back(step.ps);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void PowerStates::forget_before(std::uint64_t ps) {
  for (vp::PiecewiseConstant* history :
       {&cpu_hz, &cpu_awake_hz, &system_hz, &system_frame_hz, &pixel_hz, &pixel_frame_hz}) {
    history->forget_before(ps);
  }
}

}  // namespace platform
