// Reads standard input without a word to its UART, as a program may after the board's boot code, and late.
#include "sleep.h"
#include "xil_printf.h"

int main(void) {
  usleep(1000);
  return inbyte() == 'k' && inbyte() == '!' ? 0 : 1;
}
