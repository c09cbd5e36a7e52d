#ifndef XIL_MMU_H
#define XIL_MMU_H

/* Attributes of the MMU's sections of 1 MiB. What counts here is whether the data caches hold them;
 * registers of devices and the on-chip memory are never cached. On the chip the HAL's table is
 * fixed. */

#include <hal/hal.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NORM_NONCACHE 0x11DE2U
#define STRONG_ORDERED 0xC02U
#define DEVICE_MEMORY 0xC06U
#define RESERVED 0x0U
#define NORM_WT_CACHE 0x16DEAU
#define NORM_WB_CACHE 0x15DE6U
#define SHAREABLE (1U << 16)
#define NORM_SHARED_NCACHE (NORM_NONCACHE | SHAREABLE)

/** The section's data caches hold it (ARMv7-A ARM, B3.8.2): TEX[2] set, either level's policy in C,
 * B and TEX[1:0]; else C. */
static inline bool markervp_is_cached(u32 attributes) {
  const u32 policies = (attributes & 0xCU) | (attributes & 0x3000U);
  return (attributes & 0x4000U) != 0U ? policies != 0U : (attributes & 0x8U) != 0U;
}

#ifndef HAL_BARE_METAL
static inline void Xil_SetTlbAttributes(INTPTR Addr, u32 attrib) {
  const INTPTR section = 0x100000;
  const INTPTR first = Addr & ~(section - 1);
  hal_memory_cached((const void*)first, (size_t)section, markervp_is_cached(attrib));
}
/* Whole tables do not come and go: addresses are the same with the MMU on and off. */
static inline void Xil_EnableMMU(void) {
  hal_cache_all(HAL_CACHE_ENABLE);
}
static inline void Xil_DisableMMU(void) {
  hal_cache_all(HAL_CACHE_DISABLE);
}
#else
void Xil_SetTlbAttributes(INTPTR Addr, u32 attrib)
    __attribute__((error("the HAL's table of the MMU is fixed: build with "
                         "MARKERVP_CHIP_UNCACHED_DMA=ON for uncached DMA buffers")));
#endif

#ifdef __cplusplus
}
#endif

#endif
