#ifndef XIL_UTIL_H
#define XIL_UTIL_H

/* Waiting for bits of registers, and small conversions. */

#include <xil_io.h>
#include <xil_types.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Looks at the register once a microsecond until the bits of `EventMask` are those of `Event`.
 * XST_FAILURE after `Timeout` looks. */
u32 Xil_WaitForEvent(u32 RegAddr, u32 EventMask, u32 Event, u32 Timeout);

/** The same for any of `EventsMask`; tells which in `Events`. */
u32 Xil_WaitForEvents(u32 EventsRegAddr, u32 EventsMask, u32 WaitEvents, u32* Events, u32 Timeout);

/** A hexadecimal digit. XST_FAILURE for anything else. */
u32 Xil_ConvertCharToNibble(u8 InChar, u8* Num);

#ifdef __cplusplus
}
#endif

#endif
