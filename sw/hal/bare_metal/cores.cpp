// The second core, and what two cores have between them.
#include <hal/hal.h>

#include "chip.h"

namespace {

/// Where the boot ROM's code of the second core looks for its entry (UG585 6.1.10).
constexpr std::uint32_t start_address = 0xFFFF'FFF0;

void (*second_entry)(void) = nullptr;

void memory_barrier() {
  asm volatile("dmb" ::: "memory");
}

[[noreturn]] void refuse_start(const char* why) {
  chip::print("chip: hal_cpu_start(): ");
  chip::print(why);
  chip::print("\n");
  chip::end(chip::fault_exit_code);
}

}  // namespace

extern "C" {

/// In the start-up code.
void chip_second_start();

/// Called by the start-up code of the second core: memory and stacks are ready.
void chip_second_main() {
  second_entry();
}

unsigned hal_cpu_number(void) {
  std::uint32_t affinity = 0;
  asm volatile("mrc p15, 0, %0, c0, c0, 5" : "=r"(affinity));  // MPIDR
  return affinity & 3;
}

void hal_cpu_start(unsigned cpu, void (*entry)(void)) {
  if (cpu != 1) refuse_start("there is no such core to start");
  if (entry == nullptr) refuse_start("the entry is null");
  if (second_entry != nullptr) refuse_start("the core was started already");
  second_entry = entry;
  chip::barrier();
  chip::device_register(start_address) = reinterpret_cast<std::uint32_t>(&chip_second_start);
  hal_send_event();
}

void hal_wait_for_event(void) {
  asm volatile("wfe" ::: "memory");
}

void hal_send_event(void) {
  asm volatile("dsb\n\tsev" ::: "memory");
}

uint32_t hal_load_acquire(const volatile uint32_t* word) {
  const std::uint32_t value = *word;
  memory_barrier();
  return value;
}

void hal_store_release(volatile uint32_t* word, uint32_t value) {
  memory_barrier();
  *word = value;
}

uint32_t hal_load_exclusive(const volatile uint32_t* word) {
  std::uint32_t value = 0;
  asm volatile("ldrex %0, [%1]\n\tdmb" : "=r"(value) : "r"(word) : "memory");
  return value;
}

bool hal_store_exclusive(volatile uint32_t* word, uint32_t value) {
  std::uint32_t failed = 1;
  asm volatile("dmb\n\tstrex %0, %2, [%1]" : "=&r"(failed) : "r"(word), "r"(value) : "memory");
  return failed == 0;
}

void hal_lock_acquire(hal_lock* lock) {
  while (true) {
    if (hal_load_exclusive(&lock->taken) != 0) {
      hal_wait_for_event();
    } else if (hal_store_exclusive(&lock->taken, 1)) {
      break;
    }
  }
  memory_barrier();
}

void hal_lock_release(hal_lock* lock) {
  hal_store_release(&lock->taken, 0);
  hal_send_event();
}

}  // extern "C"
