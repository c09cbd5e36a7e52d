#ifndef XPSEUDO_ASM_H
#define XPSEUDO_ASM_H

/* The barriers of the Cortex-A9. */

#include <hal/hal.h>
#include <xil_types.h>

#ifndef dsb
#define dsb() hal_barrier()
#endif
#ifndef dmb
#define dmb() hal_barrier()
#endif
#ifndef isb
#define isb() ((void)0)
#endif

#endif
