#ifndef XSCUTIMER_HW_H
#define XSCUTIMER_HW_H

/* The private timer: offsets and bits of registers (UG585 chapter 8). */

#include <xil_assert.h>
#include <xil_io.h>
#include <xil_types.h>

#define XSCUTIMER_LOAD_OFFSET 0x00U
#define XSCUTIMER_COUNTER_OFFSET 0x04U
#define XSCUTIMER_CONTROL_OFFSET 0x08U
#define XSCUTIMER_ISR_OFFSET 0x0CU

#define XSCUTIMER_CONTROL_PRESCALER_MASK 0x0000FF00U
#define XSCUTIMER_CONTROL_PRESCALER_SHIFT 8U
#define XSCUTIMER_CONTROL_IRQ_ENABLE_MASK 0x00000004U
#define XSCUTIMER_CONTROL_AUTO_RELOAD_MASK 0x00000002U
#define XSCUTIMER_CONTROL_ENABLE_MASK 0x00000001U
#define XSCUTIMER_ISR_EVENT_FLAG_MASK 0x00000001U

#define XScuTimer_ReadReg(BaseAddr, RegOffset) Xil_In32((BaseAddr) + (RegOffset))
#define XScuTimer_WriteReg(BaseAddr, RegOffset, Data) Xil_Out32((BaseAddr) + (RegOffset), (Data))
#define XScuTimer_GetLoadReg(BaseAddr) XScuTimer_ReadReg(BaseAddr, XSCUTIMER_LOAD_OFFSET)
#define XScuTimer_SetLoadReg(BaseAddr, Value) \
  XScuTimer_WriteReg(BaseAddr, XSCUTIMER_LOAD_OFFSET, Value)
#define XScuTimer_GetCounterReg(BaseAddr) XScuTimer_ReadReg(BaseAddr, XSCUTIMER_COUNTER_OFFSET)
#define XScuTimer_SetCounterReg(BaseAddr, Value) \
  XScuTimer_WriteReg(BaseAddr, XSCUTIMER_COUNTER_OFFSET, Value)
#define XScuTimer_GetControlReg(BaseAddr) XScuTimer_ReadReg(BaseAddr, XSCUTIMER_CONTROL_OFFSET)
#define XScuTimer_SetControlReg(BaseAddr, Value) \
  XScuTimer_WriteReg(BaseAddr, XSCUTIMER_CONTROL_OFFSET, Value)
#define XScuTimer_GetIntrReg(BaseAddr) XScuTimer_ReadReg(BaseAddr, XSCUTIMER_ISR_OFFSET)
#define XScuTimer_SetIntrReg(BaseAddr, Value) \
  XScuTimer_WriteReg(BaseAddr, XSCUTIMER_ISR_OFFSET, Value)

#endif
