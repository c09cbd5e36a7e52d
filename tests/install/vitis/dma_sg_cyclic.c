/* Rings that go round by themselves: packets are sent and received again and again, until enough
 * were counted. */
#include "xaxidma.h"
#include "xdebug.h"
#include "xil_exception.h"
#include "xparameters.h"
#include "xscugic.h"

#define RX_INTR_ID XPAR_FABRIC_AXIDMA_0_S2MM_INTROUT_VEC_ID
#define TX_BD_SPACE_BASE 0x01000000
#define RX_BD_SPACE_BASE 0x01010000
#define TX_BUFFER_BASE 0x01100000
#define RX_BUFFER_BASE 0x01300000
#define MAX_PKT_LEN 0x100
#define NUMBER_OF_BDS 8
#define NUMBER_OF_ROUNDS 20

static XAxiDma AxiDma;
static XScuGic Intc;
static volatile int RxDone;
static volatile int Error;

static void RxIntrHandler(void* Callback) {
  XAxiDma_BdRing* RingPtr = (XAxiDma_BdRing*)Callback;
  XAxiDma_Bd* BdPtr;
  u32 IrqStatus = XAxiDma_BdRingGetIrq(RingPtr);

  XAxiDma_BdRingAckIrq(RingPtr, IrqStatus);
  if ((IrqStatus & XAXIDMA_IRQ_ERROR_MASK)) {
    XAxiDma_BdRingDumpRegs(RingPtr);
    Error = 1;
    return;
  }
  RxDone += XAxiDma_BdRingFromHw(RingPtr, XAXIDMA_ALL_BDS, &BdPtr);
}

static int Setup(XAxiDma_BdRing* RingPtr, UINTPTR Space, UINTPTR Buffer, int Direction) {
  XAxiDma_Bd BdTemplate;
  XAxiDma_Bd *BdPtr, *BdCurPtr;
  int Index;

  if (XAxiDma_BdRingCreate(RingPtr, Space, Space, XAXIDMA_BD_MINIMUM_ALIGNMENT, NUMBER_OF_BDS) !=
      XST_SUCCESS) {
    return XST_FAILURE;
  }
  XAxiDma_BdClear(&BdTemplate);
  if (XAxiDma_BdRingClone(RingPtr, &BdTemplate) != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_BdRingAlloc(RingPtr, NUMBER_OF_BDS, &BdPtr) != XST_SUCCESS) return XST_FAILURE;
  BdCurPtr = BdPtr;
  for (Index = 0; Index < NUMBER_OF_BDS; Index++) {
    XAxiDma_BdSetBufAddr(BdCurPtr, Buffer + Index * MAX_PKT_LEN);
    XAxiDma_BdSetLength(BdCurPtr, MAX_PKT_LEN, RingPtr->MaxTransferLen);
    XAxiDma_BdSetCtrl(BdCurPtr, Direction == XAXIDMA_DEVICE_TO_DMA
                                    ? 0
                                    : XAXIDMA_BD_CTRL_TXSOF_MASK | XAXIDMA_BD_CTRL_TXEOF_MASK);
    BdCurPtr = (XAxiDma_Bd*)XAxiDma_BdRingNext(RingPtr, BdCurPtr);
  }
  XAxiDma_BdRingEnableCyclicDMA(RingPtr);
  XAxiDma_SelectCyclicMode(&AxiDma, Direction, 1);
  if (XAxiDma_BdRingToHw(RingPtr, NUMBER_OF_BDS, BdPtr) != XST_SUCCESS) return XST_FAILURE;
  return XAxiDma_BdRingStart(RingPtr);
}

static int SetupIntrSystem(XAxiDma_BdRing* RxRingPtr) {
  XScuGic_Config* IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);

  if (XScuGic_CfgInitialize(&Intc, IntcConfig, IntcConfig->CpuBaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_SetPriorityTriggerType(&Intc, RX_INTR_ID, 0xA0, 0x3);
  if (XScuGic_Connect(&Intc, RX_INTR_ID, RxIntrHandler, RxRingPtr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(&Intc, RX_INTR_ID);
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &Intc);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

int main(void) {
  const u32 Bytes = NUMBER_OF_BDS * MAX_PKT_LEN;
  u8* Tx = (u8*)TX_BUFFER_BASE;
  u8* Rx = (u8*)RX_BUFFER_BASE;
  XAxiDma_BdRing* RxRingPtr = XAxiDma_GetRxRing(&AxiDma);
  u32 Index;

  XAxiDma_CfgInitialize(&AxiDma, XAxiDma_LookupConfig(XPAR_AXIDMA_0_DEVICE_ID));
  for (Index = 0; Index < Bytes; Index++) Tx[Index] = (u8)(Index * 7);
  Xil_DCacheFlushRange((UINTPTR)Tx, Bytes);
  Xil_DCacheFlushRange((UINTPTR)Rx, Bytes);
  if (SetupIntrSystem(RxRingPtr) != XST_SUCCESS) return XST_FAILURE;
  XAxiDma_BdRingSetCoalesce(RxRingPtr, NUMBER_OF_BDS / 2, 0);
  XAxiDma_BdRingIntEnable(RxRingPtr, XAXIDMA_IRQ_ALL_MASK);
  if (Setup(RxRingPtr, RX_BD_SPACE_BASE, RX_BUFFER_BASE, XAXIDMA_DEVICE_TO_DMA) != XST_SUCCESS ||
      Setup(XAxiDma_GetTxRing(&AxiDma), TX_BD_SPACE_BASE, TX_BUFFER_BASE, XAXIDMA_DMA_TO_DEVICE) !=
          XST_SUCCESS) {
    return XST_FAILURE;
  }
  while (RxDone < NUMBER_OF_ROUNDS * NUMBER_OF_BDS && !Error) {
    /* NOP */
  }
  XAxiDma_Reset(&AxiDma);
  if (Error) return XST_FAILURE;
  Xil_DCacheInvalidateRange((UINTPTR)Rx, Bytes);
  for (Index = 0; Index < Bytes; Index++) {
    if (Rx[Index] != (u8)(Index * 7)) return XST_FAILURE;
  }
  xil_printf("Successfully ran AXI DMA Cyclic SG Example\r\n");
  return XST_SUCCESS;
}
