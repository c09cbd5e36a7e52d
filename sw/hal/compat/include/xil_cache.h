#ifndef XIL_CACHE_H
#define XIL_CACHE_H

/* On the chip the HAL keeps the caches on, and what would touch all of a cache is not offered
 * there: name the buffer. */

#include <hal/hal.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline void Xil_DCacheFlushRange(INTPTR adr, u32 len) {
  hal_cache_flush((const void*)adr, len);
  hal_cache_invalidate((void*)adr, len); /* as the vendor's does: cleans and invalidates */
}

static inline void Xil_DCacheInvalidateRange(INTPTR adr, u32 len) {
  hal_cache_invalidate((void*)adr, len);
}

/** One line of 32 bytes: the one that holds the address. */
static inline void Xil_DCacheFlushLine(INTPTR adr) {
  Xil_DCacheFlushRange(adr & ~(INTPTR)31, 32);
}
static inline void Xil_DCacheInvalidateLine(INTPTR adr) {
  Xil_DCacheInvalidateRange(adr & ~(INTPTR)31, 32);
}
static inline void Xil_DCacheStoreLine(INTPTR adr) {
  hal_cache_flush((const void*)(adr & ~(INTPTR)31), 32);
}

static inline void Xil_ICacheEnable(void) {}
static inline void Xil_ICacheDisable(void) {}
static inline void Xil_ICacheInvalidate(void) {}
static inline void Xil_ICacheInvalidateLine(INTPTR adr) {
  (void)adr;
}
static inline void Xil_ICacheInvalidateRange(INTPTR adr, u32 len) {
  (void)adr, (void)len;
}

#define MARKERVP_NOT_OFFERED(text) __attribute__((error(text)))
#ifndef HAL_BARE_METAL
static inline void Xil_DCacheEnable(void) {
  hal_cache_all(HAL_CACHE_ENABLE);
}
static inline void Xil_DCacheDisable(void) {
  hal_cache_all(HAL_CACHE_DISABLE);
}
static inline void Xil_DCacheFlush(void) {
  hal_cache_all(HAL_CACHE_FLUSH);
}
static inline void Xil_DCacheInvalidate(void) {
  hal_cache_all(HAL_CACHE_INVALIDATE);
}
#else
static inline void Xil_DCacheEnable(void) {}
void Xil_DCacheDisable(void) MARKERVP_NOT_OFFERED(
    "the HAL keeps the caches on: use Xil_DCacheFlushRange and "
    "Xil_DCacheInvalidateRange on your DMA buffers");
void Xil_DCacheFlush(void)
    MARKERVP_NOT_OFFERED("name the buffer: Xil_DCacheFlushRange(address, bytes)");
void Xil_DCacheInvalidate(void)
    MARKERVP_NOT_OFFERED("name the buffer: Xil_DCacheInvalidateRange(address, bytes)");
#endif

#ifdef __cplusplus
}
#endif

#endif
