#ifndef XTIME_L_H
#define XTIME_L_H

/* The global timer: one count every 2 CPU cycles. */

#include <xil_types.h>
#include <xparameters.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef u64 XTime;

#define COUNTS_PER_SECOND (XPAR_CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ / 2)
#define COUNTS_PER_USECOND (COUNTS_PER_SECOND / 1000000)

void XTime_GetTime(XTime* Xtime_Global);

/** Stops the counter, sets it and lets it run again. */
void XTime_SetTime(XTime Xtime_Global);

#ifdef __cplusplus
}
#endif

#endif
