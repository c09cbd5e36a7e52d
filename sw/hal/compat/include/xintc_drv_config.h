#ifndef XINTC_DRV_CONFIG_H
#define XINTC_DRV_CONFIG_H

/* What the build of releases from 2024.2 on writes beside the driver of the AXI interrupt
 * controller. */

#include <xparameters.h>

/* Places of its table of handlers. */
#ifndef XPAR_INTC_MAX_NUM_INTR_INPUTS
#define XPAR_INTC_MAX_NUM_INTR_INPUTS 32
#endif
/* How many such controllers it looks after. */
#ifndef XPAR_INTC_NUM_DRV_INSTANCES
#define XPAR_INTC_NUM_DRV_INSTANCES XPAR_XINTC_NUM_INSTANCES
#endif

#endif
