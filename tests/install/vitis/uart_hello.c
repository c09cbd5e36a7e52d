/* A greeting through the driver. */
#include "xparameters.h"
#include "xil_printf.h"
#include "xuartps.h"

XUartPs Uart_Ps;

int main(void) {
  u8 HelloWorld[] = "Hello World from the UART\r\n";
  int SentCount = 0;
  int Status;
  XUartPs_Config* Config;

  Config = XUartPs_LookupConfig(XPAR_XUARTPS_1_DEVICE_ID);
  if (NULL == Config) return XST_FAILURE;
  Status = XUartPs_CfgInitialize(&Uart_Ps, Config, Config->BaseAddress);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XUartPs_SetBaudRate(&Uart_Ps, 115200);
  while (SentCount < (int)(sizeof(HelloWorld) - 1)) {
    SentCount += XUartPs_Send(&Uart_Ps, &HelloWorld[SentCount], 1);
  }
  while (XUartPs_IsSending(&Uart_Ps)) {
  }
  return SentCount == sizeof(HelloWorld) - 1 ? XST_SUCCESS : XST_FAILURE;
}
