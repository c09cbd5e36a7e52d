#ifndef XTIMER_CONFIG_H
#define XTIMER_CONFIG_H

/* What the flow with a system device tree writes of the timers: COUNTS_PER_SECOND, and who ticks.
 */

#include <xtime_l.h>

#define XTIMER_IS_DEFAULT_TIMER
#define XTICKTIMER_IS_SCUTIMER
#define XTICKTIMER_BASEADDRESS XPAR_XSCUTIMER_0_BASEADDR

#endif
