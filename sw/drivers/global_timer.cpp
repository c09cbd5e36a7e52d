#include <drivers/global_timer.h>
#include <global_timer_registers.h>
#include <hal/hal.h>

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

}  // namespace drivers
