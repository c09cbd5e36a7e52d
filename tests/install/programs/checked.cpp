// A branch that is taken and one that is not, and a mistake where it is asked for.
#include <hal/hal.h>

namespace {

int table[4] = {1, 2, 3, 4};

int pick(unsigned index) {
  if (index > 100) {
    return -1;
  }
  return table[index % 4];
}

}  // namespace

int main() {
  int sum = 0;
  for (unsigned i = 0; i < 10; ++i) sum += pick(i);
  hal_barrier();
#ifdef BEYOND
  volatile unsigned beyond = 4;
  table[beyond] = 0;
#endif
#ifdef OVERFLOWING
  volatile int most = 0x7FFFFFFF;
  most = most + 1;
#endif
  return sum == 23 ? 0 : 1;
}
