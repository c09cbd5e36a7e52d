// Calls a function that does not exist.
#include <hal/hal.h>

extern "C" int nobody_has_this();

namespace {

int run() {
  return nobody_has_this();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "unresolved", run, nullptr, 0, nullptr,
                                      0,       nullptr,      0};
