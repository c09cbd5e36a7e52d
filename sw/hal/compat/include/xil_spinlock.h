#ifndef XIL_SPINLOCK_H
#define XIL_SPINLOCK_H

/* One CPU runs: nobody else waits for a lock. */

#include <xil_types.h>

#define XIL_SPINLOCK_ENABLED 0

static inline void Xil_SpinLock(void) {}
static inline void Xil_SpinUnlock(void) {}

#endif
