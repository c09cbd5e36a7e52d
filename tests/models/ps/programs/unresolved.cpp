// Needs a function that does not exist.
#include <hal/hal.h>

extern "C" int nobody_has_this();

namespace {
int entry() {
  return nobody_has_this();
}
}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "unresolved", entry, nullptr, 0, nullptr,
                                      0,       nullptr,      0};
}
