/*
 * The devices of xparameters.h, for the vendor's drivers that VENDOR_BSP of markervp_add_program names: what Vitis
 * generates beside them. Members are named, as releases order them differently.
 */
#include <xparameters.h>

#ifdef SDT
#error "VENDOR_BSP builds the vendor's drivers without SDT: leave the definition out, or VENDOR_BSP"
#endif

#ifdef MARKERVP_VENDOR_AXIDMA
#include <xaxidma.h>

#define AXIDMA(n)                                                                                \
  {                                                                                              \
      .DeviceId = XPAR_AXIDMA_##n##_DEVICE_ID, .BaseAddr = XPAR_AXIDMA_##n##_BASEADDR,           \
      .HasMm2S = XPAR_AXIDMA_##n##_INCLUDE_MM2S, .HasS2Mm = XPAR_AXIDMA_##n##_INCLUDE_S2MM,      \
      .Mm2SDataWidth = XPAR_AXIDMA_##n##_M_AXI_MM2S_DATA_WIDTH,                                  \
      .S2MmDataWidth = XPAR_AXIDMA_##n##_M_AXI_S2MM_DATA_WIDTH,                                  \
      .HasSg = XPAR_AXIDMA_##n##_INCLUDE_SG, .Mm2sNumChannels = 1, .S2MmNumChannels = 1,         \
      .AddrWidth = 32, .SgLengthWidth = XPAR_AXIDMA_##n##_SG_LENGTH_WIDTH,                       \
  }

XAxiDma_Config XAxiDma_ConfigTable[] = {
#ifdef XPAR_AXIDMA_0_BASEADDR
    AXIDMA(0),
#endif
#ifdef XPAR_AXIDMA_1_BASEADDR
    AXIDMA(1),
#endif
#ifdef XPAR_AXIDMA_2_BASEADDR
    AXIDMA(2),
#endif
#ifdef XPAR_AXIDMA_3_BASEADDR
    AXIDMA(3),
#endif
};
#endif

#ifdef MARKERVP_VENDOR_GPIO
#include <xgpio.h>

#define GPIO(n)                                                                               \
  {                                                                                           \
      .DeviceId = XPAR_GPIO_##n##_DEVICE_ID, .BaseAddress = XPAR_GPIO_##n##_BASEADDR,         \
      .InterruptPresent = XPAR_GPIO_##n##_INTERRUPT_PRESENT, .IsDual = XPAR_GPIO_##n##_IS_DUAL, \
  }

XGpio_Config XGpio_ConfigTable[] = {
#ifdef XPAR_GPIO_0_BASEADDR
    GPIO(0),
#endif
#ifdef XPAR_GPIO_1_BASEADDR
    GPIO(1),
#endif
#ifdef XPAR_GPIO_2_BASEADDR
    GPIO(2),
#endif
#ifdef XPAR_GPIO_3_BASEADDR
    GPIO(3),
#endif
};
#endif

#ifdef MARKERVP_VENDOR_SCUGIC
#include <xscugic.h>

XScuGic_Config XScuGic_ConfigTable[] = {{.DeviceId = XPAR_SCUGIC_0_DEVICE_ID,
                                         .CpuBaseAddress = XPAR_SCUGIC_0_CPU_BASEADDR,
                                         .DistBaseAddress = XPAR_SCUGIC_0_DIST_BASEADDR}};
#endif

#ifdef MARKERVP_VENDOR_SCUTIMER
#include <xscutimer.h>

XScuTimer_Config XScuTimer_ConfigTable[] = {
    {.DeviceId = XPAR_XSCUTIMER_0_DEVICE_ID, .BaseAddr = XPAR_XSCUTIMER_0_BASEADDR}};
#endif

#ifdef MARKERVP_VENDOR_SCUWDT
#include <xscuwdt.h>

XScuWdt_Config XScuWdt_ConfigTable[] = {
    {.DeviceId = XPAR_XSCUWDT_0_DEVICE_ID, .BaseAddr = XPAR_XSCUWDT_0_BASEADDR}};
#endif

#ifdef MARKERVP_VENDOR_UARTPS
#include <xuartps.h>

#define UARTPS(n)                                                                           \
  {                                                                                         \
      .DeviceId = XPAR_XUARTPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XUARTPS_##n##_BASEADDR, \
      .InputClockHz = XPAR_XUARTPS_##n##_UART_CLK_FREQ_HZ,                                  \
  }

XUartPs_Config XUartPs_ConfigTable[] = {
#ifdef XPAR_XUARTPS_0_BASEADDR
    UARTPS(0),
#endif
#ifdef XPAR_XUARTPS_1_BASEADDR
    UARTPS(1),
#endif
};
#endif
