#ifndef XSCUGIC_H
#define XSCUGIC_H

/* The interrupt controller of the Cortex-A9 MPCore, for one CPU. */

#include <xil_exception.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XSCUGIC_MAX_NUM_INTR_INPUTS 96U

typedef void (*Xil_InterruptHandler)(void* data);

typedef struct {
  Xil_InterruptHandler Handler;
  void* CallBackRef;
} XScuGic_VectorTableEntry;

typedef struct {
  u16 DeviceId;
  UINTPTR CpuBaseAddress;
  UINTPTR DistBaseAddress;
  XScuGic_VectorTableEntry HandlerTable[XSCUGIC_MAX_NUM_INTR_INPUTS];
} XScuGic_Config;

typedef struct {
  XScuGic_Config* Config;
  u32 IsReady;
  u32 UnhandledInterrupts;
} XScuGic;

/** NULL if there is no such device. */
XScuGic_Config* XScuGic_LookupConfig(u16 DeviceId);

/** All interrupts off, priority 0xA0, to CPU 0; then controller and CPU interface on. The base
 * address is that of the configuration. */
s32 XScuGic_CfgInitialize(XScuGic* InstancePtr, XScuGic_Config* ConfigPtr, UINTPTR EffectiveAddr);

s32 XScuGic_Connect(XScuGic* InstancePtr, u32 Int_Id, Xil_InterruptHandler Handler,
                    void* CallBackRef);
void XScuGic_Disconnect(XScuGic* InstancePtr, u32 Int_Id);
void XScuGic_Enable(XScuGic* InstancePtr, u32 Int_Id);
void XScuGic_Disable(XScuGic* InstancePtr, u32 Int_Id);

/** `Trigger`: 1 level high, 3 rising edge. */
void XScuGic_SetPriorityTriggerType(XScuGic* InstancePtr, u32 Int_Id, u8 Priority, u8 Trigger);

/** For Xil_ExceptionRegisterHandler: serves one interrupt. */
void XScuGic_InterruptHandler(XScuGic* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
