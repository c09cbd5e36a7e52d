/* The private timer runs out twice. */
#include "xil_printf.h"
#include "xparameters.h"
#include "xscutimer.h"

#define TIMER_DEVICE_ID XPAR_XSCUTIMER_0_DEVICE_ID
#define TIMER_LOAD_VALUE 0xFF

XScuTimer Timer;

int main(void) {
  int Status;
  volatile u32 CntValue1 = 0;
  volatile u32 CntValue2 = 0;
  XScuTimer_Config* ConfigPtr;
  XScuTimer* TimerInstancePtr = &Timer;

  xil_printf("SCU Timer Polled Mode Example Test \r\n");
  ConfigPtr = XScuTimer_LookupConfig(TIMER_DEVICE_ID);
  Status = XScuTimer_CfgInitialize(TimerInstancePtr, ConfigPtr, ConfigPtr->BaseAddr);
  if (Status != XST_SUCCESS) return XST_FAILURE;
  if (XScuTimer_SelfTest(TimerInstancePtr) != XST_SUCCESS) return XST_FAILURE;
  XScuTimer_SetPrescaler(TimerInstancePtr, 3);
  if (XScuTimer_GetPrescaler(TimerInstancePtr) != 3) return XST_FAILURE;
  XScuTimer_LoadTimer(TimerInstancePtr, TIMER_LOAD_VALUE);
  CntValue1 = XScuTimer_GetCounterValue(TimerInstancePtr);
  XScuTimer_Start(TimerInstancePtr);
  CntValue2 = XScuTimer_GetCounterValue(TimerInstancePtr);
  if (CntValue1 != TIMER_LOAD_VALUE || CntValue2 >= CntValue1) return XST_FAILURE;
  while (!XScuTimer_IsExpired(TimerInstancePtr))
    ;
  XScuTimer_ClearInterruptStatus(TimerInstancePtr);
  XScuTimer_RestartTimer(TimerInstancePtr);
  while (!XScuTimer_IsExpired(TimerInstancePtr))
    ;
  XScuTimer_Stop(TimerInstancePtr);
  xil_printf("Successfully ran SCU Timer Polled Mode Example Test\r\n");
  return XST_SUCCESS;
}
