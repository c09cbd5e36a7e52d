/* A program for a UART Lite, whose driver is not part of markervp::compat. */
#include "xuartlite.h"

int main(void) {
  XUartLite Uart;
  return XUartLite_Initialize(&Uart, 0);
}
