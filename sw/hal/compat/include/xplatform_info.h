#ifndef XPLATFORM_INFO_H
#define XPLATFORM_INFO_H

/* Which chip this is: a Zynq-7000. */

#include <hal/hal.h>
#include <xil_types.h>

#define XPLAT_ZYNQ_ULTRA_MP 0x1U
#define XPLAT_VERSAL 0x2U
#define XPLAT_versal XPLAT_VERSAL /* as 2019.1 spells it */
#define XPLAT_ZYNQ 0x4U

/** The core that asks. */
static inline u32 XGetCoreId(void) {
  return hal_cpu_number();
}
static inline u32 XGetPlatform_Info(void) {
  return XPLAT_ZYNQ;
}

#endif
