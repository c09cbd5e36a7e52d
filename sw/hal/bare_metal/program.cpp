// From the start-up code into the program and out of it.
#include "chip.h"

#include <global_timer_registers.h>
#include <hal/hal.h>

using Constructor = void (*)();
extern "C" {
extern const Constructor chip_constructors_begin[];
extern const Constructor chip_constructors_end[];
}

namespace {

/// Semihosting (ARM's specification, 2.0): the call that ends a program under a debugger or QEMU.
constexpr std::uint32_t semihosting_exit_extended = 0x20;
constexpr std::uint32_t application_exit = 0x2'0026;

void tell_debugger(int exit_code) {
  const std::uint32_t block[] = {application_exit, static_cast<std::uint32_t>(exit_code)};
  register std::uint32_t operation asm("r0") = semihosting_exit_extended;
  register const std::uint32_t* argument asm("r1") = block;
  asm volatile("svc 0x123456" : "+r"(operation) : "r"(argument), "m"(block) : "memory", "lr");
}

/// The counter runs when a program starts, as after the vendor's boot code.
void start_global_timer() {
  chip::device_register(global_timer::base + global_timer::CONTROL) =
      global_timer::control::Timer_Enable;
}

}  // namespace

namespace chip {

void end(int exit_code) {
  asm volatile("cpsid if" ::: "memory");
  print("chip: ended with ");
  print_number(static_cast<std::uint32_t>(exit_code));
  print("\n");
  drain_console();
  tell_debugger(exit_code);
  for (;;) asm volatile("wfi");
}

}  // namespace chip

extern "C" {

/// Called by the start-up code: memory and stacks are ready.
[[noreturn]] void chip_main() {
  chip::initialise_console();
  start_global_timer();
  for (const Constructor* c = chip_constructors_begin; c != chip_constructors_end; ++c) (*c)();
  chip::print("chip: ");
  chip::print(hal_program_info.name);
  chip::print("\n");
  if (hal_program_info.abi != HAL_ABI) {
    chip::print("chip: the program was built for another version of the HAL\n");
    chip::end(chip::input_exit_code);
  }
  chip::check_options();
  // A main() gets argc 0 and argv NULL, as from the vendor's boot code.
  using Main = int (*)(int, char**);
  const auto entry =
      reinterpret_cast<Main>(reinterpret_cast<void (*)(void)>(hal_program_info.entry));
  chip::end(entry(0, nullptr));
}

// Destructors of static objects never run: a program does not leave the chip.
int __aeabi_atexit(void*, void (*)(void*), void*) {
  return 0;
}

void* __dso_handle = nullptr;

[[noreturn]] void __cxa_pure_virtual() {
  chip::print("chip: call of a pure virtual function\n");
  chip::end(chip::fault_exit_code);
}

[[noreturn]] void abort() {
  chip::print("chip: abort\n");
  chip::end(chip::fault_exit_code);
}

}  // extern "C"
