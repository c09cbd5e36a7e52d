/* An interrupt that software raises itself. */
#include <stdio.h>
#include "xil_exception.h"
#include "xil_types.h"
#include "xparameters.h"
#include "xscugic.h"

#define INTC_DEVICE_INT_ID 0x0E

XScuGic InterruptController;
static XScuGic_Config* GicConfig;
volatile static int InterruptProcessed = FALSE;

void DeviceDriverHandler(void* CallbackRef) {
  (void)CallbackRef;
  InterruptProcessed = TRUE;
}

int main(void) {
  int Status;

  GicConfig = XScuGic_LookupConfig(XPAR_SCUGIC_0_DEVICE_ID);
  if (NULL == GicConfig) return XST_FAILURE;
  Status = XScuGic_CfgInitialize(&InterruptController, GicConfig, GicConfig->CpuBaseAddress);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Status = XScuGic_SelfTest(&InterruptController);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &InterruptController);
  Xil_ExceptionEnable();
  Status = XScuGic_Connect(&InterruptController, INTC_DEVICE_INT_ID,
                           (Xil_ExceptionHandler)DeviceDriverHandler, (void*)&InterruptController);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  XScuGic_Enable(&InterruptController, INTC_DEVICE_INT_ID);
  Status = XScuGic_SoftwareIntr(&InterruptController, INTC_DEVICE_INT_ID, XSCUGIC_SPI_CPU0_MASK);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  while (1) {
    if (InterruptProcessed) break;
  }
  xil_printf("Successfully ran GIC Example\r\n");
  return XST_SUCCESS;
}
