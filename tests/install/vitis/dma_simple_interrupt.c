/* A packet out and back in; both directions interrupt. With HURRIED as careless as it can be
 * written: it waits for one of the two flags, never clears them, and is ready for the next packet
 * only because the comparison takes its time. */
#include "xaxidma.h"
#include "xdebug.h"
#include "xil_exception.h"
#include "xil_printf.h"
#include "xil_util.h"
#include "xparameters.h"
#include "xscugic.h"

#define RX_INTR_ID XPAR_FABRIC_AXIDMA_0_S2MM_INTROUT_VEC_ID
#define TX_INTR_ID XPAR_FABRIC_AXIDMA_0_MM2S_INTROUT_VEC_ID
#define MEM_BASE_ADDR 0x01000000
#define TX_BUFFER_BASE (MEM_BASE_ADDR + 0x00100000)
#define RX_BUFFER_BASE (MEM_BASE_ADDR + 0x00300000)
#define RESET_TIMEOUT_COUNTER 10000
#define MAX_PKT_LEN 0x100
#define NUMBER_OF_TRANSFERS 10
#define POLL_TIMEOUT_COUNTER 1000000U
#define NUMBER_OF_EVENTS 1
#ifdef HURRIED
#define FILLS(Packet) ((Packet) == 0)
#define WAITS (!TxDone && !RxDone)
#define VALUE(Packet, Byte) ((u8)(Byte))
#else
#define FILLS(Packet) 1
#define WAITS (TxDone < NUMBER_OF_EVENTS || RxDone < NUMBER_OF_EVENTS)
#define VALUE(Packet, Byte) ((u8)((Byte) + (Packet)))
#endif

static XAxiDma AxiDma;
static XScuGic Intc;
volatile u32 TxDone;
volatile u32 RxDone;
volatile u32 Error;

static void Intr(u32 Direction, volatile u32* Done) {
  u32 IrqStatus;
  int TimeOut;

  IrqStatus = XAxiDma_IntrGetIrq(&AxiDma, Direction);
  XAxiDma_IntrAckIrq(&AxiDma, IrqStatus, Direction);
  if (!(IrqStatus & XAXIDMA_IRQ_ALL_MASK)) return;
  if ((IrqStatus & XAXIDMA_IRQ_ERROR_MASK)) {
    Error = 1;
    XAxiDma_Reset(&AxiDma);
    TimeOut = RESET_TIMEOUT_COUNTER;
    while (TimeOut) {
      if (XAxiDma_ResetIsDone(&AxiDma)) break;
      TimeOut -= 1;
    }
    return;
  }
  if ((IrqStatus & XAXIDMA_IRQ_IOC_MASK)) *Done += 1;
}

static void TxIntrHandler(void* Callback) {
  (void)Callback;
  Intr(XAXIDMA_DMA_TO_DEVICE, &TxDone);
}

static void RxIntrHandler(void* Callback) {
  (void)Callback;
  Intr(XAXIDMA_DEVICE_TO_DMA, &RxDone);
}

static int SetupIntrSystem(XScuGic* IntcInstancePtr, XAxiDma* AxiDmaPtr, u16 TxIntrId,
                           u16 RxIntrId) {
  int Status;
  XScuGic_Config* IntcConfig;

  IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
  if (NULL == IntcConfig) return XST_FAILURE;
  Status = XScuGic_CfgInitialize(IntcInstancePtr, IntcConfig, IntcConfig->CpuBaseAddress);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XScuGic_SetPriorityTriggerType(IntcInstancePtr, TxIntrId, 0xA0, 0x3);
  XScuGic_SetPriorityTriggerType(IntcInstancePtr, RxIntrId, 0xA0, 0x3);
  Status =
      XScuGic_Connect(IntcInstancePtr, TxIntrId, (Xil_InterruptHandler)TxIntrHandler, AxiDmaPtr);
  if (Status != XST_SUCCESS) return Status;
  Status =
      XScuGic_Connect(IntcInstancePtr, RxIntrId, (Xil_InterruptHandler)RxIntrHandler, AxiDmaPtr);
  if (Status != XST_SUCCESS) return Status;
  XScuGic_Enable(IntcInstancePtr, TxIntrId);
  XScuGic_Enable(IntcInstancePtr, RxIntrId);
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               (void*)IntcInstancePtr);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

int main(void) {
  int Status;
  XAxiDma_Config* Config;
  int Index, Byte;
  u8* TxBufferPtr = (u8*)TX_BUFFER_BASE;
  u8* RxBufferPtr = (u8*)RX_BUFFER_BASE;

  xil_printf("\r\n--- Entering main() --- \r\n");
  Config = XAxiDma_LookupConfig(XPAR_AXIDMA_0_DEVICE_ID);
  if (!Config) return XST_FAILURE;
  Status = XAxiDma_CfgInitialize(&AxiDma, Config);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  if (XAxiDma_HasSg(&AxiDma)) return XST_FAILURE;
  Status = SetupIntrSystem(&Intc, &AxiDma, TX_INTR_ID, RX_INTR_ID);
  if (Status != XST_SUCCESS) return XST_FAILURE;

  XAxiDma_IntrDisable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DMA_TO_DEVICE);
  XAxiDma_IntrDisable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DEVICE_TO_DMA);
  XAxiDma_IntrEnable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DMA_TO_DEVICE);
  XAxiDma_IntrEnable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DEVICE_TO_DMA);

  for (Index = 0; Index < NUMBER_OF_TRANSFERS; Index++) {
    if (FILLS(Index)) {
      TxDone = RxDone = Error = 0;
      for (Byte = 0; Byte < MAX_PKT_LEN; Byte++) TxBufferPtr[Byte] = VALUE(Index, Byte);
      Xil_DCacheFlushRange((UINTPTR)TxBufferPtr, MAX_PKT_LEN);
      Xil_DCacheFlushRange((UINTPTR)RxBufferPtr, MAX_PKT_LEN);
    }
    Status =
        XAxiDma_SimpleTransfer(&AxiDma, (UINTPTR)RxBufferPtr, MAX_PKT_LEN, XAXIDMA_DEVICE_TO_DMA);
    if (Status != XST_SUCCESS) return XST_FAILURE;
    Status =
        XAxiDma_SimpleTransfer(&AxiDma, (UINTPTR)TxBufferPtr, MAX_PKT_LEN, XAXIDMA_DMA_TO_DEVICE);
    if (Status != XST_SUCCESS) return XST_FAILURE;
    while (WAITS && !Error) {
      /* NOP */
    }
    if (Error) {
      xil_printf("Failed test transmit%s done, receive%s done\r\n", TxDone ? "" : " not",
                 RxDone ? "" : " not");
      return XST_FAILURE;
    }
    Xil_DCacheInvalidateRange((UINTPTR)RxBufferPtr, MAX_PKT_LEN);
    for (Byte = 0; Byte < MAX_PKT_LEN; Byte++) {
      if (RxBufferPtr[Byte] != VALUE(Index, Byte)) return XST_FAILURE;
    }
  }
  XScuGic_Disconnect(&Intc, TX_INTR_ID);
  XScuGic_Disconnect(&Intc, RX_INTR_ID);
  xil_printf("Successfully ran AXI DMA interrupt Example\r\n");
  xil_printf("--- Exiting main() --- \r\n");
  return XST_SUCCESS;
}
