/* Packets of several descriptors out and back in; interrupts are coalesced. */
#include "xaxidma.h"
#include "xdebug.h"
#include "xil_exception.h"
#include "xparameters.h"
#include "xscugic.h"

#define RX_INTR_ID XPAR_FABRIC_AXIDMA_0_S2MM_INTROUT_VEC_ID
#define TX_INTR_ID XPAR_FABRIC_AXIDMA_0_MM2S_INTROUT_VEC_ID
#define MEM_BASE_ADDR 0x01000000
#define TX_BD_SPACE_BASE (MEM_BASE_ADDR)
#define RX_BD_SPACE_BASE (MEM_BASE_ADDR + 0x00010000)
#define TX_BUFFER_BASE (MEM_BASE_ADDR + 0x00100000)
#define RX_BUFFER_BASE (MEM_BASE_ADDR + 0x00300000)
#define BD_SPACE 0x1000
#define MAX_PKT_LEN 0x100
#define NUMBER_OF_BDS_PER_PKT 12
#define NUMBER_OF_PKTS_TO_TRANSFER 11
#define NUMBER_OF_BDS_TO_TRANSFER (NUMBER_OF_PKTS_TO_TRANSFER * NUMBER_OF_BDS_PER_PKT)
#define COALESCING_COUNT NUMBER_OF_PKTS_TO_TRANSFER
#define DELAY_TIMER_COUNT 100

XAxiDma AxiDma;
static XScuGic Intc;
volatile int TxDone;
volatile int RxDone;
volatile int Error;

static void CallBack(XAxiDma_BdRing* RingPtr, volatile int* Done) {
  XAxiDma_Bd* BdPtr;
  XAxiDma_Bd* BdCurPtr;
  int BdCount;
  int Index;

  BdCount = XAxiDma_BdRingFromHw(RingPtr, XAXIDMA_ALL_BDS, &BdPtr);
  BdCurPtr = BdPtr;
  for (Index = 0; Index < BdCount; Index++) {
    if (XAxiDma_BdGetSts(BdCurPtr) & XAXIDMA_BD_STS_ALL_ERR_MASK) Error = 1;
    *Done += 1;
    BdCurPtr = (XAxiDma_Bd*)XAxiDma_BdRingNext(RingPtr, BdCurPtr);
  }
  if (XAxiDma_BdRingFree(RingPtr, BdCount, BdPtr) != XST_SUCCESS) Error = 1;
}

static void Intr(XAxiDma_BdRing* RingPtr, volatile int* Done) {
  u32 IrqStatus = XAxiDma_BdRingGetIrq(RingPtr);

  XAxiDma_BdRingAckIrq(RingPtr, IrqStatus);
  if (!(IrqStatus & XAXIDMA_IRQ_ALL_MASK)) return;
  if ((IrqStatus & XAXIDMA_IRQ_ERROR_MASK)) {
    Error = 1;
    return;
  }
  if ((IrqStatus & (XAXIDMA_IRQ_DELAY_MASK | XAXIDMA_IRQ_IOC_MASK))) CallBack(RingPtr, Done);
}

static void TxIntrHandler(void* Callback) {
  Intr((XAxiDma_BdRing*)Callback, &TxDone);
}

static void RxIntrHandler(void* Callback) {
  Intr((XAxiDma_BdRing*)Callback, &RxDone);
}

