#ifndef XDMAPS_H
#define XDMAPS_H

/* The DMA controller of the processing system (PL330), which has no model: a program that calls
 * these functions compiles, and is refused by their names when it is loaded, unless they come from
 * VENDOR_BSP or the program itself. */

#include <xil_assert.h>
#include <xil_io.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XDMAPS_CHANNELS_PER_DEV 8

typedef struct {
  u16 DeviceId;
  u32 BaseAddress;
} XDmaPs_Config;

typedef struct {
  unsigned int EndianSwapSize;
  unsigned int DstCacheCtrl;
  unsigned int DstProtCtrl;
  unsigned int DstBurstLen;
  unsigned int DstBurstSize;
  unsigned int DstInc;
  unsigned int SrcCacheCtrl;
  unsigned int SrcProtCtrl;
  unsigned int SrcBurstLen;
  unsigned int SrcBurstSize;
  unsigned int SrcInc;
} XDmaPs_ChanCtrl;

typedef struct {
  u32 SrcAddr;
  u32 DstAddr;
  unsigned int Length;
} XDmaPs_BD;

typedef struct {
  XDmaPs_ChanCtrl ChanCtrl;
  XDmaPs_BD BD;
  void* UserDmaProg;
  int UserDmaProgLength;
  void* GeneratedDmaProg;
  int GeneratedDmaProgLength;
  int DmaStatus;
  u32 ChanFaultType;
  u32 ChanFaultPCAddr;
} XDmaPs_Cmd;

typedef void (*XDmaPsDoneHandler)(unsigned int Channel, XDmaPs_Cmd* DmaCmd, void* CallbackRef);
typedef void (*XDmaPsFaultHandler)(unsigned int Channel, XDmaPs_Cmd* DmaCmd, void* CallbackRef);

typedef struct {
  XDmaPs_Config Config;
  int IsReady;
  int CacheLength;
  XDmaPsFaultHandler FaultHandler;
  void* FaultRef;
} XDmaPs;

XDmaPs_Config* XDmaPs_LookupConfig(UINTPTR DeviceId);
int XDmaPs_CfgInitialize(XDmaPs* InstPtr, XDmaPs_Config* Config, u32 EffectiveAddr);
int XDmaPs_SelfTest(XDmaPs* InstPtr);
int XDmaPs_Start(XDmaPs* InstPtr, unsigned int Channel, XDmaPs_Cmd* Cmd, int HoldDmaProg);
int XDmaPs_IsActive(XDmaPs* InstPtr, unsigned int Channel);
int XDmaPs_GenDmaProg(XDmaPs* InstPtr, unsigned int Channel, XDmaPs_Cmd* Cmd);
int XDmaPs_FreeDmaProg(XDmaPs* InstPtr, unsigned int Channel, XDmaPs_Cmd* Cmd);
void XDmaPs_Print_DmaProg(XDmaPs_Cmd* Cmd);
int XDmaPs_ResetManager(XDmaPs* InstPtr);
int XDmaPs_ResetChannel(XDmaPs* InstPtr, unsigned int Channel);
int XDmaPs_SetDoneHandler(XDmaPs* InstPtr, unsigned Channel, XDmaPsDoneHandler DoneHandler,
                          void* CallbackRef);
int XDmaPs_SetFaultHandler(XDmaPs* InstPtr, XDmaPsFaultHandler FaultHandler, void* CallbackRef);
void XDmaPs_DoneISR_0(XDmaPs* InstPtr);
void XDmaPs_DoneISR_1(XDmaPs* InstPtr);
void XDmaPs_DoneISR_2(XDmaPs* InstPtr);
void XDmaPs_DoneISR_3(XDmaPs* InstPtr);
void XDmaPs_DoneISR_4(XDmaPs* InstPtr);
void XDmaPs_DoneISR_5(XDmaPs* InstPtr);
void XDmaPs_DoneISR_6(XDmaPs* InstPtr);
void XDmaPs_DoneISR_7(XDmaPs* InstPtr);
void XDmaPs_FaultISR(XDmaPs* InstPtr);

#ifdef __cplusplus
}
#endif

#endif
