#ifndef XTTCPS_H
#define XTTCPS_H

/* Triple timer counters: number 0 to 2 are the counters of TTC 0, 3 to 5 those of TTC 1. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>
#include <xttcps_hw.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XTTCPS_OPTION_EXTERNAL_CLK 0x00000001U
#define XTTCPS_OPTION_CLK_EDGE_NEG 0x00000002U
#define XTTCPS_OPTION_INTERVAL_MODE 0x00000004U
#define XTTCPS_OPTION_DECREMENT 0x00000008U
#define XTTCPS_OPTION_MATCH_MODE 0x00000010U
#define XTTCPS_OPTION_WAVE_DISABLE 0x00000020U
#define XTTCPS_OPTION_WAVE_POLARITY 0x00000040U

typedef void (*XTtcPs_StatusHandler)(const void* CallBackRef, u32 StatusEvent);

typedef struct {
  u16 DeviceId;
  u32 BaseAddress;
  u32 InputClockHz;
  u32 IntrId[3]; /**< for XSetupInterruptSystem: of the whole TTC */
  UINTPTR IntrParent;
} XTtcPs_Config;

typedef struct {
  XTtcPs_Config Config;
  u32 IsReady;
  XTtcPs_StatusHandler StatusHandler;
  void* StatusRef;
} XTtcPs;

typedef u16 XInterval;
typedef u16 XMatchRegValue;

/** By number or, as releases with SDT ask, by the counter's base address. Else NULL. */
XTtcPs_Config* XTtcPs_LookupConfig(UINTPTR DeviceId);
/** XST_DEVICE_IS_STARTED, and nothing is done, if the counter runs. */
s32 XTtcPs_CfgInitialize(XTtcPs* InstancePtr, XTtcPs_Config* ConfigPtr, u32 EffectiveAddr);
s32 XTtcPs_SelfTest(XTtcPs* InstancePtr);

/** `MatchIndex`: 0 to 2. */
void XTtcPs_SetMatchValue(XTtcPs* InstancePtr, u8 MatchIndex, XMatchRegValue Value);
XMatchRegValue XTtcPs_GetMatchValue(XTtcPs* InstancePtr, u8 MatchIndex);
/** The clock is divided by 2 to the power PrescalerValue + 1; not, from XTTCPS_CLK_CNTRL_PS_DISABLE
 * on. */
void XTtcPs_SetPrescaler(XTtcPs* InstancePtr, u8 PrescalerValue);
u8 XTtcPs_GetPrescaler(XTtcPs* InstancePtr);
/** Interval and prescaler for a frequency in Hz; 0xFFFF and 0xFF if none give it. */
void XTtcPs_CalcIntervalFromFreq(XTtcPs* InstancePtr, u32 Freq, XInterval* Interval, u8* Prescaler);
s32 XTtcPs_SetOptions(XTtcPs* InstancePtr, u32 Options);
u32 XTtcPs_GetOptions(XTtcPs* InstancePtr);

void XTtcPs_SetStatusHandler(XTtcPs* InstancePtr, void* CallBackRef,
                             XTtcPs_StatusHandler FuncPointer);
/** For the interrupt controller: reads, and so clears, the events, and calls the handler. */
u32 XTtcPs_InterruptHandler(XTtcPs* InstancePtr);

#define InstReadReg(InstancePtr, RegOffset) \
  Xil_In32((InstancePtr)->Config.BaseAddress + (u32)(RegOffset))
#define InstWriteReg(InstancePtr, RegOffset, Data) \
  Xil_Out32((InstancePtr)->Config.BaseAddress + (u32)(RegOffset), (u32)(Data))

#define XTtcPs_Start(InstancePtr)                      \
  InstWriteReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET, \
               InstReadReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET) & ~XTTCPS_CNT_CNTRL_DIS_MASK)
#define XTtcPs_Stop(InstancePtr)                       \
  InstWriteReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET, \
               InstReadReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET) | XTTCPS_CNT_CNTRL_DIS_MASK)
#define XTtcPs_IsStarted(InstancePtr) \
  ((InstReadReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET) & XTTCPS_CNT_CNTRL_DIS_MASK) == 0U)
/* A power manager's business, which this chip has not. */
#define XTtcPs_Release(InstancePtr) ((void)(InstancePtr), (u32)XST_SUCCESS)
#define XTtcPs_ResetCounterValue(InstancePtr)          \
  InstWriteReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET, \
               InstReadReg((InstancePtr), XTTCPS_CNT_CNTRL_OFFSET) | XTTCPS_CNT_CNTRL_RST_MASK)
#define XTtcPs_GetCounterValue(InstancePtr) \
  ((u16)InstReadReg((InstancePtr), XTTCPS_COUNT_VALUE_OFFSET))
#define XTtcPs_SetInterval(InstancePtr, Value) \
  InstWriteReg((InstancePtr), XTTCPS_INTERVAL_VAL_OFFSET, (Value))
#define XTtcPs_GetInterval(InstancePtr) \
  ((u16)InstReadReg((InstancePtr), XTTCPS_INTERVAL_VAL_OFFSET))
#define XTtcPs_EnableInterrupts(InstancePtr, InterruptMask) \
  InstWriteReg((InstancePtr), XTTCPS_IER_OFFSET,            \
               InstReadReg((InstancePtr), XTTCPS_IER_OFFSET) | (InterruptMask))
#define XTtcPs_DisableInterrupts(InstancePtr, InterruptMask) \
  InstWriteReg((InstancePtr), XTTCPS_IER_OFFSET,             \
               InstReadReg((InstancePtr), XTTCPS_IER_OFFSET) & ~(InterruptMask))
/** The read clears all events. */
#define XTtcPs_GetInterruptStatus(InstancePtr) InstReadReg((InstancePtr), XTTCPS_ISR_OFFSET)
#define XTtcPs_ClearInterruptStatus(InstancePtr, InterruptMask) \
  ((void)(InterruptMask), (void)InstReadReg((InstancePtr), XTTCPS_ISR_OFFSET))

#ifdef __cplusplus
}
#endif

#endif
