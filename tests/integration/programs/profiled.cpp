// A PS program whose profile is known: work by two callers, a sleep, and two interrupts of a timer.
#include <hal/hal.h>

#include <drivers/gic.h>
#include <drivers/timers.h>
#include <gic_registers.h>

namespace {

enum Work : std::uint32_t { samples };
const char* const work[] = {"samples"};

drivers::Gic gic;
drivers::PrivateTimer timer;
volatile unsigned ticks;

void on_tick(void*) {
  timer.acknowledge();
  ++ticks;
}

[[gnu::noinline]] void compute(std::uint64_t count) {
  hal_work(samples, count);
}

[[gnu::noinline]] void filter() {
  compute(1000);
  compute(1000);
}

[[gnu::noinline]] void rest() {
  hal_interrupt_enable(false);
  const unsigned before = ticks;
  timer.start(333'333);  // 1 ms
  if (ticks == before) hal_wait_for_interrupt();
  hal_interrupt_enable(true);
}

// Its interrupt comes in the middle of the work.
[[gnu::noinline]] void interrupted() {
  timer.start(3'333);  // 10 us
  compute(2000);
  hal_barrier();
}

int run() {
  gic.initialise();
  gic.connect(gic::private_timer_id, drivers::Trigger::rising_edge, &on_tick, nullptr);
  timer.initialise({1, false, true});
  hal_interrupt_enable(true);
  filter();
  rest();
  interrupted();
  return ticks == 2 ? 0 : 1;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "profiled", run, work, 1, nullptr, 0, nullptr, 0};
