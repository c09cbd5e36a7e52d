#ifndef XSCUWDT_H
#define XSCUWDT_H

/* The private watchdog of the Cortex-A9: counts down at half the CPU's clock. In watchdog mode it
 * resets the CPU at 0, in timer mode it raises interrupt 30. */

#include <xparameters.h>
#include <xscuwdt_hw.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddr;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XScuWdt_Config;

typedef struct {
  XScuWdt_Config Config;
  u32 IsReady;
  u32 IsStarted;
} XScuWdt;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XScuWdt_Config* XScuWdt_LookupConfig(UINTPTR DeviceId);
/** XST_DEVICE_IS_STARTED if the instance runs already. */
s32 XScuWdt_CfgInitialize(XScuWdt* InstancePtr, XScuWdt_Config* ConfigPtr,
                          UINTPTR EffectiveAddress);
void XScuWdt_Start(XScuWdt* InstancePtr);
void XScuWdt_Stop(XScuWdt* InstancePtr);
/** Writes and reads the load register. */
s32 XScuWdt_SelfTest(XScuWdt* InstancePtr);

static inline u32 XScuWdt_GetControlReg(const XScuWdt* InstancePtr) {
  return XScuWdt_ReadReg(InstancePtr->Config.BaseAddr, XSCUWDT_CONTROL_OFFSET);
}
static inline void XScuWdt_SetControlReg(const XScuWdt* InstancePtr, u32 ControlReg) {
  XScuWdt_WriteReg(InstancePtr->Config.BaseAddr, XSCUWDT_CONTROL_OFFSET, ControlReg);
}
static inline void XScuWdt_EnableAutoReload(const XScuWdt* InstancePtr) {
  XScuWdt_SetControlReg(InstancePtr,
                        XScuWdt_GetControlReg(InstancePtr) | XSCUWDT_CONTROL_AUTO_RELOAD_MASK);
}
static inline void XScuWdt_SetWdMode(const XScuWdt* InstancePtr) {
  XScuWdt_SetControlReg(InstancePtr,
                        XScuWdt_GetControlReg(InstancePtr) | XSCUWDT_CONTROL_WD_MODE_MASK);
}
static inline void XScuWdt_SetTimerMode(const XScuWdt* InstancePtr) {
  XScuWdt_WriteReg(InstancePtr->Config.BaseAddr, XSCUWDT_DISABLE_OFFSET, XSCUWDT_DISABLE_VALUE1);
  XScuWdt_WriteReg(InstancePtr->Config.BaseAddr, XSCUWDT_DISABLE_OFFSET, XSCUWDT_DISABLE_VALUE2);
}
/** Sets the counter, too. */
static inline void XScuWdt_LoadWdt(const XScuWdt* InstancePtr, u32 Value) {
  XScuWdt_WriteReg(InstancePtr->Config.BaseAddr, XSCUWDT_LOAD_OFFSET, Value);
}
static inline void XScuWdt_RestartWdt(const XScuWdt* InstancePtr) {
  XScuWdt_LoadWdt(InstancePtr, XScuWdt_ReadReg(InstancePtr->Config.BaseAddr, XSCUWDT_LOAD_OFFSET));
}
/** True if the watchdog was what reset the CPU last. */
static inline s32 XScuWdt_IsWdtExpired(const XScuWdt* InstancePtr) {
  const u32 status = XScuWdt_ReadReg(InstancePtr->Config.BaseAddr, XSCUWDT_RST_STS_OFFSET);
  return (status & XSCUWDT_RST_STS_RESET_FLAG_MASK) != 0U;
}
/** True if the counter was at 0 in timer mode. */
static inline s32 XScuWdt_IsTimerExpired(const XScuWdt* InstancePtr) {
  const u32 status = XScuWdt_ReadReg(InstancePtr->Config.BaseAddr, XSCUWDT_ISR_OFFSET);
  return (status & XSCUWDT_ISR_EVENT_FLAG_MASK) != 0U;
}

#ifdef __cplusplus
}
#endif

#endif
