#ifndef XAXIDMA_H
#define XAXIDMA_H

/* AXI DMA in direct register mode (PG021). */

#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XAXIDMA_DMA_TO_DEVICE 0x00
#define XAXIDMA_DEVICE_TO_DMA 0x01

#define XAXIDMA_IRQ_IOC_MASK 0x00001000
#define XAXIDMA_IRQ_DELAY_MASK 0x00002000
#define XAXIDMA_IRQ_ERROR_MASK 0x00004000
#define XAXIDMA_IRQ_ALL_MASK 0x00007000

typedef struct {
  u32 DeviceId;
  UINTPTR BaseAddr;
  int HasMm2S;
  int HasS2Mm;
  u32 LengthWidth; /**< bits of the LENGTH register */
  u32 DataWidth;   /**< of the stream, bits */
} XAxiDma_Config;

typedef struct {
  UINTPTR RegBase;
  int HasMm2S;
  int HasS2Mm;
  u32 MaxTransferLen;
  u32 Alignment;
  int Initialized;
} XAxiDma;

/** NULL if there is no such device. */
XAxiDma_Config* XAxiDma_LookupConfig(u32 DeviceId);

/** Resets the core. XST_FAILURE if it does not leave reset. */
int XAxiDma_CfgInitialize(XAxiDma* InstancePtr, XAxiDma_Config* Config);
void XAxiDma_Reset(XAxiDma* InstancePtr);
int XAxiDma_ResetIsDone(XAxiDma* InstancePtr);

/** Starts a transfer. XST_FAILURE while one runs; XST_INVALID_PARAM if the channel, the length or
 * the address does not fit the build, or the buffer has no bus address: take it from
 * hal_dma_allocate(). */
u32 XAxiDma_SimpleTransfer(XAxiDma* InstancePtr, UINTPTR BuffAddr, u32 Length, int Direction);

/** True until the first transfer of a channel is over, and for a channel that was not built. */
u32 XAxiDma_Busy(XAxiDma* InstancePtr, int Direction);

void XAxiDma_IntrEnable(XAxiDma* InstancePtr, u32 Mask, int Direction);
void XAxiDma_IntrDisable(XAxiDma* InstancePtr, u32 Mask, int Direction);
u32 XAxiDma_IntrGetIrq(XAxiDma* InstancePtr, int Direction);
void XAxiDma_IntrAckIrq(XAxiDma* InstancePtr, u32 Mask, int Direction);

/** Scatter-gather is not built. */
static inline int XAxiDma_HasSg(const XAxiDma* InstancePtr) {
  (void)InstancePtr;
  return 0;
}

#ifdef __cplusplus
}
#endif

#endif
