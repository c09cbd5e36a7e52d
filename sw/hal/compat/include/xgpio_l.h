#ifndef XGPIO_L_H
#define XGPIO_L_H

/* AXI GPIO: offsets of registers, and access to them (PG144). */

#include <xil_assert.h>
#include <xil_io.h>
#include <xil_types.h>

#define XGPIO_DATA_OFFSET 0x0
#define XGPIO_TRI_OFFSET 0x4
#define XGPIO_DATA2_OFFSET 0x8
#define XGPIO_TRI2_OFFSET 0xC
#define XGPIO_GIE_OFFSET 0x11C
#define XGPIO_ISR_OFFSET 0x120
#define XGPIO_IER_OFFSET 0x128
/** From channel 1 to channel 2. */
#define XGPIO_CHAN_OFFSET 8

#define XGPIO_IR_MASK 0x3
#define XGPIO_IR_CH1_MASK 0x1
#define XGPIO_IR_CH2_MASK 0x2
#define XGPIO_GIE_GINTR_ENABLE_MASK 0x80000000

#define XGpio_In32 Xil_In32
#define XGpio_Out32 Xil_Out32
#define XGpio_WriteReg(BaseAddress, RegOffset, Data) \
  XGpio_Out32((BaseAddress) + (RegOffset), (u32)(Data))
#define XGpio_ReadReg(BaseAddress, RegOffset) XGpio_In32((BaseAddress) + (RegOffset))

#endif
