// xinterrupt_wrap.h.
#include <xinterrupt_wrap.h>

namespace {

constexpr u32 rising_edge = 1, falling_edge = 2;  // of an IntrId

/// Shared by all code that sets up interrupts in this way. Of it only what the vendor's XScuGic has
/// at the same place is used: the functions may call the vendor's driver.
XScuGic controller = {};

bool is_controller(UINTPTR parent) {
  return parent == XPAR_XSCUGIC_0_BASEADDR;
}

bool is_ready(UINTPTR parent) {
  return is_controller(parent) && controller.IsReady == XIL_COMPONENT_IS_READY;
}

u32 number_of(u32 id) {
  return XGet_IntrId(id) + XGet_IntrOffset(id);
}

}  // namespace

extern "C" {

int XConfigInterruptCntrl(UINTPTR IntcParent) {
  if (!is_controller(IntcParent)) return XST_FAILURE;
  if (is_ready(IntcParent)) return XST_SUCCESS;
  return XScuGic_CfgInitialize(&controller, XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID), 0);
}

int XConnectToInterruptCntrl(u32 IntrId, void* IntrHandler, void* CallBackRef, UINTPTR IntcParent) {
  if (!is_ready(IntcParent)) return XST_FAILURE;
  return XScuGic_Connect(&controller, number_of(IntrId),
                         reinterpret_cast<Xil_InterruptHandler>(IntrHandler), CallBackRef);
}

int XStartInterruptCntrl(u32, UINTPTR IntcParent) {
  return is_ready(IntcParent) ? XST_SUCCESS : XST_FAILURE;
}

void XRegisterInterruptHandler(void* IntrHandler, UINTPTR IntcParent) {
  if (!is_controller(IntcParent)) return;
  Xil_ExceptionRegisterHandler(
      XIL_EXCEPTION_ID_INT,
      IntrHandler != nullptr ? reinterpret_cast<Xil_ExceptionHandler>(IntrHandler)
                             : reinterpret_cast<Xil_ExceptionHandler>(&XScuGic_InterruptHandler),
      &controller);
}

void XEnableIntrId(u32 IntrId, UINTPTR IntcParent) {
  if (is_ready(IntcParent)) XScuGic_Enable(&controller, number_of(IntrId));
}

void XDisableIntrId(u32 IntrId, UINTPTR IntcParent) {
  if (is_ready(IntcParent)) XScuGic_Disable(&controller, number_of(IntrId));
}

void XSetPriorityTriggerType(u32 IntrId, u8 Priority, UINTPTR IntcParent) {
  if (!is_ready(IntcParent)) return;
  const u32 sense = XGet_TriggerType(IntrId);
  const bool edge = sense == rising_edge || sense == falling_edge;
  XScuGic_SetPriorityTriggerType(&controller, number_of(IntrId), Priority,
                                 edge ? XINTR_IS_EDGE_TRIGGERED : XINTR_IS_LEVEL_TRIGGERED);
}

void XGetPriorityTriggerType(u32 IntrId, u8* Priority, u8* Trigger, UINTPTR IntcParent) {
  if (!is_ready(IntcParent)) return;
  XScuGic_GetPriorityTriggerType(&controller, number_of(IntrId), Priority, Trigger);
}

int XDisconnectInterruptCntrl(u32 IntrId, UINTPTR IntcParent) {
  if (!is_ready(IntcParent)) return XST_FAILURE;
  XScuGic_Disconnect(&controller, number_of(IntrId));
  return XST_SUCCESS;
}

void XStopInterruptCntrl(UINTPTR IntcParent) {
  if (is_ready(IntcParent)) XScuGic_Stop(&controller);
}

int XSetupInterruptSystem(void* DriverInstance, void* IntrHandler, u32 IntrId, UINTPTR IntcParent,
                          u16 Priority) {
  if (XConfigInterruptCntrl(IntcParent) != XST_SUCCESS) return XST_FAILURE;
  XSetPriorityTriggerType(IntrId, static_cast<u8>(Priority), IntcParent);
  if (XConnectToInterruptCntrl(IntrId, IntrHandler, DriverInstance, IntcParent) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XRegisterInterruptHandler(nullptr, IntcParent);
  XEnableIntrId(IntrId, IntcParent);
  Xil_ExceptionInit();
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

s32 XGetEncodedIntrId(u32 LegacyIntrId, u32 TriggerType, u8 IntrType, u8 IntcType, u32* IntrId) {
  constexpr u32 first[] = {32, 16, 0}, kind[] = {0, 1u << 20, 1u << 22};
  if (IntcType != XINTC_TYPE_IS_SCUGIC || IntrType > XSGI || LegacyIntrId < first[IntrType]) {
    return XST_FAILURE;
  }
  *IntrId = (LegacyIntrId - first[IntrType]) | TriggerType << 12 | kind[IntrType];
  return XST_SUCCESS;
}

s32 XTriggerSoftwareIntr(u32 IntrId, UINTPTR IntcParent, u32 Cpu_Id) {
  if (!is_ready(IntcParent)) return XST_FAILURE;
  return XScuGic_SoftwareIntr(&controller, XGet_IntrId(IntrId), Cpu_Id);
}

}  // extern "C"
