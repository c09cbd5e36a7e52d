#ifndef XTMRCTR_L_H
#define XTMRCTR_L_H

/* Registers of the AXI timer (PG079). */

#include <xil_io.h>
#include <xil_types.h>

#define XTC_DEVICE_TIMER_COUNT 2
#define XTC_TIMER_COUNTER_OFFSET 16
#define XTC_TIMER_0 0
#define XTC_TIMER_1 1
#define XTC_MAX_LOAD_VALUE 0xFFFFFFFF

#define XTC_TCSR_OFFSET 0
#define XTC_TLR_OFFSET 4
#define XTC_TCR_OFFSET 8

#define XTC_CSR_CASC_MASK 0x00000800
#define XTC_CSR_ENABLE_ALL_MASK 0x00000400
#define XTC_CSR_ENABLE_PWM_MASK 0x00000200
#define XTC_CSR_INT_OCCURED_MASK 0x00000100
#define XTC_CSR_ENABLE_TMR_MASK 0x00000080
#define XTC_CSR_ENABLE_INT_MASK 0x00000040
#define XTC_CSR_LOAD_MASK 0x00000020
#define XTC_CSR_AUTO_RELOAD_MASK 0x00000010
#define XTC_CSR_EXT_CAPTURE_MASK 0x00000008
#define XTC_CSR_EXT_GENERATE_MASK 0x00000004
#define XTC_CSR_DOWN_COUNT_MASK 0x00000002
#define XTC_CSR_CAPTURE_MODE_MASK 0x00000001

#define XTmrCtr_ReadReg(BaseAddress, TmrCtrNumber, RegOffset) \
  Xil_In32((BaseAddress) + (TmrCtrNumber)*XTC_TIMER_COUNTER_OFFSET + (RegOffset))
#define XTmrCtr_WriteReg(BaseAddress, TmrCtrNumber, RegOffset, ValueToWrite) \
  Xil_Out32((BaseAddress) + (TmrCtrNumber)*XTC_TIMER_COUNTER_OFFSET + (RegOffset), (ValueToWrite))
#define XTmrCtr_SetControlStatusReg(BaseAddress, TmrCtrNumber, RegisterValue) \
  XTmrCtr_WriteReg((BaseAddress), (TmrCtrNumber), XTC_TCSR_OFFSET, (RegisterValue))
#define XTmrCtr_GetControlStatusReg(BaseAddress, TmrCtrNumber) \
  XTmrCtr_ReadReg((BaseAddress), (TmrCtrNumber), XTC_TCSR_OFFSET)
#define XTmrCtr_GetTimerCounterReg(BaseAddress, TmrCtrNumber) \
  XTmrCtr_ReadReg((BaseAddress), (TmrCtrNumber), XTC_TCR_OFFSET)
#define XTmrCtr_SetLoadReg(BaseAddress, TmrCtrNumber, RegisterValue) \
  XTmrCtr_WriteReg((BaseAddress), (TmrCtrNumber), XTC_TLR_OFFSET, (RegisterValue))
#define XTmrCtr_GetLoadReg(BaseAddress, TmrCtrNumber) \
  XTmrCtr_ReadReg((BaseAddress), (TmrCtrNumber), XTC_TLR_OFFSET)
#define XTmrCtr_Enable(BaseAddress, TmrCtrNumber) \
  XTmrCtr_SetControlStatusReg(                    \
      (BaseAddress), (TmrCtrNumber),              \
      XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) | XTC_CSR_ENABLE_TMR_MASK)
#define XTmrCtr_Disable(BaseAddress, TmrCtrNumber) \
  XTmrCtr_SetControlStatusReg(                     \
      (BaseAddress), (TmrCtrNumber),               \
      XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) & ~(u32)XTC_CSR_ENABLE_TMR_MASK)
#define XTmrCtr_EnableIntr(BaseAddress, TmrCtrNumber) \
  XTmrCtr_SetControlStatusReg(                        \
      (BaseAddress), (TmrCtrNumber),                  \
      XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) | XTC_CSR_ENABLE_INT_MASK)
#define XTmrCtr_DisableIntr(BaseAddress, TmrCtrNumber) \
  XTmrCtr_SetControlStatusReg(                         \
      (BaseAddress), (TmrCtrNumber),                   \
      XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) & ~(u32)XTC_CSR_ENABLE_INT_MASK)
/** The next write of the control register, without this bit, lets it count from there. */
#define XTmrCtr_LoadTimerCounterReg(BaseAddress, TmrCtrNumber) \
  XTmrCtr_SetControlStatusReg(                                 \
      (BaseAddress), (TmrCtrNumber),                           \
      XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) | XTC_CSR_LOAD_MASK)
#define XTmrCtr_HasEventOccurred(BaseAddress, TmrCtrNumber)                                   \
  ((XTmrCtr_GetControlStatusReg((BaseAddress), (TmrCtrNumber)) & XTC_CSR_INT_OCCURED_MASK) == \
   XTC_CSR_INT_OCCURED_MASK)

#endif
