/* Must not compile. */
#include <xil_cache.h>

void program(void);
void program(void) {
  Xil_DCacheDisable();
}
