/* As examples of releases from 2023.2 on are built: devices by address, interrupts by
 * XSetupInterruptSystem. A button, the timer, a UART and both channels of a DMA. */
#ifdef SDT
#include "xinterrupt_wrap.h"
#endif
#include "xaxidma.h"
#include "xgpio.h"
#include "xil_cache.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xscutimer.h"
#include "xuartps.h"

#define TX_BUFFER ((u8*)0x01100000)
#define RX_BUFFER ((u8*)0x01200000)
#define LENGTH 64

static XGpio Gpio;
static XScuTimer Timer;
static XUartPs Uart;
static XAxiDma Dma;
static u8 Sent[LENGTH], Received[LENGTH];
static volatile int Buttons, Ticks, TxDone, RxDone, UartDone;

static void GpioHandler(void* CallbackRef) {
  Buttons++;
  XGpio_InterruptClear((XGpio*)CallbackRef, XGPIO_IR_CH2_MASK);
}

static void TimerHandler(void* CallbackRef) {
  Ticks++;
  XScuTimer_ClearInterruptStatus((XScuTimer*)CallbackRef);
}

static void UartEvent(void* CallbackRef, u32 Event, unsigned int EventData) {
  (void)CallbackRef;
  if (Event == XUARTPS_EVENT_RECV_DATA) UartDone = EventData;
}

static void TxHandler(void* Callback) {
  XAxiDma_IntrAckIrq((XAxiDma*)Callback, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DMA_TO_DEVICE);
  TxDone = 1;
}

static void RxHandler(void* Callback) {
  XAxiDma_IntrAckIrq((XAxiDma*)Callback, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DEVICE_TO_DMA);
  RxDone = 1;
}

