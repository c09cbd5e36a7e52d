// The IRQ exception. On the chip a handler may run between any two instructions while IRQ is
// unmasked.
#include <hal/hal.h>

#include <cstdint>

namespace {

constexpr std::uint32_t irq_masked = 1u << 7;  ///< CPSR.I

hal_interrupt_handler handler = nullptr;
void* handler_context = nullptr;

std::uint32_t program_status() {
  std::uint32_t status = 0;
  asm volatile("mrs %0, cpsr" : "=r"(status));
  return status;
}

}  // namespace

extern "C" {

/// Called by the vector.
void chip_interrupt() {
  if (handler != nullptr) handler(handler_context);
}

void hal_interrupt_connect(hal_interrupt_handler new_handler, void* context) {
  const bool was_enabled = hal_interrupt_enable(false);
  handler = new_handler;
  handler_context = context;
  hal_interrupt_enable(was_enabled);
}

bool hal_interrupt_enable(bool enable) {
  const bool was_enabled = (program_status() & irq_masked) == 0;
  if (enable) {
    asm volatile("cpsie i\n\tisb" ::: "memory");
  } else {
    asm volatile("cpsid i" ::: "memory");
  }
  return was_enabled;
}

void hal_wait_for_interrupt(void) {
  asm volatile("dsb\n\twfi\n\tisb" ::: "memory");
}

}  // extern "C"
