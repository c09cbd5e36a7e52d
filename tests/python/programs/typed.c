// Reads by the C library what is typed at the UART, with instructions of the processor between.
#include <stdio.h>
#include <string.h>

#include "sleep.h"
#include "xbram.h"
#include "xil_printf.h"

int main(void) {
  char word[8], line[16];
  int number = 0;
  __asm__ volatile("DSB sy\n\tisb");
  XBram_WriteReg(0xFFFF0000, 4, 42);
  if (scanf("%d %7s", &number, word) != 2 || getchar() != '\r') return 1;
  __asm__ volatile("sev");
  __asm__ volatile("wfe"); /* its own event wakes it */
  if (fgets(line, sizeof line, stdin) == NULL) return 2;
  xil_printf("%d %s %s", number, word, line);
  return number == (int)XBram_ReadReg(0xFFFF0000, 4) && strcmp(line, "two words\n") == 0 ? 0 : 3;
}
