/* Whole caches and translation tables: what the platform has not. */
#include "xil_cache.h"

int main(void) {
  Xil_DCacheDisable();
  return 0;
}
