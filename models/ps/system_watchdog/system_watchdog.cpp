#include <system_watchdog_registers.h>

#include <ps/system_watchdog/system_watchdog.h>

#include <vp/report.h>

#include <algorithm>

namespace ps {

namespace {

namespace wd = system_watchdog;

vp::RegisterBankOptions watchdog_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

}  // namespace

SystemWatchdog::SystemWatchdog(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk)
    : vp::Clocked(name, cpu_1x_clk),
      registers("registers", wd::registers, watchdog_options(), &cpu_1x_clk.scheduler()),
      mode_(registers[wd::MODE]),
      control_(registers[wd::CONTROL]),
      status_(registers[wd::STATUS]),
      accepted_mode_(mode_),
      accepted_control_(control_) {
  mode_.after_write([this](std::uint32_t word) { mode_written(word); });
  control_.after_write([this](std::uint32_t word) { control_written(word); });
  registers[wd::RESTART].after_write([this](std::uint32_t word) {
    if (word == wd::restart_key) restart();
  });
}

// A write without the key changes nothing.
void SystemWatchdog::mode_written(std::uint32_t word) {
  if (word >> wd::mode_key_shift != wd::mode_key) {
    mode_ = accepted_mode_;
    return;
  }
  const bool starts = mode_.any(wd::mode::WDEN) && (accepted_mode_ & wd::mode::WDEN) == 0;
  accepted_mode_ = mode_;
  if (starts || !mode_.any(wd::mode::WDEN)) restart();
}

void SystemWatchdog::control_written(std::uint32_t word) {
  if (word >> wd::control_key_shift == wd::control_key) {
    accepted_control_ = control_;
  } else {
    control_ = accepted_control_;
  }
}

void SystemWatchdog::restart() {
  status_ = 0;
  expired = false;
  zero_at_ = vp::Clock::never;
  if (mode_.any(wd::mode::WDEN)) {
    const std::uint64_t crv = (control_ & wd::control::CRV) >> wd::control::CRV_shift;
    const std::uint64_t counts = crv * (wd::low_counts + 1) + wd::low_counts;
    zero_at_ = clock().cycle() + counts * wd::prescaler[control_ & wd::control::CLKSEL];
  }
  plan();
}

void SystemWatchdog::expire() {
  zero_at_ = vp::Clock::never;
  status_ = wd::status::WDZ;
  expired = true;
  if (mode_.any(wd::mode::RSTEN)) {
    vp::warn(*this, "/markervp/system_watchdog/expired",
             "the system watchdog expired: on the chip it resets the system; here the program "
             "continues. Write 0x1999 to RESTART in time");
  }
  if (!mode_.any(wd::mode::IRQEN)) return;
  irq = true;
  pulse_end_ =
      clock().cycle() + (std::uint64_t{4} << ((mode_ & wd::mode::IRQLN) >> wd::mode::IRQLN_shift));
}

void SystemWatchdog::plan() {
  wake_at(std::min(zero_at_, pulse_end_));
}

void SystemWatchdog::edge() {
  sleep();
  const std::uint64_t now = clock().cycle();
  if (pulse_end_ <= now) {
    pulse_end_ = vp::Clock::never;
    irq = false;
  }
  if (zero_at_ <= now) expire();
  plan();
}

}  // namespace ps
