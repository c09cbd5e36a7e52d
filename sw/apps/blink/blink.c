/* Written as for a board support package: includes and names as there, nothing of markervp. Blinks
 * an output that has no effect (the threshold field of the control packet, without wr_thresh) and
 * measures its own period with the global timer; the timer's alarm counts in an interrupt. */
#include <sleep.h>
#include <xgpio.h>
#include <xil_exception.h>
#include <xil_io.h>
#include <xil_printf.h>
#include <xparameters.h>
#include <xscugic.h>
#include <xstatus.h>
#include <xtime_l.h>

#define LED 0x0100U
#define HALF_PERIOD_US 50U
#define BLINKS 4

/* Registers of the global timer (Cortex-A9 MPCore TRM 4.4). */
#define TIMER_CONTROL (XPAR_GLOBAL_TMR_BASEADDR + 0x08U)
#define TIMER_STATUS (XPAR_GLOBAL_TMR_BASEADDR + 0x0CU)
#define TIMER_COMPARATOR_LOW (XPAR_GLOBAL_TMR_BASEADDR + 0x10U)
#define TIMER_COMPARATOR_HIGH (XPAR_GLOBAL_TMR_BASEADDR + 0x14U)
#define TIMER_ENABLE 0x1U
#define TIMER_ALARM 0x7U

static XGpio Gpio;
static XScuGic InterruptController;
static volatile u32 Alarms;

static void AlarmHandler(void* CallBackRef) {
  volatile u32* Counter = (volatile u32*)CallBackRef;
  Xil_Out32(TIMER_CONTROL, TIMER_ENABLE);
  Xil_Out32(TIMER_STATUS, 1U);
  ++*Counter;
}

static int SetUpInterrupts(void) {
  XScuGic_Config* Config = XScuGic_LookupConfig(XPAR_SCUGIC_SINGLE_DEVICE_ID);
  if (Config == NULL) return XST_FAILURE;
  if (XScuGic_CfgInitialize(&InterruptController, Config, Config->CpuBaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &InterruptController);
  if (XScuGic_Connect(&InterruptController, XPAR_GLOBAL_TMR_INTR, AlarmHandler, (void*)&Alarms) !=
      XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuGic_Enable(&InterruptController, XPAR_GLOBAL_TMR_INTR);
  Xil_ExceptionEnable();
  return XST_SUCCESS;
}

static void SetAlarm(u32 Microseconds) {
  XTime Now;
  Xil_Out32(TIMER_CONTROL, TIMER_ENABLE);
  XTime_GetTime(&Now);
  Now += (XTime)Microseconds * COUNTS_PER_SECOND / 1000000U;
  Xil_Out32(TIMER_COMPARATOR_LOW, (u32)Now);
  Xil_Out32(TIMER_COMPARATOR_HIGH, (u32)(Now >> 32));
  Xil_Out32(TIMER_CONTROL, TIMER_ALARM);
}

static void Blink(int Number) {
  XTime Start;
  XTime End;
  XTime_GetTime(&Start);
  XGpio_DiscreteWrite(&Gpio, 1, LED);
  usleep(HALF_PERIOD_US);
  XGpio_DiscreteWrite(&Gpio, 1, 0);
  usleep(HALF_PERIOD_US);
  XTime_GetTime(&End);
  const u32 Microseconds = (u32)((End - Start) * 1000000U / COUNTS_PER_SECOND);
  xil_printf("blink %d: %s\r\n", Number,
             Microseconds >= 2U * HALF_PERIOD_US ? "not too fast" : "too fast");
}

int main(void) {
  if (XGpio_Initialize(&Gpio, XPAR_AXI_GPIO_0_DEVICE_ID) != XST_SUCCESS) return XST_FAILURE;
  XGpio_SetDataDirection(&Gpio, 1, 0);
  if (SetUpInterrupts() != XST_SUCCESS) return XST_FAILURE;
  SetAlarm(3U * HALF_PERIOD_US);
  for (int Number = 1; Number <= BLINKS; ++Number) Blink(Number);
  Xil_ExceptionDisable();
  Xil_ExceptionRemoveHandler(XIL_EXCEPTION_ID_INT);
  xil_printf("GPIO at %08x, alarms %u, unhandled %u\r\n", (unsigned)Gpio.BaseAddress,
             (unsigned)Alarms, (unsigned)InterruptController.UnhandledInterrupts);
  return XST_SUCCESS;
}
