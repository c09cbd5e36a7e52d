#ifndef XIL_CACHE_L_H
#define XIL_CACHE_L_H

/* The two levels of the data cache, which are one here. What reaches only L1 leaves a device's
 * data in L2, which the cores share and devices do not see: for those it does nothing. */

#include <xil_cache.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline void Xil_L1DCacheFlush(void) {
  hal_barrier();
}
static inline void Xil_L1DCacheFlushRange(INTPTR adr, u32 len) {
  (void)adr, (void)len;
  hal_barrier();
}
static inline void Xil_L1DCacheFlushLine(INTPTR adr) {
  (void)adr;
  hal_barrier();
}
static inline void Xil_L1DCacheStoreLine(INTPTR adr) {
  (void)adr;
  hal_barrier();
}
static inline void Xil_L1ICacheInvalidate(void) {}
static inline void Xil_L1ICacheInvalidateRange(INTPTR adr, u32 len) {
  (void)adr, (void)len;
}

#ifdef __cplusplus
}
#endif

#endif
