// Registers and barriers.
#include <hal/hal.h>

#include "device_register.h"

extern "C" {

uint32_t hal_read32(uint32_t address) {
  const uint32_t value = chip::device_register(address);
  chip::barrier();
  return value;
}

void hal_write32(uint32_t address, uint32_t value) {
  chip::barrier();
  chip::device_register(address) = value;
  chip::barrier();
}

hal_poll_result hal_poll_until_changed(uint32_t address, uint32_t previous, uint32_t,
                                       uint32_t limit) {
  hal_poll_result result{previous, 0, false};
  while (result.polls < limit && !result.changed) {
    result.value = chip::device_register(address);
    ++result.polls;
    result.changed = result.value != previous;
  }
  chip::barrier();
  return result;
}

void hal_barrier(void) {
  chip::barrier();
}

}  // extern "C"
