#include <private_timer_registers.h>

#include <ps/private_timer/private_timer.h>

#include <vp/report.h>

#include <algorithm>

namespace ps {

namespace pt = private_timer;

namespace {

vp::RegisterBankOptions private_timer_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 8;
  return options;
}

}  // namespace

DownCounter::DownCounter(vp::RegisterBank& bank, const Offsets& offsets, const vp::Clock& clock)
    : load(bank[offsets.load]),
      counter(bank[offsets.counter]),
      control(bank[offsets.control]),
      clock_(clock) {
  counter.computed_by([this] { return value(); });
}

bool DownCounter::running() const {
  return (running_control_ & pt::control::Enable) != 0;
}

std::uint64_t DownCounter::cycles_per_count() const {
  const std::uint64_t prescaler =
      (running_control_ & pt::control::Prescaler) >> pt::control::Prescaler_shift;
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
  constexpr std::uint32_t counting =
      pt::control::Enable | pt::control::Auto_Reload | pt::control::Prescaler;
  if (((control ^ running_control_) & counting) == 0) {
    running_control_ = control;
    return;
  }
  rebase(value());
  running_control_ = control;
  if (running() && control.any(pt::control::Auto_Reload) && base_ == 0) set(load);
}

bool DownCounter::take_event() {
  const std::uint64_t at_zero = next_event();
  if (clock_.cycle() < at_zero) return false;
  if (control.any(pt::control::Auto_Reload)) {
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

PrivateTimer::PrivateTimer(sc_core::sc_module_name name, vp::Clock& cpu_clock)
    : vp::Clocked(name, cpu_clock),
      registers("registers", pt::registers, private_timer_options(), &cpu_clock.scheduler()),
      timer_(registers, {pt::LOAD, pt::COUNTER, pt::CONTROL}, cpu_clock),
      watchdog_(registers, {pt::WDT_LOAD, pt::WDT_COUNTER, pt::WDT_CONTROL}, cpu_clock),
      status_(registers[pt::INTERRUPT_STATUS]),
      watchdog_status_(registers[pt::WDT_INTERRUPT_STATUS]),
      reset_status_(registers[pt::WDT_RESET_STATUS]) {
  wire(timer_);
  wire(watchdog_);
  watchdog_.counter.after_write([this](std::uint32_t word) { watchdog_counter_written(word); });
  watchdog_.control.after_write([this](std::uint32_t) { watchdog_control_written(); });
  registers[pt::WDT_DISABLE].after_write([this](std::uint32_t word) { disable_written(word); });
  for (vp::Register* status : {&status_, &watchdog_status_, &reset_status_}) {
    status->after_write([this](std::uint32_t) { update(); });
  }
}

void PrivateTimer::wire(DownCounter& counter) {
  const auto set = [this, &counter](std::uint32_t word) {
    counter.set(word);
    update();
  };
  counter.load.after_write(set);
  counter.counter.after_write(set);
  counter.control.after_write([this, &counter](std::uint32_t) {
    counter.control_written();
    update();
  });
}

// Writing 0 does not leave watchdog mode.
void PrivateTimer::watchdog_control_written() {
  watchdog_mode_ |= watchdog_.control.any(pt::control::Watchdog_Mode);
  if (watchdog_mode_) watchdog_.control.set_bits(pt::control::Watchdog_Mode);
  watchdog_.control_written();
  update();
}

void PrivateTimer::watchdog_counter_written(std::uint32_t word) {
  if (watchdog_mode_) {
    vp::warn(*this, "/markervp/private_timer/watchdog_counter",
             "WDT_COUNTER written in watchdog mode: ignored; write WDT_LOAD");
    return;
  }
  watchdog_.set(word);
  update();
}

void PrivateTimer::disable_written(std::uint32_t word) {
  if (last_disable_key_ == pt::disable_key_1 && word == pt::disable_key_2) {
    watchdog_mode_ = false;
    watchdog_.control.clear_bits(pt::control::Watchdog_Mode);
  }
  last_disable_key_ = word;
}

void PrivateTimer::update() {
  if (timer_.take_event()) status_.set_bits(pt::status::Event_Flag);
  if (watchdog_.take_event()) {
    if (watchdog_mode_) {
      reset_status_.set_bits(pt::reset_status::Reset_Flag);
      vp::warn(*this, "/markervp/private_timer/watchdog",
               "the watchdog expired: on the chip it resets the processor; here the program "
               "continues");
    } else {
      watchdog_status_.set_bits(pt::status::Event_Flag);
    }
  }
  irq = status_.any(pt::status::Event_Flag) && timer_.control.any(pt::control::IRQ_Enable);
  watchdog_irq = watchdog_status_.any(pt::status::Event_Flag) &&
                 watchdog_.control.any(pt::control::IRQ_Enable);
  watchdog_reset = reset_status_.any(pt::reset_status::Reset_Flag);
  wake_at(std::min(timer_.next_event(), watchdog_.next_event()));
}

void PrivateTimer::edge() {
  update();
  sleep();
}

}  // namespace ps
