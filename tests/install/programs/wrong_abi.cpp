// As if built against the HAL of another version.
#include <hal/hal.h>

namespace {

int run() {
  return 0;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI + 1, "wrong_abi", run,     nullptr, 0,
                                      nullptr,     0,           nullptr, 0};
