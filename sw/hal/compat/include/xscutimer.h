#ifndef XSCUTIMER_H
#define XSCUTIMER_H

/* The private timer of the Cortex-A9: counts down at half the CPU's clock. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xscutimer_hw.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddr;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XScuTimer_Config;

typedef struct {
  XScuTimer_Config Config;
  u32 IsReady;
  u32 IsStarted;
} XScuTimer;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XScuTimer_Config* XScuTimer_LookupConfig(UINTPTR DeviceId);
/** XST_DEVICE_IS_STARTED if the instance runs already. */
s32 XScuTimer_CfgInitialize(XScuTimer* InstancePtr, XScuTimer_Config* ConfigPtr,
                            UINTPTR EffectiveAddress);
void XScuTimer_Start(XScuTimer* InstancePtr);
void XScuTimer_Stop(XScuTimer* InstancePtr);
/** `PrescalerValue` + 1 ticks are a count. */
void XScuTimer_SetPrescaler(XScuTimer* InstancePtr, u8 PrescalerValue);
u8 XScuTimer_GetPrescaler(XScuTimer* InstancePtr);
/** Writes and reads the load register. */
s32 XScuTimer_SelfTest(XScuTimer* InstancePtr);

static inline u32 XScuTimer_GetControl_(const XScuTimer* InstancePtr) {
  return XScuTimer_GetControlReg(InstancePtr->Config.BaseAddr);
}
static inline void XScuTimer_SetControl_(const XScuTimer* InstancePtr, u32 Value) {
  XScuTimer_SetControlReg(InstancePtr->Config.BaseAddr, Value);
}
static inline s32 XScuTimer_IsExpired(const XScuTimer* InstancePtr) {
  const u32 flags = XScuTimer_GetIntrReg(InstancePtr->Config.BaseAddr);
  return (flags & XSCUTIMER_ISR_EVENT_FLAG_MASK) == XSCUTIMER_ISR_EVENT_FLAG_MASK;
}
static inline void XScuTimer_LoadTimer(const XScuTimer* InstancePtr, u32 Value) {
  XScuTimer_SetLoadReg(InstancePtr->Config.BaseAddr, Value);
}
static inline void XScuTimer_RestartTimer(const XScuTimer* InstancePtr) {
  XScuTimer_LoadTimer(InstancePtr, XScuTimer_GetLoadReg(InstancePtr->Config.BaseAddr));
}
static inline u32 XScuTimer_GetCounterValue(const XScuTimer* InstancePtr) {
  return XScuTimer_GetCounterReg(InstancePtr->Config.BaseAddr);
}
static inline void XScuTimer_EnableAutoReload(const XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) | XSCUTIMER_CONTROL_AUTO_RELOAD_MASK);
}
static inline void XScuTimer_DisableAutoReload(const XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) & ~XSCUTIMER_CONTROL_AUTO_RELOAD_MASK);
}
static inline void XScuTimer_EnableInterrupt(const XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) | XSCUTIMER_CONTROL_IRQ_ENABLE_MASK);
}
static inline void XScuTimer_DisableInterrupt(const XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) & ~XSCUTIMER_CONTROL_IRQ_ENABLE_MASK);
}
static inline u32 XScuTimer_GetInterruptStatus(const XScuTimer* InstancePtr) {
  return XScuTimer_GetIntrReg(InstancePtr->Config.BaseAddr);
}
static inline void XScuTimer_ClearInterruptStatus(const XScuTimer* InstancePtr) {
  XScuTimer_SetIntrReg(InstancePtr->Config.BaseAddr, XSCUTIMER_ISR_EVENT_FLAG_MASK);
}

#ifdef __cplusplus
}
#endif

#endif
