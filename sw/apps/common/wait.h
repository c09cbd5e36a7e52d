#pragma once

#include <hal/hal.h>

namespace apps {

/// Sleeps until `is_over()`, which a handler makes true. IRQ is masked between the look and the
/// sleep, so that no interrupt slips in between; pending ones end the sleep all the same.
template <class Condition>
void sleep_until(Condition is_over) {
  for (bool over = false; !over;) {
    hal_interrupt_enable(false);
    over = is_over();
    if (!over) hal_wait_for_interrupt();
    hal_interrupt_enable(true);
    hal_barrier();
  }
}

}  // namespace apps
