#ifndef XSCUWDT_HW_H
#define XSCUWDT_HW_H

/* The private watchdog: offsets and bits of registers (UG585 chapter 8). */

#include <xil_assert.h>
#include <xil_io.h>
#include <xil_types.h>

#define XSCUWDT_LOAD_OFFSET 0x00U
#define XSCUWDT_COUNTER_OFFSET 0x04U
#define XSCUWDT_CONTROL_OFFSET 0x08U
#define XSCUWDT_ISR_OFFSET 0x0CU
#define XSCUWDT_RST_STS_OFFSET 0x10U
#define XSCUWDT_DISABLE_OFFSET 0x14U

#define XSCUWDT_CONTROL_PRESCALER_MASK 0x0000FF00U
#define XSCUWDT_CONTROL_PRESCALER_SHIFT 8U
#define XSCUWDT_CONTROL_WD_MODE_MASK 0x00000008U
#define XSCUWDT_CONTROL_IT_ENABLE_MASK 0x00000004U
#define XSCUWDT_CONTROL_AUTO_RELOAD_MASK 0x00000002U
#define XSCUWDT_CONTROL_WD_ENABLE_MASK 0x00000001U
#define XSCUWDT_ISR_EVENT_FLAG_MASK 0x00000001U
#define XSCUWDT_RST_STS_RESET_FLAG_MASK 0x00000001U
/** One after the other they take it out of watchdog mode. */
#define XSCUWDT_DISABLE_VALUE1 0x12345678U
#define XSCUWDT_DISABLE_VALUE2 0x87654321U

#define XScuWdt_ReadReg(BaseAddr, RegOffset) Xil_In32((BaseAddr) + (RegOffset))
#define XScuWdt_WriteReg(BaseAddr, RegOffset, Data) Xil_Out32((BaseAddr) + (RegOffset), (u32)(Data))

#endif
