// Waits for its interrupt handler in a loop without a call, then publishes how often it ran.
#include <hal/hal.h>

namespace {

volatile int interrupts;

int entry() {
  hal_interrupt_connect(
      [](void*) {
        hal_write32(0x4000'0000, 1);
        interrupts = interrupts + 1;
      },
      nullptr);
  hal_interrupt_enable(true);
  while (interrupts < 2) continue;
  const int seen = interrupts;
  hal_publish(0, &seen, sizeof seen);
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "spinning", entry,   nullptr, 0,
                                      nullptr, 0,          nullptr, 0};
}
