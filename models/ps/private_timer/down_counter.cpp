#include <private_timer_registers.h>

#include <ps/private_timer/down_counter.h>

namespace ps {

namespace control = private_timer::control;

DownCounter::DownCounter(vp::RegisterBank& bank, const Offsets& offsets, const vp::Clock& clock)
    : load(bank[offsets.load]),
      counter(bank[offsets.counter]),
      control(bank[offsets.control]),
      clock_(clock) {
  counter.computed_by([this] { return value(); });
}

bool DownCounter::running() const {
  return (running_control_ & control::Enable) != 0;
}

std::uint64_t DownCounter::cycles_per_count() const {
  const std::uint64_t prescaler =
      (running_control_ & control::Prescaler) >> control::Prescaler_shift;
  return private_timer::cpu_cycles_per_tick * (prescaler + 1);
}

std::uint32_t DownCounter::value() const {
  if (!running()) return base_;
  if (clock_.cycle() < origin_) return 0;  // reached 0, not yet started again
  const std::uint64_t counts = (clock_.cycle() - origin_) / cycles_per_count();
  return counts < base_ ? static_cast<std::uint32_t>(base_ - counts) : 0;
}

void DownCounter::rebase(std::uint32_t value) {
  base_ = value;
  origin_ = clock_.cycle();
}

// A counter that is set to 0 is not one that reached it.
void DownCounter::set(std::uint32_t value) {
  rebase(value);
  expired_ = value == 0;
}

void DownCounter::control_written() {
  constexpr std::uint32_t counting = control::Enable | control::Auto_Reload | control::Prescaler;
  if (((control ^ running_control_) & counting) == 0) {
    running_control_ = control;
    return;
  }
  rebase(value());
  running_control_ = control;
  if (running() && control.any(control::Auto_Reload) && base_ == 0) set(load);
}

bool DownCounter::take_event() {
  const std::uint64_t at_zero = next_event();
  if (clock_.cycle() < at_zero) return false;
  if (control.any(control::Auto_Reload)) {
    base_ = load;
    origin_ = at_zero + cycles_per_count();
    expired_ = base_ == 0;
  } else {
    rebase(0);
    expired_ = true;
  }
  return true;
}

std::uint64_t DownCounter::next_event() const {
  if (!running() || expired_) return vp::Clock::never;
  return origin_ + base_ * cycles_per_count();
}

}  // namespace ps
