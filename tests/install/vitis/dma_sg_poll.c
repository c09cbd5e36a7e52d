/* A packet of one descriptor out and back in, by polling. */
#include "xaxidma.h"
#include "xdebug.h"
#include "xparameters.h"

#define DMA_DEV_ID XPAR_AXIDMA_0_DEVICE_ID
#define MEM_BASE_ADDR 0x01000000
#define TX_BD_SPACE_BASE (MEM_BASE_ADDR)
#define TX_BD_SPACE_HIGH (MEM_BASE_ADDR + 0x00000FFF)
#define RX_BD_SPACE_BASE (MEM_BASE_ADDR + 0x00001000)
#define RX_BD_SPACE_HIGH (MEM_BASE_ADDR + 0x00001FFF)
#define TX_BUFFER_BASE (MEM_BASE_ADDR + 0x00100000)
#define RX_BUFFER_BASE (MEM_BASE_ADDR + 0x00300000)
#define MAX_PKT_LEN 0x20
#define TEST_START_VALUE 0xC
#define POLL_TIMEOUT_COUNTER 1000000U

static int RxSetup(XAxiDma* AxiDmaInstPtr);
static int TxSetup(XAxiDma* AxiDmaInstPtr);
static int SendPacket(XAxiDma* AxiDmaInstPtr);
static int CheckData(void);
static int CheckDmaResult(XAxiDma* AxiDmaInstPtr);

XAxiDma AxiDma;
u32* Packet = (u32*)TX_BUFFER_BASE;

int main(void) {
  int Status;
  XAxiDma_Config* Config;

  xil_printf("\r\n--- Entering main() --- \r\n");
  Config = XAxiDma_LookupConfig(DMA_DEV_ID);
  if (!Config) {
    xil_printf("No config found for %d\r\n", DMA_DEV_ID);
    return XST_FAILURE;
  }
  Status = XAxiDma_CfgInitialize(&AxiDma, Config);
  if (Status != XST_SUCCESS) {
    xil_printf("Initialization failed %d\r\n", Status);
    return XST_FAILURE;
  }
  if (!XAxiDma_HasSg(&AxiDma)) {
    xil_printf("Device configured as Simple mode \r\n");
    return XST_FAILURE;
  }
  Status = TxSetup(&AxiDma);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = RxSetup(&AxiDma);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = SendPacket(&AxiDma);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = CheckDmaResult(&AxiDma);
  if (Status != XST_SUCCESS) {
    xil_printf("AXI DMA SG Polling Example Failed\r\n");
    return XST_FAILURE;
  }
  xil_printf("Successfully ran AXI DMA SG Polling Example\r\n");
  xil_printf("--- Exiting main() --- \r\n");
  return XST_SUCCESS;
}

