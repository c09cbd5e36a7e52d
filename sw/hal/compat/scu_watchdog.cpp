// xscuwdt.h.
#include <xscuwdt.h>

extern "C" {

XScuWdt_Config* XScuWdt_LookupConfig(UINTPTR DeviceId) {
  static XScuWdt_Config watchdog = {XPAR_XSCUWDT_0_DEVICE_ID, XPAR_XSCUWDT_0_BASEADDR,
                                    XPAR_XSCUWDT_0_INTERRUPTS, XPAR_XSCUWDT_0_INTERRUPT_PARENT};
  return DeviceId == watchdog.DeviceId || DeviceId == watchdog.BaseAddr ? &watchdog : nullptr;
}

s32 XScuWdt_CfgInitialize(XScuWdt* InstancePtr, XScuWdt_Config* ConfigPtr,
                          UINTPTR EffectiveAddress) {
  if (InstancePtr->IsStarted == XIL_COMPONENT_IS_STARTED) return XST_DEVICE_IS_STARTED;
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddr = EffectiveAddress;
  InstancePtr->IsStarted = 0;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

void XScuWdt_Start(XScuWdt* InstancePtr) {
  XScuWdt_SetControlReg(InstancePtr,
                        XScuWdt_GetControlReg(InstancePtr) | XSCUWDT_CONTROL_WD_ENABLE_MASK);
  InstancePtr->IsStarted = XIL_COMPONENT_IS_STARTED;
}

void XScuWdt_Stop(XScuWdt* InstancePtr) {
  XScuWdt_SetControlReg(InstancePtr,
                        XScuWdt_GetControlReg(InstancePtr) & ~XSCUWDT_CONTROL_WD_ENABLE_MASK);
  InstancePtr->IsStarted = 0;
}

s32 XScuWdt_SelfTest(XScuWdt* InstancePtr) {
  const UINTPTR base = InstancePtr->Config.BaseAddr;
  const u32 control = XScuWdt_GetControlReg(InstancePtr);
  const u32 load = XScuWdt_ReadReg(base, XSCUWDT_LOAD_OFFSET);
  XScuWdt_SetControlReg(InstancePtr, control & ~XSCUWDT_CONTROL_WD_ENABLE_MASK);
  XScuWdt_LoadWdt(InstancePtr, 0xA55A'A55A);
  const bool same = XScuWdt_ReadReg(base, XSCUWDT_LOAD_OFFSET) == 0xA55A'A55A;
  XScuWdt_LoadWdt(InstancePtr, load);
  XScuWdt_SetControlReg(InstancePtr, control);
  return same ? XST_SUCCESS : XST_FAILURE;
}

}  // extern "C"
