/* The watchdog as a timer that interrupts, and as a watchdog that is served in time. */
#include "sleep.h"
#include "xil_exception.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xscugic.h"
#include "xscuwdt.h"

#define WDT_LOAD_VALUE 0xFF

static XScuWdt Watchdog;
static XScuGic Intc;
static volatile int HandlerCalled;

static void WdtIntrHandler(void* CallBackRef) {
  XScuWdt* WdtPtr = (XScuWdt*)CallBackRef;

  if (XScuWdt_IsTimerExpired(WdtPtr)) HandlerCalled++;
  XScuWdt_WriteReg(WdtPtr->Config.BaseAddr, XSCUWDT_ISR_OFFSET, XSCUWDT_ISR_EVENT_FLAG_MASK);
}

int main(void) {
  XScuWdt_Config* ConfigPtr = XScuWdt_LookupConfig(XPAR_SCUWDT_0_DEVICE_ID);
  XScuGic_Config* IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
  int Count;

  if (XScuWdt_CfgInitialize(&Watchdog, ConfigPtr, ConfigPtr->BaseAddr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XScuWdt_SelfTest(&Watchdog) != XST_SUCCESS) return XST_FAILURE;
  if (XScuGic_CfgInitialize(&Intc, IntcConfig, IntcConfig->CpuBaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &Intc);
  if (XScuGic_Connect(&Intc, XPAR_SCUWDT_INTR, WdtIntrHandler, &Watchdog) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(&Intc, XPAR_SCUWDT_INTR);
  Xil_ExceptionEnable();

  XScuWdt_SetTimerMode(&Watchdog);
  XScuWdt_EnableAutoReload(&Watchdog);
  XScuWdt_SetControlReg(&Watchdog,
                        XScuWdt_GetControlReg(&Watchdog) | XSCUWDT_CONTROL_IT_ENABLE_MASK);
  XScuWdt_LoadWdt(&Watchdog, WDT_LOAD_VALUE);
  XScuWdt_Start(&Watchdog);
  while (HandlerCalled < 3) {
  }
  XScuWdt_Stop(&Watchdog);
  XScuGic_Disconnect(&Intc, XPAR_SCUWDT_INTR);

  XScuWdt_SetWdMode(&Watchdog);
  XScuWdt_LoadWdt(&Watchdog, XPAR_CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ / 2000);
  XScuWdt_Start(&Watchdog);
  for (Count = 0; Count < 20; Count++) {
    usleep(500);
    XScuWdt_RestartWdt(&Watchdog);
  }
#ifdef UNSERVED
  usleep(2000);
#endif
  if (XScuWdt_IsWdtExpired(&Watchdog)) return XST_FAILURE;
  xil_printf("Successfully ran SCU WDT Example\r\n");
  return XST_SUCCESS;
}
