/* The private timer reloads itself and interrupts three times. */
#include "xil_exception.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xscugic.h"
#include "xscutimer.h"

#define TIMER_IRPT_INTR XPAR_SCUTIMER_INTR
#define TIMER_LOAD_VALUE 0x3FFF

XScuTimer TimerInstance;
XScuGic IntcInstance;
volatile int TimerExpired;

static void TimerIntrHandler(void* CallBackRef) {
  XScuTimer* TimerInstancePtr = (XScuTimer*)CallBackRef;

  if (XScuTimer_IsExpired(TimerInstancePtr)) {
    XScuTimer_ClearInterruptStatus(TimerInstancePtr);
    TimerExpired++;
    if (TimerExpired == 3) XScuTimer_DisableAutoReload(TimerInstancePtr);
  }
}

int main(void) {
  int LastTimerExpired = 0;
  XScuTimer_Config* ConfigPtr = XScuTimer_LookupConfig(XPAR_XSCUTIMER_0_DEVICE_ID);
  XScuGic_Config* IntcConfig = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);

  if (XScuTimer_CfgInitialize(&TimerInstance, ConfigPtr, ConfigPtr->BaseAddr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XScuGic_CfgInitialize(&IntcInstance, IntcConfig, IntcConfig->CpuBaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_IRQ_INT,
                               (Xil_ExceptionHandler)XScuGic_InterruptHandler, &IntcInstance);
  if (XScuGic_Connect(&IntcInstance, TIMER_IRPT_INTR, (Xil_ExceptionHandler)TimerIntrHandler,
                      (void*)&TimerInstance) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(&IntcInstance, TIMER_IRPT_INTR);
  XScuTimer_EnableInterrupt(&TimerInstance);
  Xil_ExceptionEnable();

  XScuTimer_EnableAutoReload(&TimerInstance);
  XScuTimer_LoadTimer(&TimerInstance, TIMER_LOAD_VALUE);
  XScuTimer_Start(&TimerInstance);
  while (1) {
    if (TimerExpired != LastTimerExpired) {
      LastTimerExpired = TimerExpired;
      xil_printf("expired %d\r\n", LastTimerExpired);
    }
    if (LastTimerExpired == 3) break;
  }
  XScuTimer_Stop(&TimerInstance);
  XScuGic_Disconnect(&IntcInstance, TIMER_IRPT_INTR);
  xil_printf("Successfully ran SCU Timer Interrupt Example Test\r\n");
  return XST_SUCCESS;
}
