/* Core 1's program of two. */
#include <hal/hal.h>

int number = 40;

int main(void) {
  *(volatile uint32_t*)0x08000000 = (uint32_t)number;
  for (;;) __asm__("wfe");
}
