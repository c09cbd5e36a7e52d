#ifndef XAXIDMA_H
#define XAXIDMA_H

/* AXI DMA in direct register mode and with scatter-gather (PG021). */

#include <sleep.h>
#include <xaxidma_bd.h>
#include <xaxidma_bdring.h>
#include <xil_assert.h>
#include <xil_cache.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XAXIDMA_MICROMODE_MIN_BUF_ALIGN 0xFFF

typedef struct {
  u32 DeviceId;
  UINTPTR BaseAddr;
  int HasStsCntrlStrm;
  int HasMm2S;
  int HasMm2SDRE;
  int Mm2SDataWidth; /**< bits */
  int HasS2Mm;
  int HasS2MmDRE;
  int S2MmDataWidth; /**< bits */
  int HasSg;
  int Mm2sNumChannels;
  int S2MmNumChannels;
  int AddrWidth;
  int SgLengthWidth; /**< bits of lengths */
  u32 IntrId[2];     /**< for XSetupInterruptSystem, of MM2S before S2MM; 0xFFFF: none */
  UINTPTR IntrParent;
} XAxiDma_Config;

typedef struct {
  UINTPTR RegBase;
  int HasMm2S;
  int HasS2Mm;
  int Initialized;
  int HasSg;
  XAxiDma_BdRing TxBdRing;
  XAxiDma_BdRing RxBdRing[1];
  int TxNumChannels;
  int RxNumChannels;
} XAxiDma;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XAxiDma_Config* XAxiDma_LookupConfig(UINTPTR DeviceId);
XAxiDma_Config* XAxiDma_LookupConfigBaseAddr(UINTPTR Baseaddr);

/** Resets the core. XST_DMA_ERROR if it does not leave reset. */
int XAxiDma_CfgInitialize(XAxiDma* InstancePtr, XAxiDma_Config* Config);
void XAxiDma_Reset(XAxiDma* InstancePtr);
int XAxiDma_ResetIsDone(XAxiDma* InstancePtr);
/** XST_SUCCESS if the channels that are built are there. */
int XAxiDma_Selftest(XAxiDma* InstancePtr);

/** Starts a transfer. XST_FAILURE while one runs; XST_INVALID_PARAM if the channel, the length or
 * the address does not fit the build, or the buffer has no bus address: take it from
 * hal_dma_allocate(). */
u32 XAxiDma_SimpleTransfer(XAxiDma* InstancePtr, UINTPTR BuffAddr, u32 Length, int Direction);

/** True until the first transfer of a channel is over, and for a channel that was not built. */
u32 XAxiDma_Busy(XAxiDma* InstancePtr, int Direction);

/** With scatter-gather: what was handed over is still done, and what XAxiDma_BdRingToHw takes from
 * now on waits. Without: both channels stop. XST_NOT_SGDMA before the instance is initialised. */
int XAxiDma_Pause(XAxiDma* InstancePtr);
/** Lets them go on. XST_DMA_ERROR if a channel has no ring or does not run. */
int XAxiDma_Resume(XAxiDma* InstancePtr);
int XAxiDma_SelectKeyHole(XAxiDma* InstancePtr, int Direction, int Select);
/** Descriptors are used again and again. */
int XAxiDma_SelectCyclicMode(XAxiDma* InstancePtr, int Direction, int Select);

void XAxiDma_IntrEnable(XAxiDma* InstancePtr, u32 Mask, int Direction);
void XAxiDma_IntrDisable(XAxiDma* InstancePtr, u32 Mask, int Direction);
u32 XAxiDma_IntrGetEnabled(XAxiDma* InstancePtr, int Direction);
u32 XAxiDma_IntrGetIrq(XAxiDma* InstancePtr, int Direction);
void XAxiDma_IntrAckIrq(XAxiDma* InstancePtr, u32 Mask, int Direction);

#define XAxiDma_GetTxRing(InstancePtr) (&((InstancePtr)->TxBdRing))
#define XAxiDma_GetRxRing(InstancePtr) (&((InstancePtr)->RxBdRing[0]))
#define XAxiDma_GetRxIndexRing(InstancePtr, RingIndex) (&((InstancePtr)->RxBdRing[RingIndex]))

static inline int XAxiDma_HasSg(const XAxiDma* InstancePtr) {
  return InstancePtr->HasSg;
}

#ifdef __cplusplus
}
#endif

#endif
