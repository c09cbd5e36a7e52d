// Ends with an exit code of its own, in the middle of a line.
#include <hal/hal.h>

namespace {

int run() {
  hal_console_write("no line end", 11);
  return 7;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "failing", run, nullptr, 0, nullptr, 0, nullptr, 0};
