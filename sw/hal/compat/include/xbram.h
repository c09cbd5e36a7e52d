#ifndef XBRAM_H
#define XBRAM_H

/* The vendor's driver of the AXI BRAM controller is for its ECC. A program that calls these
 * functions compiles, and is refused by their names when it is loaded, unless it has them itself.
 * The memory is there, by the macros of xbram_hw.h. */

#include <xbram_hw.h>
#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
#ifdef SDT
  char* Name;
  UINTPTR BaseAddress;
#else
  u16 DeviceId;
#endif
  u32 DataWidth;
  int EccPresent;
  int FaultInjectionPresent;
  int CorrectableFailingRegisters;
  int CorrectableFailingDataRegs;
  int UncorrectableFailingRegisters;
  int UncorrectableFailingDataRegs;
  int EccStatusInterruptPresent;
  int CorrectableCounterBits;
  int EccOnOffRegister;
  int EccOnOffResetValue;
  int WriteAccess;
  UINTPTR MemBaseAddress;
  UINTPTR MemHighAddress;
  UINTPTR CtrlBaseAddress;
  UINTPTR CtrlHighAddress;
} XBram_Config;

typedef struct {
  XBram_Config Config;
  u32 IsReady;
} XBram;

#ifdef SDT
XBram_Config* XBram_LookupConfig(UINTPTR BaseAddress);
#else
XBram_Config* XBram_LookupConfig(u16 DeviceId);
#endif
int XBram_CfgInitialize(XBram* InstancePtr, XBram_Config* Config, UINTPTR EffectiveAddr);
int XBram_SelfTest(XBram* InstancePtr, u8 IntMask);
void XBram_InterruptEnable(XBram* InstancePtr, u32 Mask);
void XBram_InterruptDisable(XBram* InstancePtr, u32 Mask);
void XBram_InterruptClear(XBram* InstancePtr, u32 Mask);
u32 XBram_InterruptGetEnabled(XBram* InstancePtr);
u32 XBram_InterruptGetStatus(XBram* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
