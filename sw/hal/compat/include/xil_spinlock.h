#ifndef XIL_SPINLOCK_H
#define XIL_SPINLOCK_H

/* Only one CPU runs, so a lock is always free. */

#include <xil_types.h>

#define XIL_SPINLOCK_ENABLED 0
#define XIL_SPINLOCK()
#define XIL_SPINUNLOCK()

static inline void Xil_SpinLock(void) {}
static inline void Xil_SpinUnlock(void) {}

#endif
