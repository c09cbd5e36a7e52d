// xscutimer.h.
#include <private_timer_registers.h>
#include <xscutimer.h>

extern "C" {

XScuTimer_Config* XScuTimer_LookupConfig(UINTPTR DeviceId) {
  static XScuTimer_Config timer = {XPAR_XSCUTIMER_0_DEVICE_ID, XPAR_XSCUTIMER_0_BASEADDR,
                                   XPAR_XSCUTIMER_0_INTERRUPTS, XPAR_XSCUTIMER_0_INTERRUPT_PARENT};
  return DeviceId == timer.DeviceId || DeviceId == timer.BaseAddr ? &timer : nullptr;
}

s32 XScuTimer_CfgInitialize(XScuTimer* InstancePtr, XScuTimer_Config* ConfigPtr,
                            UINTPTR EffectiveAddress) {
  if (InstancePtr->IsStarted == XIL_COMPONENT_IS_STARTED) return XST_DEVICE_IS_STARTED;
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddr = EffectiveAddress;
  InstancePtr->IsStarted = 0;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

void XScuTimer_Start(XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) | private_timer::control::Enable);
  InstancePtr->IsStarted = XIL_COMPONENT_IS_STARTED;
}

void XScuTimer_Stop(XScuTimer* InstancePtr) {
  XScuTimer_SetControl_(InstancePtr,
                        XScuTimer_GetControl_(InstancePtr) & ~private_timer::control::Enable);
  InstancePtr->IsStarted = 0;
}

void XScuTimer_SetPrescaler(XScuTimer* InstancePtr, u8 PrescalerValue) {
  const u32 rest = XScuTimer_GetControl_(InstancePtr) & ~private_timer::control::Prescaler;
  XScuTimer_SetControl_(InstancePtr,
                        rest | u32{PrescalerValue} << private_timer::control::Prescaler_shift);
}

u8 XScuTimer_GetPrescaler(XScuTimer* InstancePtr) {
  return static_cast<u8>((XScuTimer_GetControl_(InstancePtr) & private_timer::control::Prescaler) >>
                         private_timer::control::Prescaler_shift);
}

s32 XScuTimer_SelfTest(XScuTimer* InstancePtr) {
  const UINTPTR base = InstancePtr->Config.BaseAddr;
  const u32 control = XScuTimer_GetControlReg(base), load = XScuTimer_GetLoadReg(base);
  XScuTimer_SetControlReg(base, 0);
  XScuTimer_SetLoadReg(base, 0xA55A'A55A);
  const bool same = XScuTimer_GetLoadReg(base) == 0xA55A'A55A;
  XScuTimer_SetLoadReg(base, load);
  XScuTimer_SetControlReg(base, control);
  return same ? XST_SUCCESS : XST_FAILURE;
}

}  // extern "C"
