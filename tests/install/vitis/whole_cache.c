/* Calls for all of the caches, and uncached memory: a loop-back of buffers in arrays that are never
 * named to the caches one by one. */
#include "sleep.h"
#include "xaxidma.h"
#include "xil_cache.h"
#include "xil_mmu.h"
#include "xil_printf.h"
#include "xparameters.h"

static u32 sent[64] __attribute__((aligned(64)));
static u32 received[64] __attribute__((aligned(64)));
static XAxiDma dma;

/* Returns how many words are wrong. */
static int pass(u32 seed, int flushes) {
  int wrong = 0;
  for (int i = 0; i < 64; i++) sent[i] = seed + (u32)i;
  if (flushes) Xil_DCacheFlush();
  XAxiDma_SimpleTransfer(&dma, (UINTPTR)received, sizeof received, XAXIDMA_DEVICE_TO_DMA);
  XAxiDma_SimpleTransfer(&dma, (UINTPTR)sent, sizeof sent, XAXIDMA_DMA_TO_DEVICE);
  usleep(100);
  if (flushes) Xil_DCacheFlush();
  for (int i = 0; i < 64; i++) wrong += received[i] != seed + (u32)i;
  return wrong;
}

int main(void) {
  int wrong = XAxiDma_CfgInitialize(&dma, XAxiDma_LookupConfig(XPAR_AXIDMA_0_DEVICE_ID));
  wrong += pass(100, 1);
  Xil_DCacheDisable();
  wrong += pass(200, 0);
  Xil_DCacheEnable();
  Xil_SetTlbAttributes((INTPTR)sent, NORM_NONCACHE);
  Xil_SetTlbAttributes((INTPTR)received, NORM_NONCACHE);
  wrong += pass(300, 0);
  xil_printf("0 warnings expected, %d wrong\r\n", wrong);
  return wrong != 0;
}