static int Setup(XAxiDma_BdRing* RingPtr, UINTPTR Space) {
  XAxiDma_Bd BdTemplate;
  u32 BdCount = XAxiDma_BdRingCntCalc(XAXIDMA_BD_MINIMUM_ALIGNMENT, 4 * BD_SPACE);

  XAxiDma_BdRingIntDisable(RingPtr, XAXIDMA_IRQ_ALL_MASK);
  if (XAxiDma_BdRingCreate(RingPtr, Space, Space, XAXIDMA_BD_MINIMUM_ALIGNMENT, BdCount) !=
      XST_SUCCESS) {
    return XST_FAILURE;
  }
  XAxiDma_BdClear(&BdTemplate);
  if (XAxiDma_BdRingClone(RingPtr, &BdTemplate) != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_BdRingSetCoalesce(RingPtr, COALESCING_COUNT, DELAY_TIMER_COUNT) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XAxiDma_BdRingIntEnable(RingPtr, XAXIDMA_IRQ_ALL_MASK);
  return XST_SUCCESS;
}

static int HandOver(XAxiDma_BdRing* RingPtr, UINTPTR Buffer) {
  XAxiDma_Bd* BdPtr;
  XAxiDma_Bd* BdCurPtr;
  int Index;

  if (XAxiDma_BdRingAlloc(RingPtr, NUMBER_OF_BDS_TO_TRANSFER, &BdPtr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  BdCurPtr = BdPtr;
  for (Index = 0; Index < NUMBER_OF_BDS_TO_TRANSFER; Index++) {
    u32 CrBits = 0;
    if (XAxiDma_BdSetBufAddr(BdCurPtr, Buffer + Index * MAX_PKT_LEN) != XST_SUCCESS ||
        XAxiDma_BdSetLength(BdCurPtr, MAX_PKT_LEN, RingPtr->MaxTransferLen) != XST_SUCCESS) {
      return XST_FAILURE;
    }
    if (Index % NUMBER_OF_BDS_PER_PKT == 0) CrBits |= XAXIDMA_BD_CTRL_TXSOF_MASK;
    if (Index % NUMBER_OF_BDS_PER_PKT == NUMBER_OF_BDS_PER_PKT - 1) {
      CrBits |= XAXIDMA_BD_CTRL_TXEOF_MASK;
    }
    XAxiDma_BdSetCtrl(BdCurPtr, RingPtr->IsRxChannel ? 0 : CrBits);
    XAxiDma_BdSetId(BdCurPtr, Buffer + Index * MAX_PKT_LEN);
    BdCurPtr = (XAxiDma_Bd*)XAxiDma_BdRingNext(RingPtr, BdCurPtr);
  }
  return XAxiDma_BdRingToHw(RingPtr, NUMBER_OF_BDS_TO_TRANSFER, BdPtr);
}

static int SetupIntrSystem(XScuGic* IntcInstancePtr, XAxiDma* AxiDmaPtr) {
  XScuGic_Config* IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);

  if (NULL == IntcConfig) return XST_FAILURE;
  if (XScuGic_CfgInitialize(IntcInstancePtr, IntcConfig, IntcConfig->CpuBaseAddress) !=
      XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_SetPriorityTriggerType(IntcInstancePtr, TX_INTR_ID, 0xA0, 0x3);
  XScuGic_SetPriorityTriggerType(IntcInstancePtr, RX_INTR_ID, 0xA0, 0x3);
  if (XScuGic_Connect(IntcInstancePtr, TX_INTR_ID, (Xil_InterruptHandler)TxIntrHandler,
                      XAxiDma_GetTxRing(AxiDmaPtr)) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XScuGic_Connect(IntcInstancePtr, RX_INTR_ID, (Xil_InterruptHandler)RxIntrHandler,
                      XAxiDma_GetRxRing(AxiDmaPtr)) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(IntcInstancePtr, TX_INTR_ID);
  XScuGic_Enable(IntcInstancePtr, RX_INTR_ID);
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               (void*)IntcInstancePtr);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

int main(void) {
  const u32 Bytes = NUMBER_OF_BDS_TO_TRANSFER * MAX_PKT_LEN;
  u8* Tx = (u8*)TX_BUFFER_BASE;
  u8* Rx = (u8*)RX_BUFFER_BASE;
  XAxiDma_Config* Config;
  u32 Index;

  xil_printf("\r\n--- Entering main() --- \r\n");
  Config = XAxiDma_LookupConfig(XPAR_AXIDMA_0_DEVICE_ID);
  if (!Config) return XST_FAILURE;
  XAxiDma_CfgInitialize(&AxiDma, Config);
  if (!XAxiDma_HasSg(&AxiDma)) {
    xil_printf("Device configured as Simple mode \r\n");
    return XST_FAILURE;
  }
  if (Setup(XAxiDma_GetTxRing(&AxiDma), TX_BD_SPACE_BASE) != XST_SUCCESS) return XST_FAILURE;
  if (Setup(XAxiDma_GetRxRing(&AxiDma), RX_BD_SPACE_BASE) != XST_SUCCESS) return XST_FAILURE;
  if (SetupIntrSystem(&Intc, &AxiDma) != XST_SUCCESS) return XST_FAILURE;

  for (Index = 0; Index < Bytes; Index++) Tx[Index] = (u8)(Index * 7);
  Xil_DCacheFlushRange((UINTPTR)Tx, Bytes);
  Xil_DCacheFlushRange((UINTPTR)Rx, Bytes);
  if (HandOver(XAxiDma_GetRxRing(&AxiDma), RX_BUFFER_BASE) != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_BdRingStart(XAxiDma_GetRxRing(&AxiDma)) != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_BdRingStart(XAxiDma_GetTxRing(&AxiDma)) != XST_SUCCESS) return XST_FAILURE;
  if (HandOver(XAxiDma_GetTxRing(&AxiDma), TX_BUFFER_BASE) != XST_SUCCESS) return XST_FAILURE;

  while (((TxDone < NUMBER_OF_BDS_TO_TRANSFER) || (RxDone < NUMBER_OF_BDS_TO_TRANSFER)) && !Error) {
    /* NOP */
  }
  if (Error) {
    xil_printf("Failed test transmit%s done, receive%s done\r\n", TxDone ? "" : " not",
               RxDone ? "" : " not");
    return XST_FAILURE;
  }
  Xil_DCacheInvalidateRange((UINTPTR)Rx, Bytes);
  for (Index = 0; Index < Bytes; Index++) {
    if (Rx[Index] != (u8)(Index * 7)) return XST_FAILURE;
  }
  XScuGic_Disconnect(&Intc, TX_INTR_ID);
  XScuGic_Disconnect(&Intc, RX_INTR_ID);
  xil_printf("Successfully ran AXI DMA SG interrupt Example\r\n");
  return XST_SUCCESS;
}
