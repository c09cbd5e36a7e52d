/* Packets out and back in, one transfer each, by polling. */
#include "xaxidma.h"
#include "xdebug.h"
#include "xparameters.h"

#if defined(XPAR_UARTNS550_0_BASEADDR)
#include "xuartns550_l.h"
#endif

#define DMA_DEV_ID XPAR_AXIDMA_0_DEVICE_ID

#ifdef XPAR_PS7_DDR_0_S_AXI_BASEADDR
#define DDR_BASE_ADDR XPAR_PS7_DDR_0_S_AXI_BASEADDR
#endif
#ifndef DDR_BASE_ADDR
#define MEM_BASE_ADDR 0x01000000
#else
#define MEM_BASE_ADDR (DDR_BASE_ADDR + 0x1000000)
#endif

#define TX_BUFFER_BASE (MEM_BASE_ADDR + 0x00100000)
#define RX_BUFFER_BASE (MEM_BASE_ADDR + 0x00300000)

#define MAX_PKT_LEN 0x20
#define TEST_START_VALUE 0xC
#define NUMBER_OF_TRANSFERS 10
#define POLL_TIMEOUT_COUNTER 1000000U

#if (!defined(DEBUG))
extern void xil_printf(const char* format, ...);
#endif

int XAxiDma_SimplePollExample(u16 DeviceId);
static int CheckData(void);

XAxiDma AxiDma;

int main() {
  int Status;

  xil_printf("\r\n--- Entering main() --- \r\n");
  Status = XAxiDma_SimplePollExample(DMA_DEV_ID);
  if (Status != XST_SUCCESS) {
    xil_printf("XAxiDma_SimplePoll Example Failed\r\n");
    return XST_FAILURE;
  }
  xil_printf("Successfully ran XAxiDma_SimplePoll Example\r\n");
  xil_printf("--- Exiting main() --- \r\n");
  return XST_SUCCESS;
}

int XAxiDma_SimplePollExample(u16 DeviceId) {
  XAxiDma_Config* CfgPtr;
  int Status;
  int Tries = NUMBER_OF_TRANSFERS;
  int Index;
  u32 TimeOut = POLL_TIMEOUT_COUNTER;
  u8* TxBufferPtr;
  u8* RxBufferPtr;
  u8 Value;

  TxBufferPtr = (u8*)TX_BUFFER_BASE;
  RxBufferPtr = (u8*)RX_BUFFER_BASE;

  CfgPtr = XAxiDma_LookupConfig(DeviceId);
  if (!CfgPtr) {
    xil_printf("No config found for %d\r\n", DeviceId);
    return XST_FAILURE;
  }
  Status = XAxiDma_CfgInitialize(&AxiDma, CfgPtr);
  if (Status != XST_SUCCESS) {
    xil_printf("Initialization failed %d\r\n", Status);
    return XST_FAILURE;
  }
  if (XAxiDma_HasSg(&AxiDma)) {
    xil_printf("Device configured as SG mode \r\n");
    return XST_FAILURE;
  }
  XAxiDma_IntrDisable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DEVICE_TO_DMA);
  XAxiDma_IntrDisable(&AxiDma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DMA_TO_DEVICE);

  Value = TEST_START_VALUE;
  for (Index = 0; Index < MAX_PKT_LEN; Index++) {
    TxBufferPtr[Index] = Value;
    Value = (Value + 1) & 0xFF;
  }
  Xil_DCacheFlushRange((UINTPTR)TxBufferPtr, MAX_PKT_LEN);
  Xil_DCacheFlushRange((UINTPTR)RxBufferPtr, MAX_PKT_LEN);

  for (Index = 0; Index < Tries; Index++) {
    Status =
        XAxiDma_SimpleTransfer(&AxiDma, (UINTPTR)RxBufferPtr, MAX_PKT_LEN, XAXIDMA_DEVICE_TO_DMA);
    if (Status != XST_SUCCESS) return XST_FAILURE;
    Status =
        XAxiDma_SimpleTransfer(&AxiDma, (UINTPTR)TxBufferPtr, MAX_PKT_LEN, XAXIDMA_DMA_TO_DEVICE);
    if (Status != XST_SUCCESS) return XST_FAILURE;

    while (TimeOut) {
      if (!(XAxiDma_Busy(&AxiDma, XAXIDMA_DEVICE_TO_DMA)) &&
          !(XAxiDma_Busy(&AxiDma, XAXIDMA_DMA_TO_DEVICE))) {
        break;
      }
      TimeOut--;
      usleep(1U);
    }
    Status = CheckData();
    if (Status != XST_SUCCESS) return XST_FAILURE;
  }
  return XST_SUCCESS;
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
