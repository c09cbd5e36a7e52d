#include <drivers/timers.h>

#include <global_timer_registers.h>
#include <hal/hal.h>
#include <private_timer_registers.h>

namespace drivers {

namespace {

constexpr std::uint32_t at(std::uint32_t offset) {
  return global_timer::base + offset;
}

void disarm() {
  hal_write32(at(global_timer::CONTROL), global_timer::control::Timer_Enable);
}

}  // namespace

void GlobalTimer::initialise() const {
  clear_alarm();
}

std::uint64_t GlobalTimer::now() const {
  std::uint32_t high = hal_read32(at(global_timer::COUNTER_HIGH));
  for (;;) {
    const std::uint32_t low = hal_read32(at(global_timer::COUNTER_LOW));
    const std::uint32_t again = hal_read32(at(global_timer::COUNTER_HIGH));
    if (again == high) return static_cast<std::uint64_t>(high) << 32 | low;
    high = again;
  }
}

void GlobalTimer::set_alarm(std::uint64_t count) const {
  disarm();  // the two halves of the comparator cannot be written at once
  hal_write32(at(global_timer::COMPARATOR_LOW), static_cast<std::uint32_t>(count));
  hal_write32(at(global_timer::COMPARATOR_HIGH), static_cast<std::uint32_t>(count >> 32));
  hal_write32(at(global_timer::CONTROL), global_timer::control::Timer_Enable |
                                             global_timer::control::Comp_Enable |
                                             global_timer::control::IRQ_Enable);
}

void GlobalTimer::clear_alarm() const {
  disarm();
  hal_write32(at(global_timer::INTERRUPT_STATUS), global_timer::status::Event_Flag);
}

namespace {

namespace control = private_timer::control;

constexpr std::uint32_t private_register(std::uint32_t offset) {
  return private_timer::base + offset;
}

std::uint32_t prescaler_field(unsigned ticks) {
  return (static_cast<std::uint32_t>(ticks - 1) << control::Prescaler_shift) & control::Prescaler;
}

}  // namespace

void PrivateTimer::initialise(const PrivateTimerConfig& config) {
  control_ = prescaler_field(config.prescaler) | (config.periodic ? control::Auto_Reload : 0) |
             (config.interrupt ? control::IRQ_Enable : 0);
  stop();
  acknowledge();
}

// From n to 0 are n counts; a period has one more, from 0 back to the start value.
void PrivateTimer::start(std::uint32_t counts) const {
  const bool periodic = (control_ & control::Auto_Reload) != 0;
  stop();
  hal_write32(private_register(private_timer::LOAD), periodic ? counts - 1 : counts);
  if (periodic) hal_write32(private_register(private_timer::COUNTER), counts);
  hal_write32(private_register(private_timer::CONTROL), control_ | control::Enable);
}

void PrivateTimer::stop() const {
  hal_write32(private_register(private_timer::CONTROL), control_);
}

std::uint32_t PrivateTimer::remaining() const {
  return hal_read32(private_register(private_timer::COUNTER));
}

bool PrivateTimer::expired() const {
  return hal_read32(private_register(private_timer::INTERRUPT_STATUS)) &
         private_timer::status::Event_Flag;
}

void PrivateTimer::acknowledge() const {
  hal_write32(private_register(private_timer::INTERRUPT_STATUS), private_timer::status::Event_Flag);
}

void PrivateWatchdog::start(std::uint32_t counts, unsigned prescaler) {
  counts_ = counts;
  feed();
  hal_write32(private_register(private_timer::WDT_CONTROL),
              prescaler_field(prescaler) | control::Watchdog_Mode | control::Enable);
}

void PrivateWatchdog::feed() const {
  hal_write32(private_register(private_timer::WDT_LOAD), counts_);
}

void PrivateWatchdog::stop() const {
  hal_write32(private_register(private_timer::WDT_DISABLE), private_timer::disable_key_1);
  hal_write32(private_register(private_timer::WDT_DISABLE), private_timer::disable_key_2);
  hal_write32(private_register(private_timer::WDT_CONTROL), 0);
}

bool PrivateWatchdog::take_reset_flag() const {
  const std::uint32_t flag = hal_read32(private_register(private_timer::WDT_RESET_STATUS));
  hal_write32(private_register(private_timer::WDT_RESET_STATUS), flag);
  return flag & private_timer::reset_status::Reset_Flag;
}

}  // namespace drivers