static int RxSetup(XAxiDma* AxiDmaInstPtr) {
  XAxiDma_BdRing* RxRingPtr;
  int Delay = 0;
  int Coalesce = 1;
  int Status;
  XAxiDma_Bd BdTemplate;
  XAxiDma_Bd* BdPtr;
  XAxiDma_Bd* BdCurPtr;
  u32 BdCount;
  u32 FreeBdCount;
  UINTPTR RxBufferPtr;
  u32 Index;

  RxRingPtr = XAxiDma_GetRxRing(AxiDmaInstPtr);
  XAxiDma_BdRingIntDisable(RxRingPtr, XAXIDMA_IRQ_ALL_MASK);
  XAxiDma_BdRingSetCoalesce(RxRingPtr, Coalesce, Delay);
  BdCount = XAxiDma_BdRingCntCalc(XAXIDMA_BD_MINIMUM_ALIGNMENT,
                                  RX_BD_SPACE_HIGH - RX_BD_SPACE_BASE + 1);
  Status = XAxiDma_BdRingCreate(RxRingPtr, RX_BD_SPACE_BASE, RX_BD_SPACE_BASE,
                                XAXIDMA_BD_MINIMUM_ALIGNMENT, BdCount);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XAxiDma_BdClear(&BdTemplate);
  Status = XAxiDma_BdRingClone(RxRingPtr, &BdTemplate);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  FreeBdCount = XAxiDma_BdRingGetFreeCnt(RxRingPtr);
  Status = XAxiDma_BdRingAlloc(RxRingPtr, FreeBdCount, &BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  BdCurPtr = BdPtr;
  RxBufferPtr = RX_BUFFER_BASE;
  for (Index = 0; Index < FreeBdCount; Index++) {
    Status = XAxiDma_BdSetBufAddr(BdCurPtr, RxBufferPtr);
    if (Status != XST_SUCCESS) return XST_FAILURE;
    Status = XAxiDma_BdSetLength(BdCurPtr, MAX_PKT_LEN, RxRingPtr->MaxTransferLen);
    if (Status != XST_SUCCESS) return XST_FAILURE;
    XAxiDma_BdSetCtrl(BdCurPtr, 0);
    XAxiDma_BdSetId(BdCurPtr, RxBufferPtr);
    RxBufferPtr += MAX_PKT_LEN;
    BdCurPtr = (XAxiDma_Bd*)XAxiDma_BdRingNext(RxRingPtr, BdCurPtr);
  }
  memset((void*)RX_BUFFER_BASE, 0, MAX_PKT_LEN);
  Status = XAxiDma_BdRingToHw(RxRingPtr, FreeBdCount, BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  return XAxiDma_BdRingStart(RxRingPtr) == XST_SUCCESS ? XST_SUCCESS : XST_FAILURE;
}

static int TxSetup(XAxiDma* AxiDmaInstPtr) {
  XAxiDma_BdRing* TxRingPtr;
  XAxiDma_Bd BdTemplate;
  int Delay = 0;
  int Coalesce = 1;
  int Status;
  u32 BdCount;

  TxRingPtr = XAxiDma_GetTxRing(AxiDmaInstPtr);
  XAxiDma_BdRingIntDisable(TxRingPtr, XAXIDMA_IRQ_ALL_MASK);
  XAxiDma_BdRingSetCoalesce(TxRingPtr, Coalesce, Delay);
  BdCount = XAxiDma_BdRingCntCalc(XAXIDMA_BD_MINIMUM_ALIGNMENT,
                                  TX_BD_SPACE_HIGH - TX_BD_SPACE_BASE + 1);
  Status = XAxiDma_BdRingCreate(TxRingPtr, TX_BD_SPACE_BASE, TX_BD_SPACE_BASE,
                                XAXIDMA_BD_MINIMUM_ALIGNMENT, BdCount);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XAxiDma_BdClear(&BdTemplate);
  Status = XAxiDma_BdRingClone(TxRingPtr, &BdTemplate);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XAxiDma_BdRingStart(TxRingPtr);
  return Status == XST_SUCCESS ? XST_SUCCESS : XST_FAILURE;
}

static int SendPacket(XAxiDma* AxiDmaInstPtr) {
  XAxiDma_BdRing* TxRingPtr;
  u8* TxPacket;
  u8 Value;
  XAxiDma_Bd* BdPtr;
  int Status;
  int Index;

  TxRingPtr = XAxiDma_GetTxRing(AxiDmaInstPtr);
  TxPacket = (u8*)Packet;
  Value = TEST_START_VALUE;
  for (Index = 0; Index < MAX_PKT_LEN; Index++) {
    TxPacket[Index] = Value;
    Value = (Value + 1) & 0xFF;
  }
  Xil_DCacheFlushRange((UINTPTR)TxPacket, MAX_PKT_LEN);
  Xil_DCacheFlushRange((UINTPTR)RX_BUFFER_BASE, MAX_PKT_LEN);
  Status = XAxiDma_BdRingAlloc(TxRingPtr, 1, &BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XAxiDma_BdSetBufAddr(BdPtr, (UINTPTR)Packet);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XAxiDma_BdSetLength(BdPtr, MAX_PKT_LEN, TxRingPtr->MaxTransferLen);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XAxiDma_BdSetCtrl(BdPtr, XAXIDMA_BD_CTRL_TXEOF_MASK | XAXIDMA_BD_CTRL_TXSOF_MASK);
  XAxiDma_BdSetId(BdPtr, (UINTPTR)Packet);
  Status = XAxiDma_BdRingToHw(TxRingPtr, 1, BdPtr);
  return Status == XST_SUCCESS ? XST_SUCCESS : XST_FAILURE;
}

static int CheckData(void) {
  u8* RxPacket;
  int Index = 0;
  u8 Value;

  RxPacket = (u8*)RX_BUFFER_BASE;
  Value = TEST_START_VALUE;
  Xil_DCacheInvalidateRange((UINTPTR)RxPacket, MAX_PKT_LEN);
  for (Index = 0; Index < MAX_PKT_LEN; Index++) {
    if (RxPacket[Index] != Value) {
      xil_printf("Data error %d: %x/%x\r\n", Index, (unsigned int)RxPacket[Index],
                 (unsigned int)Value);
      return XST_FAILURE;
    }
    Value = (Value + 1) & 0xFF;
  }
  return XST_SUCCESS;
}

static int CheckDmaResult(XAxiDma* AxiDmaInstPtr) {
  XAxiDma_BdRing* TxRingPtr;
  XAxiDma_BdRing* RxRingPtr;
  XAxiDma_Bd* BdPtr;
  int ProcessedBdCount = 0;
  int FreeBdCount;
  int Status;
  u32 TimeOut = POLL_TIMEOUT_COUNTER;

  TxRingPtr = XAxiDma_GetTxRing(AxiDmaInstPtr);
  RxRingPtr = XAxiDma_GetRxRing(AxiDmaInstPtr);
  while (TimeOut) {
    if ((ProcessedBdCount = XAxiDma_BdRingFromHw(TxRingPtr, XAXIDMA_ALL_BDS, &BdPtr)) != 0) break;
    TimeOut--;
    usleep(1U);
  }
  if (!TimeOut) return XST_FAILURE;
  Status = XAxiDma_BdRingFree(TxRingPtr, ProcessedBdCount, BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  TimeOut = POLL_TIMEOUT_COUNTER;
  while (TimeOut) {
    if ((ProcessedBdCount = XAxiDma_BdRingFromHw(RxRingPtr, XAXIDMA_ALL_BDS, &BdPtr)) != 0) break;
    TimeOut--;
    usleep(1U);
  }
  if (!TimeOut) return XST_FAILURE;
  if (XAxiDma_BdGetActualLength(BdPtr, RxRingPtr->MaxTransferLen) != MAX_PKT_LEN) {
    return XST_FAILURE;
  }
  if (CheckData() != XST_SUCCESS) return XST_FAILURE;
  Status = XAxiDma_BdRingFree(RxRingPtr, ProcessedBdCount, BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  FreeBdCount = XAxiDma_BdRingGetFreeCnt(RxRingPtr);
  Status = XAxiDma_BdRingAlloc(RxRingPtr, FreeBdCount, &BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XAxiDma_BdRingToHw(RxRingPtr, FreeBdCount, BdPtr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_BdRingCheck(RxRingPtr) != XST_IS_STARTED) return XST_FAILURE;
  if (XAxiDma_Pause(AxiDmaInstPtr) != XST_SUCCESS) return XST_FAILURE;
  return XAxiDma_BdRingCheck(RxRingPtr) == XST_SUCCESS ? XST_SUCCESS : XST_FAILURE;
}
