/* Core 0's program of two: it starts the other one where that would be loaded, as on the chip, and
 * reads what it left in the memory that both know. `number` and main() are in both. */
#include <hal/hal.h>

#define DEVICE 0x40000000u
#define SHARED ((volatile uint32_t*)0x08000000)

int number = 1;

int main(void) {
  *SHARED = 0;
  hal_write32(0xFFFFFFF0u, 0x02000000u);
  __asm__("sev");
  while (*SHARED == 0)
    ;
  hal_write32(DEVICE, *SHARED + (uint32_t)number);
  return 0;
}
