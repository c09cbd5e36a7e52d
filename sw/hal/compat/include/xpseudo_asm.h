#ifndef XPSEUDO_ASM_H
#define XPSEUDO_ASM_H

/* The barriers of the Cortex-A9, and its system coprocessor. */

#include <hal/hal.h>
#include <xil_types.h>
#include <xreg_cortexa9.h>

#ifndef dsb
#define dsb() hal_barrier()
#endif
#ifndef dmb
#define dmb() hal_barrier()
#endif
#ifndef isb
#define isb() ((void)0)
#endif

/** Reads MIDR (a Cortex-A9 r3p0) or MPIDR (which core it is; UG585 3.2.2). */
static inline u32 mfcp(int rn) {
  return rn == XREG_CP15_MULTI_PROC_AFFINITY ? 0x80000000U | hal_cpu_number() : 0x413FC090U;
}
static inline void mtcp(int rn, u32 v) {
  (void)rn, (void)v;
}

#endif
