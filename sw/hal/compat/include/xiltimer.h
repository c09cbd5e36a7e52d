#ifndef XILTIMER_H
#define XILTIMER_H

/* Time, waits and a tick as releases of the flow with a system device tree have them: the global
 * timer tells the time, the private timer of the core ticks. */

#include <sleep.h>
#include <xtime_l.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Parts of a second. */
typedef enum {
  XTIMER_DELAY_SEC = 1,
  XTIMER_DELAY_MSEC = 1000,
  XTIMER_DELAY_USEC = 1000000
} XTimer_DelayType;

typedef void (*XTimer_TickHandler)(void* CallBackRef, u32 StatusEvent);

/** Starts the tick, one each `delay` ms, as a whole number of ticks in a second. */
void XTimer_SetInterval(unsigned long delay);
/** `FuncPtr` is called at each tick, in the interrupt of the private timer, which this connects. */
void XTimer_SetHandler(XTimer_TickHandler FuncPtr, void* CallBackRef, u8 Priority);
void XTimer_ClearTickInterrupt(void);

#ifdef __cplusplus
}
#endif

#endif
