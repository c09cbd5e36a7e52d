// Reads standard input without a word to its UART, as a program may after the board's boot code.
#include "xil_printf.h"

int main(void) {
  return inbyte() == 'k' && inbyte() == '!' ? 0 : 1;
}
