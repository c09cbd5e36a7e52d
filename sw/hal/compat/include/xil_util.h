#ifndef XIL_UTIL_H
#define XIL_UTIL_H

/* Waiting for bits of registers, and small conversions. */

#include <xil_io.h>
#include <xil_types.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Looks at the register once a microsecond until its bits of `EventMask` are `Event`. XST_FAILURE
 * after `Timeout` looks. */
u32 Xil_WaitForEvent(UINTPTR RegAddr, u32 EventMask, u32 Event, u32 Timeout);
/** The same for any of `WaitEvents`; tells in `Events` which of `EventsMask` are set. XST_TIMEOUT.
 */
u32 Xil_WaitForEvents(UINTPTR EventsRegAddr, u32 EventsMask, u32 WaitEvents, u32 Timeout,
                      u32* Events);
/** Waits until each of `NumOfEvents` words, whose addresses follow, is not 0. */
u32 Xil_WaitForEventSet(u32 Timeout, u32 NumOfEvents, volatile u32* EventAddr, ...);
/** A hexadecimal digit. XST_FAILURE for anything else. */
u32 Xil_ConvertCharToNibble(u8 InChar, u8* Num);

#ifdef __cplusplus
}
#endif

#endif
