#ifndef XIL_MEM_H
#define XIL_MEM_H

/* Copies words, then bytes. */

#include <string.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline void Xil_MemCpy(void* dst, const void* src, u32 cnt) {
  memcpy(dst, src, cnt);
}

#ifdef __cplusplus
}
#endif

#endif
