// Compares bytes between two accesses, as programs do that wait by working.
#include <hal/hal.h>

namespace {

volatile unsigned char bytes[256];

int entry() {
  hal_write32(0x4000'0000, 1);
  unsigned wrong = 0;
  for (unsigned i = 0; i < sizeof bytes; ++i) {
    if (bytes[i] != 0) ++wrong;
  }
  hal_write32(0x4000'0000, wrong);
  return static_cast<int>(wrong);
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "computing", entry,   nullptr, 0,
                                      nullptr, 0,           nullptr, 0};
}
