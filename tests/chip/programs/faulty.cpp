// Does what the CPU refuses: the one that the build names.
#include <hal/hal.h>

#include <cstdint>

namespace {

#ifndef FAULT
#error "FAULT names the mistake"
#endif
#define TEXT_OF(name) #name
#define NAME_OF(name) TEXT_OF(name)

enum Fault {
  null_pointer,
  unmapped,
  undefined,
  jump,
  overflow,
  no_such_option,
  refused_option,       // by its name: the build sets one that is not there
  option_out_of_range,  // the build sets `level` to 2
};

const hal_option_info options[] = {{"level", "", 0, 0, 1, "a number"}};

volatile std::uint32_t sink;
volatile std::uint32_t* volatile pointer = nullptr;

std::uint32_t recurse(volatile std::uint32_t* outer) {
  volatile std::uint32_t frame[1024];
  frame[0] = *outer + 1;
  const std::uint32_t result = recurse(frame);
  return result + frame[0];
}

void make(Fault fault) {
  switch (fault) {
    case null_pointer:
      *pointer = 1;
      break;
    case unmapped:
      sink = hal_read32(0xD000'0000);
      break;
    case undefined:
      asm volatile("udf #0");
      break;
    case jump:
      reinterpret_cast<void (*)()>(0x1000'0000)();
      break;
    case overflow:
      sink = recurse(&sink);
      break;
    case no_such_option:
      sink = static_cast<std::uint32_t>(hal_option(1));
      break;
    case refused_option:
    case option_out_of_range:
      break;
  }
}

int run() {
  static const char before[] = "before\n";
  hal_console_write(before, sizeof before - 1);
  make(FAULT);
  static const char after[] = "after\n";
  hal_console_write(after, sizeof after - 1);
  return 0;
}

}  // namespace

const hal_program hal_program_info = {
    HAL_ABI, "faulty_" NAME_OF(FAULT), &run, nullptr, 0, nullptr, 0, options, 1};