static int Button(void) {
  XGpio_Config* Config = XGpio_LookupConfig(XPAR_XGPIO_0_BASEADDR);

  if (NULL == Config || XGpio_Initialize(&Gpio, XPAR_XGPIO_0_BASEADDR) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XSetupInterruptSystem(&Gpio, &GpioHandler, Config->IntrId, Config->IntrParent,
                            XINTERRUPT_DEFAULT_PRIORITY) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XGpio_InterruptEnable(&Gpio, XGPIO_IR_CH2_MASK);
  XGpio_InterruptGlobalEnable(&Gpio);
  XGpio_SetDataDirection(&Gpio, 1, 0);
  XGpio_DiscreteWrite(&Gpio, 1, 0x10); /* a person would press it */
  while (Buttons == 0)
    ;
  XGpio_InterruptDisable(&Gpio, XGPIO_IR_CH2_MASK);
  return XDisconnectInterruptCntrl(Config->IntrId, Config->IntrParent);
}

static int Tick(void) {
  XScuTimer_Config* Config = XScuTimer_LookupConfig(XPAR_XSCUTIMER_0_BASEADDR);

  if (NULL == Config || XScuTimer_CfgInitialize(&Timer, Config, Config->BaseAddr) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XSetupInterruptSystem(&Timer, &TimerHandler, Config->IntrId, Config->IntrParent,
                            XINTERRUPT_DEFAULT_PRIORITY) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XScuTimer_EnableInterrupt(&Timer);
  XScuTimer_LoadTimer(&Timer, 1000);
  XScuTimer_Start(&Timer);
  while (Ticks == 0)
    ;
  XScuTimer_Stop(&Timer);
  return XST_SUCCESS;
}

static int Talk(void) {
  XUartPs_Config* Config = XUartPs_LookupConfig(XPAR_XUARTPS_0_BASEADDR);
  int Index;

  if (NULL == Config || XUartPs_CfgInitialize(&Uart, Config, Config->BaseAddress) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  if (XSetupInterruptSystem(&Uart, &XUartPs_InterruptHandler, Config->IntrId, Config->IntrParent,
                            XINTERRUPT_DEFAULT_PRIORITY) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XUartPs_SetHandler(&Uart, (XUartPs_Handler)UartEvent, &Uart);
  XUartPs_SetInterruptMask(&Uart, XUARTPS_IXR_RXOVR | XUARTPS_IXR_TOUT);
  XUartPs_SetOperMode(&Uart, XUARTPS_OPER_MODE_LOCAL_LOOP);
  XUartPs_SetRecvTimeout(&Uart, 8);
  for (Index = 0; Index < LENGTH; Index++) Sent[Index] = Index;
  XUartPs_Recv(&Uart, Received, LENGTH);
  XUartPs_Send(&Uart, Sent, LENGTH);
  while (UartDone != LENGTH)
    ;
  for (Index = 0; Index < LENGTH; Index++) {
    if (Received[Index] != Index) return XST_FAILURE;
  }
  return XST_SUCCESS;
}

static int Copy(void) {
  XAxiDma_Config* Config = XAxiDma_LookupConfig(XPAR_XAXIDMA_0_BASEADDR);
  int Index;

  if (NULL == Config || XAxiDma_CfgInitialize(&Dma, Config) != XST_SUCCESS) return XST_FAILURE;
  if (XSetupInterruptSystem(&Dma, &TxHandler, Config->IntrId[0], Config->IntrParent,
                            XINTERRUPT_DEFAULT_PRIORITY) != XST_SUCCESS ||
      XSetupInterruptSystem(&Dma, &RxHandler, Config->IntrId[1], Config->IntrParent,
                            XINTERRUPT_DEFAULT_PRIORITY) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XAxiDma_IntrEnable(&Dma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DMA_TO_DEVICE);
  XAxiDma_IntrEnable(&Dma, XAXIDMA_IRQ_ALL_MASK, XAXIDMA_DEVICE_TO_DMA);
  for (Index = 0; Index < LENGTH; Index++) TX_BUFFER[Index] = Index + 1;
  Xil_DCacheFlushRange((UINTPTR)TX_BUFFER, LENGTH);
  Xil_DCacheFlushRange((UINTPTR)RX_BUFFER, LENGTH);
  XAxiDma_SimpleTransfer(&Dma, (UINTPTR)RX_BUFFER, LENGTH, XAXIDMA_DEVICE_TO_DMA);
  XAxiDma_SimpleTransfer(&Dma, (UINTPTR)TX_BUFFER, LENGTH, XAXIDMA_DMA_TO_DEVICE);
  while (!TxDone || !RxDone)
    ;
  Xil_DCacheInvalidateRange((UINTPTR)RX_BUFFER, LENGTH);
  for (Index = 0; Index < LENGTH; Index++) {
    if (RX_BUFFER[Index] != Index + 1) return XST_FAILURE;
  }
  return XST_SUCCESS;
}

static volatile int Raised;
static void SoftwareHandler(void* CallbackRef) {
  (void)CallbackRef;
  Raised = 1;
}

/* Steps and refusals. */
static int Steps(void) {
  u32 Id = 0, Timer = 0;
  u8 Priority = 0, Trigger = 0;
  const UINTPTR Gic = XPAR_XSCUGIC_0_BASEADDR;

  if (XGetEncodedIntrId(61, 4, XSPI, XINTC_TYPE_IS_SCUGIC, &Id) != XST_SUCCESS || Id != 0x401D) {
    return XST_FAILURE;
  }
  if (XGetEncodedIntrId(29, 1, XPPI, XINTC_TYPE_IS_SCUGIC, &Timer) != XST_SUCCESS ||
      Timer != (XPAR_XSCUTIMER_0_INTERRUPTS & ~0xF0000U)) { /* which CPUs is in the header only */
    return XST_FAILURE;
  }
  if (XGetEncodedIntrId(61, 4, XSPI, XINTC_TYPE_IS_INTC, &Id) == XST_SUCCESS ||
      XGetEncodedIntrId(5, 4, XSPI, XINTC_TYPE_IS_SCUGIC, &Id) == XST_SUCCESS) {
    return XST_FAILURE;
  }
  XGetPriorityTriggerType(0x401D, &Priority, &Trigger, Gic);
  if (Priority != XINTERRUPT_DEFAULT_PRIORITY || Trigger != XINTR_IS_LEVEL_TRIGGERED) {
    return XST_FAILURE;
  }
  if (XGetEncodedIntrId(3, 1, XSGI, XINTC_TYPE_IS_SCUGIC, &Id) != XST_SUCCESS ||
      XConfigInterruptCntrl(Gic) != XST_SUCCESS || XStartInterruptCntrl(0, Gic) != XST_SUCCESS ||
      XConnectToInterruptCntrl(Id, &SoftwareHandler, NULL, Gic) != XST_SUCCESS) {
    return XST_FAILURE;
  }
  XEnableIntrId(Id, Gic);
  if (XTriggerSoftwareIntr(Id, Gic, 1) != XST_SUCCESS) return XST_FAILURE;
  while (!Raised)
    ;
  XDisableIntrId(Id, Gic);
  XStopInterruptCntrl(Gic);
  if (XSetupInterruptSystem(NULL, &SoftwareHandler, Id, 0x41200000, 0xA0) == XST_SUCCESS) {
    return XST_FAILURE; /* no controller is there */
  }
  return XScuGic_LookupConfig(XPAR_XSCUGIC_0_BASEADDR) == NULL ? XST_FAILURE : XST_SUCCESS;
}

int main(void) {
  if (Button() != XST_SUCCESS || Tick() != XST_SUCCESS || Talk() != XST_SUCCESS ||
      Copy() != XST_SUCCESS || Steps() != XST_SUCCESS) {
    return XST_FAILURE;
  }
  xil_printf("Successfully ran what has an address\r\n");
  return XST_SUCCESS;
}
