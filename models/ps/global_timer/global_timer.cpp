#include <global_timer_registers.h>

#include <ps/global_timer/global_timer.h>

namespace ps {

namespace gt = global_timer;

namespace {

constexpr std::uint64_t low_half = 0xFFFF'FFFF;
constexpr std::uint64_t high_half = low_half << 32;

vp::RegisterBankOptions global_timer_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 8;
  return options;
}

}  // namespace

GlobalTimer::GlobalTimer(sc_core::sc_module_name name, vp::Clock& cpu_clock)
    : vp::Clocked(name, cpu_clock),
      registers("registers", gt::registers, global_timer_options(), &cpu_clock.scheduler()),
      enabled_by_boot(
          "enabled_by_boot", true, vp::Source::published,
          "the boot code leaves the counter running from time 0 (Xilinx standalone BSP)"),
      control_(registers[gt::CONTROL]),
      status_(registers[gt::INTERRUPT_STATUS]),
      auto_increment_(registers[gt::AUTO_INCREMENT]) {
  if (enabled_by_boot) control_.set_reset_value(gt::control::Timer_Enable);
  running_control_ = control_;

  registers[gt::COUNTER_LOW].computed_by([this] { return std::uint32_t(counter()); });
  registers[gt::COUNTER_HIGH].computed_by([this] { return std::uint32_t(counter() >> 32); });
  registers[gt::COUNTER_LOW].after_write([this](std::uint32_t w) { write_counter(low_half, w); });
  registers[gt::COUNTER_HIGH].after_write(
      [this](std::uint32_t w) { write_counter(high_half, std::uint64_t{w} << 32); });
  control_.after_write([this](std::uint32_t word) { write_control(word); });
  status_.after_write([this](std::uint32_t) { update(); });
  registers[gt::COMPARATOR_LOW].computed_by([this] { return std::uint32_t(comparator_); });
  registers[gt::COMPARATOR_HIGH].computed_by([this] { return std::uint32_t(comparator_ >> 32); });
  registers[gt::COMPARATOR_LOW].after_write(
      [this](std::uint32_t w) { write_comparator(low_half, w); });
  registers[gt::COMPARATOR_HIGH].after_write(
      [this](std::uint32_t w) { write_comparator(high_half, std::uint64_t{w} << 32); });
}

std::uint64_t GlobalTimer::cycles_per_count() const {
  const std::uint64_t prescaler =
      (running_control_ & gt::control::Prescaler) >> gt::control::Prescaler_shift;
  return gt::cpu_cycles_per_tick * (prescaler + 1);
}

std::uint64_t GlobalTimer::counter() const {
  if ((running_control_ & gt::control::Timer_Enable) == 0) return base_;
  return base_ + (clock().cycle() - origin_cycle_) / cycles_per_count();
}

// Counting starts anew from `counter`, with a whole period until the next count.
void GlobalTimer::rebase(std::uint64_t counter) {
  base_ = counter;
  origin_cycle_ = clock().cycle();
}

void GlobalTimer::write_counter(std::uint64_t mask, std::uint64_t value) {
  rebase((counter() & ~mask) | value);
  update();
}

void GlobalTimer::write_control(std::uint32_t) {
  constexpr std::uint32_t counting = gt::control::Timer_Enable | gt::control::Prescaler;
  if (((control_ ^ running_control_) & counting) != 0) rebase(counter());
  const bool comparator_enabled = (~running_control_ & control_ & gt::control::Comp_Enable) != 0;
  running_control_ = control_;
  armed_ |= comparator_enabled;
  update();
}

void GlobalTimer::write_comparator(std::uint64_t mask, std::uint64_t value) {
  comparator_ = (comparator_ & ~mask) | value;
  armed_ = true;
  update();
}

// An event when the counter is at or past the comparator, once for each value of the comparator
// (Cortex-A9 r2p0 on).
void GlobalTimer::update() {
  const std::uint32_t needed = gt::control::Timer_Enable | gt::control::Comp_Enable;
  if (armed_ && (control_ & needed) == needed && counter() >= comparator_) {
    status_.set_bits(gt::status::Event_Flag);
    armed_ = control_.any(gt::control::Auto_Increment) && auto_increment_ != 0;
    if (armed_) comparator_ += auto_increment_;
  }
  irq = status_.any(gt::status::Event_Flag) && control_.any(gt::control::IRQ_Enable);
  plan_match();
}

void GlobalTimer::plan_match() {
  const std::uint32_t needed = gt::control::Timer_Enable | gt::control::Comp_Enable;
  if (!armed_ || (control_ & needed) != needed) {
    wake_at(vp::Clock::never);
    return;
  }
  // A comparator that was moved on and lies in the past matches again on the next edge.
  const std::uint64_t next = clock().cycle() + 1;
  if (comparator_ <= counter()) {
    wake_at(next);
    return;
  }
  const auto cycles = static_cast<unsigned __int128>(comparator_ - base_) * cycles_per_count();
  const auto match = cycles + origin_cycle_;
  wake_at(match < vp::Clock::never ? static_cast<std::uint64_t>(match) : vp::Clock::never);
}

void GlobalTimer::edge() {
  update();
  sleep();
}

}  // namespace ps
