// Built for another version of the HAL.
#include <hal/hal.h>

namespace {
int entry() {
  return 0;
}
}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI + 41, "wrong_abi", entry,   nullptr, 0,
                                      nullptr,      0,           nullptr, 0};
}
