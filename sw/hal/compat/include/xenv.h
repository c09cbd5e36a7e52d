#ifndef XENV_H
#define XENV_H

/* Environment of older drivers: memory by the C library, time by the BSP. */

#include <sleep.h>
#include <string.h>
#include <xil_types.h>

#define XENV_MEM_COPY(Destination, Source, Bytes) memcpy((Destination), (Source), (Bytes))
#define XENV_MEM_FILL(Destination, Value, Bytes) memset((Destination), (Value), (Bytes))
#define XENV_USLEEP(Microseconds) usleep(Microseconds)

/* No driver needs a stamp of this kind: time comes from xtime_l.h. */
typedef int XENV_TIME_STAMP;
#define XENV_TIME_STAMP_GET(Stamp)
#define XENV_TIME_STAMP_DELTA_US(First, Second) (0)
#define XENV_TIME_STAMP_DELTA_MS(First, Second) (0)

#endif
