/* More than the FIFO holds goes round the local loop; the handler says when. */
#include "xil_exception.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xscugic.h"
#include "xuartps.h"

#ifdef ONLY_UART /* the vendor's examples are for boards on which UART 1 is the only one, and number 0 */
#define UART_INT_IRQ_ID XPAR_XUARTPS_1_INTR
#else
#define UART_INT_IRQ_ID XPAR_XUARTPS_0_INTR
#endif
#define TEST_BUFFER_SIZE 100

XUartPs UartPs;
XScuGic InterruptController;
static u8 SendBuffer[TEST_BUFFER_SIZE];
static u8 RecvBuffer[TEST_BUFFER_SIZE];
volatile int TotalReceivedCount;
volatile int TotalSentCount;
int TotalErrorCount;

void Handler(void* CallBackRef, u32 Event, unsigned int EventData) {
  (void)CallBackRef;
  if (Event == XUARTPS_EVENT_SENT_DATA) TotalSentCount = EventData;
  if (Event == XUARTPS_EVENT_RECV_DATA) TotalReceivedCount = EventData;
  if (Event == XUARTPS_EVENT_RECV_TOUT) TotalReceivedCount = EventData;
  if (Event == XUARTPS_EVENT_RECV_ERROR) {
    TotalReceivedCount = EventData;
    TotalErrorCount++;
  }
}

static int SetupInterruptSystem(XScuGic* IntcInstancePtr, XUartPs* UartInstancePtr,
                                u16 UartIntrId) {
  XScuGic_Config* IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);

  if (NULL == IntcConfig) return XST_FAILURE;
  if (XScuGic_CfgInitialize(IntcInstancePtr, IntcConfig, IntcConfig->CpuBaseAddress) !=
      XST_SUCCESS) {
    return XST_FAILURE;
  }
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               IntcInstancePtr);
  if (XScuGic_Connect(IntcInstancePtr, UartIntrId, (Xil_ExceptionHandler)XUartPs_InterruptHandler,
                      (void*)UartInstancePtr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(IntcInstancePtr, UartIntrId);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

int main(void) {
  XUartPs_Config* Config = XUartPs_LookupConfig(XPAR_XUARTPS_0_DEVICE_ID);
  int Index;
  u32 IntrMask;

  if (NULL == Config) return XST_FAILURE;
  if (XUartPs_CfgInitialize(&UartPs, Config, Config->BaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (SetupInterruptSystem(&InterruptController, &UartPs, UART_INT_IRQ_ID) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XUartPs_SetHandler(&UartPs, (XUartPs_Handler)Handler, &UartPs);
  IntrMask = XUARTPS_IXR_TOUT | XUARTPS_IXR_PARITY | XUARTPS_IXR_FRAMING | XUARTPS_IXR_OVER |
             XUARTPS_IXR_TXEMPTY | XUARTPS_IXR_RXFULL | XUARTPS_IXR_RXOVR;
  XUartPs_SetInterruptMask(&UartPs, IntrMask);
  XUartPs_SetOperMode(&UartPs, XUARTPS_OPER_MODE_LOCAL_LOOP);
  XUartPs_SetRecvTimeout(&UartPs, 8);
  for (Index = 0; Index < TEST_BUFFER_SIZE; Index++) SendBuffer[Index] = (Index % 26) + 'A';
  XUartPs_Recv(&UartPs, RecvBuffer, TEST_BUFFER_SIZE);
  XUartPs_Send(&UartPs, SendBuffer, TEST_BUFFER_SIZE);
  while (1) {
    if ((TotalSentCount == TEST_BUFFER_SIZE) && (TotalReceivedCount == TEST_BUFFER_SIZE)) break;
  }
  for (Index = 0; Index < TEST_BUFFER_SIZE; Index++) {
    if (RecvBuffer[Index] != SendBuffer[Index]) return XST_FAILURE;
  }
  XUartPs_SetOperMode(&UartPs, XUARTPS_OPER_MODE_NORMAL);
  if (TotalErrorCount != 0) return XST_FAILURE;
  xil_printf("Successfully ran Uartps interrupt Example\r\n");
  return XST_SUCCESS;
}
