// A shared object without a description.
#include <hal/hal.h>

extern "C" HAL_EXPORT int run() {
  return 0;
}
