// xtime_l.h and sleep.h.
#include <global_timer_registers.h>
#include <hal/hal.h>
#include <sleep.h>
#include <xtime_l.h>

#include <algorithm>

namespace {

constexpr std::uint32_t at(std::uint32_t offset) {
  return global_timer::base + offset;
}

/// Cycles that one look at the timer may make pass on the virtual platform.
constexpr std::uint64_t longest_step = 1u << 30;

/// On the chip one look follows the other; on the platform each makes all of the time pass.
void wait_counts(u64 counts) {
  XTime now = 0;
  XTime_GetTime(&now);
  const XTime end = now + counts;
  while (now < end) {
    const std::uint64_t cycles = (end - now) * global_timer::cpu_cycles_per_tick;
    hal_poll_until_changed(at(global_timer::COUNTER_LOW), 0,
                           static_cast<std::uint32_t>(std::min(cycles, longest_step)), 1);
    XTime_GetTime(&now);
  }
}

}  // namespace

extern "C" {

void XTime_GetTime(XTime* Xtime_Global) {
  std::uint32_t high = hal_read32(at(global_timer::COUNTER_HIGH));
  for (;;) {
    const std::uint32_t low = hal_read32(at(global_timer::COUNTER_LOW));
    const std::uint32_t again = hal_read32(at(global_timer::COUNTER_HIGH));
    if (again == high) {
      *Xtime_Global = static_cast<XTime>(high) << 32 | low;
      return;
    }
    high = again;
  }
}

void XTime_SetTime(XTime Xtime_Global) {
  const std::uint32_t control = hal_read32(at(global_timer::CONTROL));
  hal_write32(at(global_timer::CONTROL), control & ~global_timer::control::Timer_Enable);
  hal_write32(at(global_timer::COUNTER_LOW), static_cast<std::uint32_t>(Xtime_Global));
  hal_write32(at(global_timer::COUNTER_HIGH), static_cast<std::uint32_t>(Xtime_Global >> 32));
  hal_write32(at(global_timer::CONTROL), control | global_timer::control::Timer_Enable);
}

int usleep(unsigned int useconds) {
  wait_counts(static_cast<u64>(useconds) * COUNTS_PER_SECOND / 1'000'000);
  return 0;
}

unsigned int sleep(unsigned int seconds) {
  wait_counts(static_cast<u64>(seconds) * COUNTS_PER_SECOND);
  return 0;
}

}  // extern "C"
