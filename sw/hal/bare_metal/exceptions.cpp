// Faults: what the CPU cannot carry out is said on the console, and the program has ended. And the
// IRQ exception: its handler may run between any two instructions while IRQ is unmasked.
#include <cstdint>

#include <hal/hal.h>

#include "chip.h"
#include "memory_map.h"

namespace {

enum class Fault : std::uint32_t { undefined, prefetch, data, fiq };  // as in start.S

/// The kind of abort by status register (ARM architecture v7-A, table B3-23).
const char* reason(std::uint32_t status) {
  switch ((status >> 6 & 0x10) | (status & 0xF)) {
    case 0x01:
      return "unaligned address";
    case 0x05:
    case 0x07:
      return "nothing is mapped there";
    case 0x0D:
    case 0x0F:
      return "not permitted";
    case 0x08:
      return "bus error";
    case 0x16:
      return "bus error of an earlier write";
    default:
      return "see the status";
  }
}

constexpr std::uint32_t imprecise = 0x16;

bool has_address(std::uint32_t status) {
  return ((status >> 6 & 0x10) | (status & 0xF)) != imprecise;
}

void describe_data_abort() {
  std::uint32_t status = 0;
  std::uint32_t address = 0;
  asm volatile("mrc p15, 0, %0, c5, c0, 0" : "=r"(status));   // DFSR
  asm volatile("mrc p15, 0, %0, c6, c0, 0" : "=r"(address));  // DFAR
  chip::print((status & 1u << 11) ? "data abort: write" : "data abort: read");
  if (has_address(status)) {
    chip::print((status & 1u << 11) ? " to " : " of ");
    chip::print_hexadecimal(address);
  }
  chip::print(": ");
  const bool is_guard = (address >= CHIP_STACK_GUARD && address < CHIP_STACK_FIRST) ||
                        (address >= CHIP_SECOND_STACK_GUARD && address < CHIP_SECOND_STACK_FIRST);
  chip::print(has_address(status) && is_guard ? "stack overflow" : reason(status));
  chip::print(", status ");
  chip::print_hexadecimal(status);
}

void describe_prefetch_abort() {
  std::uint32_t status = 0;
  asm volatile("mrc p15, 0, %0, c5, c0, 1" : "=r"(status));  // IFSR
  chip::print("prefetch abort: ");
  chip::print(reason(status));
  chip::print(", status ");
  chip::print_hexadecimal(status);
}

void describe(Fault fault) {
  switch (fault) {
    case Fault::undefined:
      chip::print("undefined instruction");
      break;
    case Fault::prefetch:
      describe_prefetch_abort();
      break;
    case Fault::data:
      describe_data_abort();
      break;
    case Fault::fiq:
      chip::print("unexpected fast interrupt: nothing uses FIQ");
      break;
  }
}

bool describing = false;

}  // namespace

/// Called by the vectors. `status` is the program status of what was interrupted, `caller` its link
/// register: register accesses all happen inside the HAL, and its caller matters more.
extern "C" [[noreturn]] void chip_fault(Fault fault, std::uint32_t pc, std::uint32_t status,
                                        std::uint32_t caller) {
  if (describing) chip::end(chip::fault_exit_code);  // the description itself went wrong
  describing = true;
  constexpr std::uint32_t thumb = 1u << 5;
  chip::print("\nchip: ");
  describe(fault);
  chip::print(", pc ");
  chip::print_hexadecimal(fault == Fault::undefined && (status & thumb) ? pc + 2 : pc);
  chip::print(", lr ");
  chip::print_hexadecimal(caller);
  chip::print("\n");
  chip::end(chip::fault_exit_code);
}

namespace {

constexpr std::uint32_t irq_masked = 1u << 7;  ///< CPSR.I

/// Of each core.
struct {
  hal_interrupt_handler handler;
  void* context;
} connected[2];

std::uint32_t program_status() {
  std::uint32_t status = 0;
  asm volatile("mrs %0, cpsr" : "=r"(status));
  return status;
}

}  // namespace

extern "C" {

/// Called by the vector.
void chip_interrupt() {
  const auto& own = connected[hal_cpu_number()];
  if (own.handler != nullptr) own.handler(own.context);
}

void hal_interrupt_connect(hal_interrupt_handler new_handler, void* context) {
  const bool was_enabled = hal_interrupt_enable(false);
  connected[hal_cpu_number()] = {new_handler, context};
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
