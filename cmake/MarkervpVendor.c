/*
 * The devices of xparameters.h, for the vendor's drivers that VENDOR_BSP of markervp_add_program
 * names: what Vitis generates beside them, in either flow. Members are named, as releases order
 * them differently; those that only some releases have are there where MARKERVP_HAS_… says so
 * (_markervp_use_vendor_drivers looks into the headers).
 */
#include <xparameters.h>

/* Every project has it there. */
#define DISTRIBUTOR 0xF8F01000U

/* Of SDT: numbers and addresses, and the interrupt with its controller. */
#define NAME(prefix, n) (char*)#prefix "_" #n
#define INTERRUPT(prefix, n) \
  .IntrId = XPAR_##prefix##_##n##_INTERRUPTS, .IntrParent = DISTRIBUTOR

#ifdef MARKERVP_VENDOR_AXIDMA
#include <xaxidma.h>
#if !defined MARKERVP_HAS_AXIDMA_SGLENGTHWIDTH
#define LATER(n)
#elif defined SDT
#define LATER(n) .SgLengthWidth = XPAR_XAXIDMA_##n##_SG_LENGTH_WIDTH,
#else
#define LATER(n) .SgLengthWidth = XPAR_AXIDMA_##n##_c_sg_length_width,
#endif
#ifdef SDT
#define MARKERVP_ROW(n)                                                                          \
  {                                                                                              \
    .Name = NAME(XAXIDMA, n), .BaseAddr = XPAR_XAXIDMA_##n##_BASEADDR,                           \
    .HasMm2S = XPAR_XAXIDMA_##n##_INCLUDE_MM2S,                                                  \
    .Mm2SDataWidth = XPAR_XAXIDMA_##n##_MM2S_DATA_WIDTH,                                         \
    .HasS2Mm = XPAR_XAXIDMA_##n##_INCLUDE_S2MM,                                                  \
    .S2MmDataWidth = XPAR_XAXIDMA_##n##_S2MM_DATA_WIDTH, .HasSg = XPAR_XAXIDMA_##n##_INCLUDE_SG, \
    .Mm2sNumChannels = XPAR_XAXIDMA_##n##_NUM_MM2S_CHANNELS,                                     \
    .S2MmNumChannels = XPAR_XAXIDMA_##n##_NUM_S2MM_CHANNELS,                                     \
    .Mm2SBurstSize = XPAR_XAXIDMA_##n##_MM2S_BURST_SIZE,                                         \
    .S2MmBurstSize = XPAR_XAXIDMA_##n##_S2MM_BURST_SIZE,                                         \
    .AddrWidth = XPAR_XAXIDMA_##n##_ADDRWIDTH,                                                   \
    .IntrId = {XPAR_XAXIDMA_##n##_INTERRUPTS, MARKERVP_SECOND_XAXIDMA_##n},                      \
    .IntrParent = DISTRIBUTOR, LATER(n)                                              \
  }
#else
#define MARKERVP_ROW(n)                                                                            \
  {                                                                                                \
    .DeviceId = XPAR_AXIDMA_##n##_DEVICE_ID, .BaseAddr = XPAR_AXIDMA_##n##_BASEADDR,               \
    .HasStsCntrlStrm = XPAR_AXIDMA_##n##_SG_INCLUDE_STSCNTRL_STRM,                                 \
    .HasMm2S = XPAR_AXIDMA_##n##_INCLUDE_MM2S, .HasMm2SDRE = XPAR_AXIDMA_##n##_INCLUDE_MM2S_DRE,   \
    .Mm2SDataWidth = XPAR_AXIDMA_##n##_M_AXI_MM2S_DATA_WIDTH,                                      \
    .HasS2Mm = XPAR_AXIDMA_##n##_INCLUDE_S2MM, .HasS2MmDRE = XPAR_AXIDMA_##n##_INCLUDE_S2MM_DRE,   \
    .S2MmDataWidth = XPAR_AXIDMA_##n##_M_AXI_S2MM_DATA_WIDTH,                                      \
    .HasSg = XPAR_AXIDMA_##n##_INCLUDE_SG, .Mm2sNumChannels = XPAR_AXIDMA_##n##_NUM_MM2S_CHANNELS, \
    .S2MmNumChannels = XPAR_AXIDMA_##n##_NUM_S2MM_CHANNELS,                                        \
    .Mm2SBurstSize = XPAR_AXIDMA_##n##_MM2S_BURST_SIZE,                                            \
    .S2MmBurstSize = XPAR_AXIDMA_##n##_S2MM_BURST_SIZE,                                            \
    .MicroDmaMode = XPAR_AXIDMA_##n##_MICRO_DMA, .AddrWidth = XPAR_AXIDMA_##n##_c_addr_width,      \
    LATER(n)                                                                                       \
  }
#endif
#define MARKERVP_COUNT XPAR_XAXIDMA_NUM_INSTANCES
XAxiDma_Config XAxiDma_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#undef LATER
#endif

#ifdef MARKERVP_VENDOR_GPIO
#include <xgpio.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                                         \
  {                                                                                             \
    .Name = NAME(XGPIO, n), .BaseAddress = XPAR_XGPIO_##n##_BASEADDR,                           \
    .InterruptPresent = XPAR_XGPIO_##n##_INTERRUPT_PRESENT, .IsDual = XPAR_XGPIO_##n##_IS_DUAL, \
    .Width = XPAR_XGPIO_##n##_GPIO_WIDTH, INTERRUPT(XGPIO, n),                                  \
  }
#else
#define MARKERVP_ROW(n)                                                                       \
  {                                                                                           \
    .DeviceId = XPAR_GPIO_##n##_DEVICE_ID, .BaseAddress = XPAR_GPIO_##n##_BASEADDR,           \
    .InterruptPresent = XPAR_GPIO_##n##_INTERRUPT_PRESENT, .IsDual = XPAR_GPIO_##n##_IS_DUAL, \
  }
#endif
#define MARKERVP_COUNT XPAR_XGPIO_NUM_INSTANCES
XGpio_Config XGpio_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_SCUTIMER
#include <xscutimer.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XSCUTIMER, n), .BaseAddr = XPAR_XSCUTIMER_##n##_BASEADDR, }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_XSCUTIMER_##n##_DEVICE_ID, .BaseAddr = XPAR_XSCUTIMER_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XSCUTIMER_NUM_INSTANCES
XScuTimer_Config XScuTimer_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_SCUWDT
#include <xscuwdt.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XSCUWDT, n), .BaseAddr = XPAR_XSCUWDT_##n##_BASEADDR, INTERRUPT(XSCUWDT, n), }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_SCUWDT_##n##_DEVICE_ID, .BaseAddr = XPAR_SCUWDT_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XSCUWDT_NUM_INSTANCES
XScuWdt_Config XScuWdt_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_UARTPS
#include <xuartps.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                   \
  {                                                                       \
    .Name = NAME(XUARTPS, n), .BaseAddress = XPAR_XUARTPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XUARTPS_##n##_CLOCK_FREQ, INTERRUPT(XUARTPS, n), \
  }
#else
#define MARKERVP_ROW(n)                                                                   \
  {                                                                                       \
    .DeviceId = XPAR_XUARTPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XUARTPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XUARTPS_##n##_UART_CLK_FREQ_HZ,                                  \
    .ModemPinsConnected = XPAR_XUARTPS_##n##_HAS_MODEM,                                   \
  }
#endif
#define MARKERVP_COUNT XPAR_XUARTPS_NUM_INSTANCES
XUartPs_Config XUartPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_TTCPS
#include <xttcps.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                        \
  {                                                                            \
    .Name = NAME(XTTCPS, n), .BaseAddress = XPAR_XTTCPS_##n##_BASEADDR,        \
    .InputClockHz = XPAR_XTTCPS_##n##_CLOCK_FREQ,                              \
    .IntrId = {XPAR_XTTCPS_##n##_INTERRUPTS, XPAR_XTTCPS_##n##_INTERRUPTS + 1, \
               XPAR_XTTCPS_##n##_INTERRUPTS + 2},                              \
    .IntrParent = DISTRIBUTOR,                                     \
  }
#else
#define MARKERVP_ROW(n)                                                                 \
  {                                                                                     \
    .DeviceId = XPAR_XTTCPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XTTCPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XTTCPS_##n##_TTC_CLK_FREQ_HZ,                                  \
  }
#endif
#define MARKERVP_COUNT XPAR_XTTCPS_NUM_INSTANCES
XTtcPs_Config XTtcPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_GPIOPS
#include <xgpiops.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XGPIOPS, n), .BaseAddr = XPAR_XGPIOPS_##n##_BASEADDR, INTERRUPT(XGPIOPS, n), }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_XGPIOPS_##n##_DEVICE_ID, .BaseAddr = XPAR_XGPIOPS_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XGPIOPS_NUM_INSTANCES
XGpioPs_Config XGpioPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_IICPS
#include <xiicps.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                 \
  {                                                                     \
    .Name = NAME(XIICPS, n), .BaseAddress = XPAR_XIICPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XIICPS_##n##_CLOCK_FREQ, INTERRUPT(XIICPS, n), \
  }
#else
#define MARKERVP_ROW(n)                                                                 \
  {                                                                                     \
    .DeviceId = XPAR_XIICPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XIICPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XIICPS_##n##_I2C_CLK_FREQ_HZ,                                  \
  }
#endif
#define MARKERVP_COUNT XPAR_XIICPS_NUM_INSTANCES
XIicPs_Config XIicPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_SPIPS
#include <xspips.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                 \
  {                                                                     \
    .Name = NAME(XSPIPS, n), .BaseAddress = XPAR_XSPIPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XSPIPS_##n##_CLOCK_FREQ, INTERRUPT(XSPIPS, n), \
  }
#else
#define MARKERVP_ROW(n)                                                                 \
  {                                                                                     \
    .DeviceId = XPAR_XSPIPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XSPIPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XSPIPS_##n##_SPI_CLK_FREQ_HZ,                                  \
  }
#endif
#define MARKERVP_COUNT XPAR_XSPIPS_NUM_INSTANCES
XSpiPs_Config XSpiPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_WDTPS
#include <xwdtps.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                 \
  {                                                                     \
    .Name = NAME(XWDTPS, n), .BaseAddress = XPAR_XWDTPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XWDTPS_##n##_CLOCK_FREQ, INTERRUPT(XWDTPS, n), \
  }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_XWDTPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XWDTPS_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XWDTPS_NUM_INSTANCES
XWdtPs_Config XWdtPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_XADCPS
#include <xadcps.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XXADCPS, n), .BaseAddress = XPAR_XXADCPS_##n##_BASEADDR, }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_XADCPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XADCPS_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XADCPS_NUM_INSTANCES
XAdcPs_Config XAdcPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_DEVCFG
#include <xdevcfg.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XDEVCFG, n), .BaseAddr = XPAR_XDEVCFG_##n##_BASEADDR, INTERRUPT(XDEVCFG, n), }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_XDCFG_##n##_DEVICE_ID, .BaseAddr = XPAR_XDCFG_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XDCFG_NUM_INSTANCES
XDcfg_Config XDcfg_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_QSPIPS
#include <xqspips.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                   \
  {                                                                       \
    .Name = NAME(XQSPIPS, n), .BaseAddress = XPAR_XQSPIPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XQSPIPS_##n##_CLOCK_FREQ, INTERRUPT(XQSPIPS, n), \
  }
#else
#define MARKERVP_ROW(n)                                                                   \
  {                                                                                       \
    .DeviceId = XPAR_XQSPIPS_##n##_DEVICE_ID, .BaseAddress = XPAR_XQSPIPS_##n##_BASEADDR, \
    .InputClockHz = XPAR_XQSPIPS_##n##_QSPI_CLK_FREQ_HZ,                                  \
    .ConnectionMode = XPAR_XQSPIPS_##n##_QSPI_MODE,                                       \
  }
#endif
#define MARKERVP_COUNT XPAR_XQSPIPS_NUM_INSTANCES
XQspiPs_Config XQspiPs_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_TMRCTR
#include <xtmrctr.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                          \
  {                                                                              \
    .Name = NAME(XTMRCTR, n), .BaseAddress = XPAR_XTMRCTR_##n##_BASEADDR,        \
    .SysClockFreqHz = XPAR_XTMRCTR_##n##_CLOCK_FREQUENCY, INTERRUPT(XTMRCTR, n), \
  }
#else
#define MARKERVP_ROW(n)                                                                 \
  {                                                                                     \
    .DeviceId = XPAR_TMRCTR_##n##_DEVICE_ID, .BaseAddress = XPAR_TMRCTR_##n##_BASEADDR, \
    .SysClockFreqHz = XPAR_TMRCTR_##n##_CLOCK_FREQ_HZ,                                  \
  }
#endif
#define MARKERVP_COUNT XPAR_XTMRCTR_NUM_INSTANCES
XTmrCtr_Config XTmrCtr_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_INTC
#include <xintc.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                               \
  {                                                                   \
    .Name = NAME(XINTC, n), .BaseAddress = XPAR_XINTC_##n##_BASEADDR, \
    .AckBeforeService = XPAR_XINTC_##n##_KIND_OF_INTR,                \
    .NumberofIntrs = XPAR_XINTC_##n##_NUM_INTR_INPUTS,                \
  }
#else
#define MARKERVP_ROW(n)                                                                     \
  {                                                                                         \
    .DeviceId = XPAR_INTC_##n##_DEVICE_ID, .BaseAddress = XPAR_INTC_##n##_BASEADDR,         \
    .AckBeforeService = XPAR_INTC_##n##_KIND_OF_INTR, .FastIntr = XPAR_INTC_##n##_HAS_FAST, \
    .NumberofIntrs = XPAR_INTC_##n##_NUM_INTR_INPUTS,                                       \
  }
#endif
#define MARKERVP_COUNT XPAR_XINTC_NUM_INSTANCES
XIntc_Config XIntc_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_IIC
#include <xiic.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                             \
  {                                                                 \
    .Name = NAME(XIIC, n), .BaseAddress = XPAR_XIIC_##n##_BASEADDR, \
    .GpOutWidth = XPAR_XIIC_##n##_GPO_WIDTH, INTERRUPT(XIIC, n),    \
  }
#else
#define MARKERVP_ROW(n)                                                                 \
  {                                                                                     \
    .DeviceId = XPAR_IIC_##n##_DEVICE_ID, .BaseAddress = XPAR_IIC_##n##_BASEADDR,       \
    .Has10BitAddr = XPAR_IIC_##n##_TEN_BIT_ADR, .GpOutWidth = XPAR_IIC_##n##_GPO_WIDTH, \
  }
#endif
#define MARKERVP_COUNT XPAR_XIIC_NUM_INSTANCES
XIic_Config XIic_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_SPI
#include <xspi.h>
#if !defined MARKERVP_HAS_SPI_FIFOSDEPTH
#define LATER(n)
#elif defined SDT
#define LATER(n) .FifosDepth = XPAR_XSPI_##n##_FIFO_SIZE,
#else
#define LATER(n) .FifosDepth = XPAR_SPI_##n##_FIFO_DEPTH,
#endif
#ifdef SDT
#define MARKERVP_ROW(n)                                                                  \
  {                                                                                      \
    .Name = NAME(XSPI, n), .BaseAddress = XPAR_XSPI_##n##_BASEADDR,                      \
    .HasFifos = XPAR_XSPI_##n##_FIFO_EXIST, .NumSlaveBits = XPAR_XSPI_##n##_NUM_SS_BITS, \
    .DataWidth = XPAR_XSPI_##n##_NUM_TRANSFER_BITS, INTERRUPT(XSPI, n), LATER(n)         \
  }
#else
#define MARKERVP_ROW(n)                                                                        \
  {                                                                                            \
    .DeviceId = XPAR_SPI_##n##_DEVICE_ID, .BaseAddress = XPAR_SPI_##n##_BASEADDR,              \
    .HasFifos = XPAR_SPI_##n##_FIFO_EXIST, .SlaveOnly = XPAR_SPI_##n##_SPI_SLAVE_ONLY,         \
    .NumSlaveBits = XPAR_SPI_##n##_NUM_SS_BITS, .DataWidth = XPAR_SPI_##n##_NUM_TRANSFER_BITS, \
    .SpiMode = XPAR_SPI_##n##_SPI_MODE, LATER(n)                                               \
  }
#endif
#define MARKERVP_COUNT XPAR_XSPI_NUM_INSTANCES
XSpi_Config XSpi_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#undef LATER
#endif

#ifdef MARKERVP_VENDOR_UARTLITE
#include <xuartlite.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                                    \
  {                                                                                        \
    .Name = NAME(XUARTLITE, n), .RegBaseAddr = XPAR_XUARTLITE_##n##_BASEADDR,              \
    .BaudRate = XPAR_XUARTLITE_##n##_BAUDRATE, .DataBits = XPAR_XUARTLITE_##n##_DATA_BITS, \
    INTERRUPT(XUARTLITE, n),                                                               \
  }
#else
#define MARKERVP_ROW(n)                                                                     \
  {                                                                                         \
    .DeviceId = XPAR_UARTLITE_##n##_DEVICE_ID, .RegBaseAddr = XPAR_UARTLITE_##n##_BASEADDR, \
    .BaudRate = XPAR_UARTLITE_##n##_BAUDRATE, .UseParity = XPAR_UARTLITE_##n##_USE_PARITY,  \
    .ParityOdd = XPAR_UARTLITE_##n##_ODD_PARITY, .DataBits = XPAR_UARTLITE_##n##_DATA_BITS, \
  }
#endif
#define MARKERVP_COUNT XPAR_XUARTLITE_NUM_INSTANCES
XUartLite_Config XUartLite_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_LLFIFO
#include <xllfifo.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                            \
  {                                                                                \
    .Name = NAME(XLLFIFO, n), .BaseAddress = XPAR_XLLFIFO_##n##_BASEADDR,          \
    .Datainterface = XPAR_XLLFIFO_##n##_DATA_INTERFACE_TYPE,                       \
    .IntId = XPAR_XLLFIFO_##n##_INTERRUPTS, .IntrParent = DISTRIBUTOR, \
  }
#else
#define MARKERVP_ROW(n)                                                                     \
  {                                                                                         \
    .DeviceId = XPAR_AXI_FIFO_##n##_DEVICE_ID, .BaseAddress = XPAR_AXI_FIFO_##n##_BASEADDR, \
    .Axi4BaseAddress = XPAR_AXI_FIFO_##n##_AXI4_BASEADDR,                                   \
    .Datainterface = XPAR_AXI_FIFO_##n##_DATA_INTERFACE_TYPE,                               \
  }
#endif
#define MARKERVP_COUNT XPAR_XLLFIFO_NUM_INSTANCES
XLlFifo_Config XLlFifo_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_AXICDMA
#include <xaxicdma.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                                         \
  {                                                                                             \
    .Name = NAME(XAXICDMA, n), .BaseAddress = XPAR_XAXICDMA_##n##_BASEADDR,                     \
    .DataWidth = XPAR_XAXICDMA_##n##_DATA_WIDTH, .BurstLen = XPAR_XAXICDMA_##n##_MAX_BURST_LEN, \
    .AddrWidth = XPAR_XAXICDMA_##n##_ADDRWIDTH, INTERRUPT(XAXICDMA, n),                         \
  }
#else
#define MARKERVP_ROW(n)                                                                        \
  {                                                                                            \
    .DeviceId = XPAR_AXICDMA_##n##_DEVICE_ID, .BaseAddress = XPAR_AXICDMA_##n##_BASEADDR,      \
    .HasDRE = XPAR_AXICDMA_##n##_INCLUDE_DRE, .IsLite = XPAR_AXICDMA_##n##_USE_DATAMOVER_LITE, \
    .DataWidth = XPAR_AXICDMA_##n##_M_AXI_DATA_WIDTH,                                          \
    .BurstLen = XPAR_AXICDMA_##n##_M_AXI_MAX_BURST_LEN,                                        \
    .AddrWidth = XPAR_AXICDMA_##n##_ADDR_WIDTH,                                                \
  }
#endif
#define MARKERVP_COUNT XPAR_XAXICDMA_NUM_INSTANCES
XAxiCdma_Config XAxiCdma_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_AXIVDMA
#include <xaxivdma.h>
#ifdef SDT
#define MARKERVP_ROW(n)                                                            \
  {                                                                                \
    .Name = NAME(XAXIVDMA, n), .BaseAddress = XPAR_XAXIVDMA_##n##_BASEADDR,        \
    .MaxFrameStoreNum = XPAR_XAXIVDMA_##n##_NUM_FSTORES,                           \
    .HasMm2S = XPAR_XAXIVDMA_##n##_INCLUDE_MM2S,                                   \
    .HasMm2SDRE = XPAR_XAXIVDMA_##n##_INCLUDE_MM2S_DRE,                            \
    .Mm2SWordLen = XPAR_XAXIVDMA_##n##_MM2S_DATA_WIDTH,                            \
    .HasS2Mm = XPAR_XAXIVDMA_##n##_INCLUDE_S2MM,                                   \
    .HasS2MmDRE = XPAR_XAXIVDMA_##n##_INCLUDE_S2MM_DRE,                            \
    .S2MmWordLen = XPAR_XAXIVDMA_##n##_S2MM_DATA_WIDTH, .EnableVIDParamRead = 1,   \
    .UseFsync = XPAR_XAXIVDMA_##n##_FLUSH_FSYNC, .FlushonFsync = 1,                \
    .Mm2SBufDepth = XPAR_XAXIVDMA_##n##_MM2S_LINEBUFFER_DEPTH,                     \
    .S2MmBufDepth = XPAR_XAXIVDMA_##n##_S2MM_LINEBUFFER_DEPTH,                     \
    .Mm2SGenLock = XPAR_XAXIVDMA_##n##_MM2S_GENLOCK_MODE,                          \
    .S2MmGenLock = XPAR_XAXIVDMA_##n##_S2MM_GENLOCK_MODE,                          \
    .InternalGenLock = XPAR_XAXIVDMA_##n##_INCLUDE_INTERNAL_GENLOCK, .S2MmSOF = 1, \
    .Mm2SStreamWidth = XPAR_XAXIVDMA_##n##_MM2S_TDATA_WIDTH,                       \
    .S2MmStreamWidth = XPAR_XAXIVDMA_##n##_S2MM_TDATA_WIDTH, .Mm2SDlyCntrEn = 1,   \
    .Mm2SFrmCntrEn = 1, .S2MmDlyCntrEn = 1, .S2MmFrmCntrEn = 1, .AddrWidth = 32,   \
    .IntrId = {XPAR_XAXIVDMA_##n##_INTERRUPTS, MARKERVP_SECOND_XAXIVDMA_##n},      \
    .IntrParent = DISTRIBUTOR,                                                     \
  }
#else
#define MARKERVP_ROW(n)                                                                            \
  {                                                                                                \
    .DeviceId = XPAR_AXIVDMA_##n##_DEVICE_ID, .BaseAddress = XPAR_AXIVDMA_##n##_BASEADDR,          \
    .MaxFrameStoreNum = XPAR_AXIVDMA_##n##_NUM_FSTORES,                                            \
    .HasMm2S = XPAR_AXIVDMA_##n##_INCLUDE_MM2S, .HasMm2SDRE = XPAR_AXIVDMA_##n##_INCLUDE_MM2S_DRE, \
    .Mm2SWordLen = XPAR_AXIVDMA_##n##_M_AXI_MM2S_DATA_WIDTH,                                       \
    .HasS2Mm = XPAR_AXIVDMA_##n##_INCLUDE_S2MM, .HasS2MmDRE = XPAR_AXIVDMA_##n##_INCLUDE_S2MM_DRE, \
    .S2MmWordLen = XPAR_AXIVDMA_##n##_M_AXI_S2MM_DATA_WIDTH, .EnableVIDParamRead = 1,              \
    .UseFsync = XPAR_AXIVDMA_##n##_USE_FSYNC, .FlushonFsync = 1,                                   \
    .Mm2SBufDepth = XPAR_AXIVDMA_##n##_MM2S_LINEBUFFER_DEPTH,                                      \
    .S2MmBufDepth = XPAR_AXIVDMA_##n##_S2MM_LINEBUFFER_DEPTH,                                      \
    .Mm2SGenLock = XPAR_AXIVDMA_##n##_MM2S_GENLOCK_MODE,                                           \
    .S2MmGenLock = XPAR_AXIVDMA_##n##_S2MM_GENLOCK_MODE,                                           \
    .InternalGenLock = XPAR_AXIVDMA_##n##_INCLUDE_INTERNAL_GENLOCK, .S2MmSOF = 1,                  \
    .Mm2SStreamWidth = XPAR_AXIVDMA_##n##_M_AXIS_MM2S_TDATA_WIDTH,                                 \
    .S2MmStreamWidth = XPAR_AXIVDMA_##n##_S_AXIS_S2MM_TDATA_WIDTH, .Mm2SDlyCntrEn = 1,             \
    .Mm2SFrmCntrEn = 1, .S2MmDlyCntrEn = 1, .S2MmFrmCntrEn = 1, .AddrWidth = 32,                   \
  }
#endif
#define MARKERVP_COUNT XPAR_XAXIVDMA_NUM_INSTANCES
XAxiVdma_Config XAxiVdma_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_VTC
#include <xvtc.h>
#ifdef MARKERVP_HAS_VTC_INTRID
#define LATER(n) INTERRUPT(XVTC, n),
#else
#define LATER(n)
#endif
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XVTC, n), .BaseAddress = XPAR_XVTC_##n##_BASEADDR, LATER(n) }
#else
#define MARKERVP_ROW(n) \
  { .DeviceId = XPAR_VTC_##n##_DEVICE_ID, .BaseAddress = XPAR_VTC_##n##_BASEADDR, }
#endif
#define MARKERVP_COUNT XPAR_XVTC_NUM_INSTANCES
XVtc_Config XVtc_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#undef LATER
#endif

#ifdef MARKERVP_VENDOR_SYSMON
#include <xsysmon.h>
#ifdef SDT
#define MARKERVP_ROW(n) \
  { .Name = NAME(XSYSMON, n), .BaseAddress = XPAR_XSYSMON_##n##_BASEADDR, }
#else
#define MARKERVP_ROW(n)                                                                      \
  {                                                                                          \
    .DeviceId = XPAR_SYSMON_##n##_DEVICE_ID, .BaseAddress = XPAR_SYSMON_##n##_BASEADDR,      \
    .IncludeInterrupt = XPAR_SYSMON_##n##_INCLUDE_INTR, .IpType = XPAR_SYSMON_##n##_IP_TYPE, \
  }
#endif
#define MARKERVP_COUNT XPAR_XSYSMON_NUM_INSTANCES
XSysMon_Config XSysMon_ConfigTable[] = {
#include "MarkervpVendorRows.h"
};
#endif

#ifdef MARKERVP_VENDOR_SCUGIC
#include <xscugic.h>

XScuGic_Config XScuGic_ConfigTable[] = {
#ifdef SDT
    {.Name = NAME(XSCUGIC, 0),
#else
    {.DeviceId = XPAR_SCUGIC_0_DEVICE_ID,
#endif
     .CpuBaseAddress = 0xF8F00100U,
     .DistBaseAddress = DISTRIBUTOR},
    {0}};
#endif
