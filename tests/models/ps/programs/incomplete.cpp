// Counts units of work, but names none.
#include <hal/hal.h>

namespace {
int entry() {
  return 0;
}
}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "incomplete", entry, nullptr, 3, nullptr,
                                      0,       nullptr,      0};
}
