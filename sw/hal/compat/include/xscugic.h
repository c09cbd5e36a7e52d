#ifndef XSCUGIC_H
#define XSCUGIC_H

/* The interrupt controller of the Cortex-A9 MPCore, for one CPU. */

#include <xil_assert.h>
#include <xil_exception.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xscugic_hw.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XSCUGIC_CPU_ID 0U

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

/** By number or, as releases with SDT ask, by base address (of the distributor). NULL if there is
 * no such device. */
XScuGic_Config* XScuGic_LookupConfig(UINTPTR DeviceId);
XScuGic_Config* XScuGic_LookupConfigBaseAddr(UINTPTR BaseAddress);

/** All interrupts off, priority 0xA0, to CPU 0; then controller and CPU interface on. The base
 * address is that of the configuration. */
s32 XScuGic_CfgInitialize(XScuGic* InstancePtr, XScuGic_Config* ConfigPtr, UINTPTR EffectiveAddr);
/** Reads the identification registers. */
s32 XScuGic_SelfTest(XScuGic* InstancePtr);
/** All interrupts off, controller off. */
void XScuGic_Stop(XScuGic* InstancePtr);

s32 XScuGic_Connect(XScuGic* InstancePtr, u32 Int_Id, Xil_InterruptHandler Handler,
                    void* CallBackRef);
void XScuGic_Disconnect(XScuGic* InstancePtr, u32 Int_Id);
void XScuGic_Enable(XScuGic* InstancePtr, u32 Int_Id);
void XScuGic_Disable(XScuGic* InstancePtr, u32 Int_Id);

/** `Trigger`: 1 level high, 3 rising edge. */
void XScuGic_SetPriorityTriggerType(XScuGic* InstancePtr, u32 Int_Id, u8 Priority, u8 Trigger);
void XScuGic_GetPriorityTriggerType(XScuGic* InstancePtr, u32 Int_Id, u8* Priority, u8* Trigger);
void XScuGic_InterruptMaptoCpu(XScuGic* InstancePtr, u8 Cpu_Id, u32 Int_Id);
void XScuGic_InterruptUnmapFromCpu(XScuGic* InstancePtr, u8 Cpu_Id, u32 Int_Id);
/** Raises interrupt 0 to 15 at the CPUs whose bits are set. */
s32 XScuGic_SoftwareIntr(XScuGic* InstancePtr, u32 Int_Id, u32 Cpu_Identifier);

/** The CPU, 0 or 1, to which XScuGic_CfgInitialize sends shared interrupts; 0 at the start. */
void XScuGic_SetCpuID(u32 CpuCoreId);
u32 XScuGic_GetCpuID(void);
/** No shared interrupt goes to this CPU any more. */
void XScuGic_UnmapAllInterruptsFromCpu(XScuGic* InstancePtr, u8 Cpu_Id);

#define XScuGic_CPUReadReg(InstancePtr, RegOffset) \
  XScuGic_ReadReg((InstancePtr)->Config->CpuBaseAddress, (RegOffset))
#define XScuGic_CPUWriteReg(InstancePtr, RegOffset, Data) \
  XScuGic_WriteReg((InstancePtr)->Config->CpuBaseAddress, (RegOffset), (Data))
#define XScuGic_DistReadReg(InstancePtr, RegOffset) \
  XScuGic_ReadReg((InstancePtr)->Config->DistBaseAddress, (RegOffset))
#define XScuGic_DistWriteReg(InstancePtr, RegOffset, Data) \
  XScuGic_WriteReg((InstancePtr)->Config->DistBaseAddress, (RegOffset), (Data))

/** For Xil_ExceptionRegisterHandler: serves one interrupt. */
void XScuGic_InterruptHandler(XScuGic* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
