/* As written for the vendor's tools: sends a packet through the DMA of an imported design, whose
 * output is its input, lights what the buttons say, and asks an IP that has no model. */
#include <xaxidma.h>
#include <xgpio.h>
#include <xil_cache.h>
#include <xil_io.h>
#include <xil_printf.h>
#include <xscugic.h>
#include <xstatus.h>

#define DMA_ID 0
#define GPIO_ID 0
#define S2MM_INTERRUPT 61U
#define OWN_BASE 0x43C00000U
#define TX 0x01000000U
#define RX 0x01100000U
#define BYTES 101U

static XAxiDma Dma;
static XGpio Gpio;
static XScuGic Gic;
static volatile unsigned Received;

static void on_packet(void* context) {
  XAxiDma* dma = (XAxiDma*)context;
  XAxiDma_IntrAckIrq(dma, XAxiDma_IntrGetIrq(dma, XAXIDMA_DEVICE_TO_DMA), XAXIDMA_DEVICE_TO_DMA);
  ++Received;
}

static int set_up(void) {
  XAxiDma_Config* config = XAxiDma_LookupConfig(DMA_ID);
  if (config == NULL || XAxiDma_CfgInitialize(&Dma, config) != XST_SUCCESS) return XST_FAILURE;
  XScuGic_Config* gic = XScuGic_LookupConfig(0);
  if (gic == NULL || XScuGic_CfgInitialize(&Gic, gic, gic->CpuBaseAddress) != XST_SUCCESS)
    return XST_FAILURE;
  Xil_ExceptionInit();
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &Gic);
  XScuGic_Connect(&Gic, S2MM_INTERRUPT, on_packet, &Dma);
  XScuGic_Enable(&Gic, S2MM_INTERRUPT);
  Xil_ExceptionEnable();
  XAxiDma_IntrEnable(&Dma, XAXIDMA_IRQ_IOC_MASK, XAXIDMA_DEVICE_TO_DMA);
  return XGpio_Initialize(&Gpio, GPIO_ID);
}

int main(void) {
  u8* sent = (u8*)(UINTPTR)TX;
  u8* came = (u8*)(UINTPTR)RX;
  unsigned wrong = 0;
  if (set_up() != XST_SUCCESS) return 2;
  for (unsigned i = 0; i < BYTES; ++i) sent[i] = (u8)(7U * i + 1U);
  Xil_DCacheFlushRange((UINTPTR)sent, BYTES);
  if (XAxiDma_SimpleTransfer(&Dma, (UINTPTR)came, 1024, XAXIDMA_DEVICE_TO_DMA) != XST_SUCCESS ||
      XAxiDma_SimpleTransfer(&Dma, (UINTPTR)sent, BYTES, XAXIDMA_DMA_TO_DEVICE) != XST_SUCCESS)
    return 3;
  while (XAxiDma_Busy(&Dma, XAXIDMA_DEVICE_TO_DMA)) continue;
  Xil_DCacheInvalidateRange((UINTPTR)came, BYTES);
  for (unsigned i = 0; i < BYTES; ++i) wrong += came[i] != sent[i];
  XGpio_SetDataDirection(&Gpio, 1, 0xF);
  const u32 buttons = XGpio_DiscreteRead(&Gpio, 1);
  xil_printf("%d bytes wrong, length %d, interrupts %d, buttons %x, own %x\r\n", (int)wrong,
             (int)XAxiDma_ReadReg(Dma.RegBase + 0x30, 0x28), (int)Received, (unsigned)buttons,
             (unsigned)Xil_In32(OWN_BASE + 4));
  return wrong == 0 && Received == 1 ? 0 : 4;
}
