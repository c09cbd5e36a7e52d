/* What is sent comes back: local loop. */
#include "xil_printf.h"
#include "xparameters.h"
#include "xuartps.h"

#define TEST_BUFFER_SIZE 32

XUartPs Uart_PS;
static u8 SendBuffer[TEST_BUFFER_SIZE];
static u8 RecvBuffer[TEST_BUFFER_SIZE];

int main(void) {
  int Status;
  XUartPs_Config* Config;
  unsigned int SentCount;
  unsigned int ReceivedCount;
  u16 Index;
  u32 LoopCount = 0;

  Config = XUartPs_LookupConfig(XPAR_XUARTPS_0_DEVICE_ID);
  if (NULL == Config) return XST_FAILURE;
  Status = XUartPs_CfgInitialize(&Uart_PS, Config, Config->BaseAddress);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XUartPs_SelfTest(&Uart_PS);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XUartPs_SetOperMode(&Uart_PS, XUARTPS_OPER_MODE_LOCAL_LOOP);
  for (Index = 0; Index < TEST_BUFFER_SIZE; Index++) {
    SendBuffer[Index] = '0' + Index;
    RecvBuffer[Index] = 0;
  }
  SentCount = XUartPs_Send(&Uart_PS, SendBuffer, TEST_BUFFER_SIZE);
  if (SentCount != TEST_BUFFER_SIZE) return XST_FAILURE;
  while (XUartPs_IsSending(&Uart_PS)) {
    LoopCount++;
  }
  ReceivedCount = 0;
  while (ReceivedCount < TEST_BUFFER_SIZE) {
    ReceivedCount += XUartPs_Recv(&Uart_PS, &RecvBuffer[ReceivedCount],
                                  (TEST_BUFFER_SIZE - ReceivedCount));
  }
  for (Index = 0; Index < TEST_BUFFER_SIZE; Index++) {
    if (SendBuffer[Index] != RecvBuffer[Index]) return XST_FAILURE;
  }
  XUartPs_SetOperMode(&Uart_PS, XUARTPS_OPER_MODE_NORMAL);
  xil_printf("Successfully ran Uartps polled Example\r\n");
  return LoopCount != 0 ? XST_SUCCESS : XST_FAILURE;
}
