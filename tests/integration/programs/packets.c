/* As written for the vendor's tools: sixteen packets through the DMA of an imported design, whose
 * output is its input, each with a number and a sum. One that does not come right is sent again,
 * after a reset of the DMA; three failures end the program. Campaigns of faults have it for their
 * subject (docs/testing.md). */
#include <string.h>
#include <xaxidma.h>
#include <xil_cache.h>
#include <xil_printf.h>
#include <xstatus.h>

#define WORDS 64U
#define BYTES (4U * WORDS)
#define POLLS 2000U

static XAxiDma Dma;
static u32 Sent[WORDS] __attribute__((aligned(64)));
static u32 Came[WORDS] __attribute__((aligned(64)));

static u32 sum_of(const u32* words) {
  u32 a = 1, b = 0;
  for (unsigned i = 0; i + 1 < WORDS; ++i) {
    a = (a + words[i]) * 0x01000193U;
    b ^= a + (b << 5) + (b >> 27);
  }
  return b;
}

static int set_up(void) {
  XAxiDma_Config* config = XAxiDma_LookupConfig(0);
  return config != NULL && XAxiDma_CfgInitialize(&Dma, config) == XST_SUCCESS ? XST_SUCCESS
                                                                              : XST_FAILURE;
}

static int finished(int direction) {
  for (unsigned i = 0; i < POLLS; ++i) {
    const u32 offset = direction == XAXIDMA_DEVICE_TO_DMA ? XAXIDMA_RX_OFFSET : XAXIDMA_TX_OFFSET;
    const u32 status = XAxiDma_ReadReg(Dma.RegBase + offset, XAXIDMA_SR_OFFSET);
    if (status & XAXIDMA_ERR_ALL_MASK) return 0;
    if (status & XAXIDMA_IDLE_MASK) return 1;
  }
  return 0;
}

static int pass(u32 number) {
  Sent[0] = number;
  for (unsigned i = 1; i + 1 < WORDS; ++i) Sent[i] = Sent[i - 1] * 1664525U + 1013904223U + number;
  Sent[WORDS - 1] = sum_of(Sent);
  memset(Came, 0, BYTES);
  Xil_DCacheFlushRange((UINTPTR)Sent, BYTES);
  Xil_DCacheFlushRange((UINTPTR)Came, BYTES);
  if (XAxiDma_SimpleTransfer(&Dma, (UINTPTR)Came, BYTES, XAXIDMA_DEVICE_TO_DMA) != XST_SUCCESS)
    return 0;
  if (XAxiDma_SimpleTransfer(&Dma, (UINTPTR)Sent, BYTES, XAXIDMA_DMA_TO_DEVICE) != XST_SUCCESS)
    return 0;
  if (!finished(XAXIDMA_DMA_TO_DEVICE) || !finished(XAXIDMA_DEVICE_TO_DMA)) return 0;
  if (XAxiDma_ReadReg(Dma.RegBase + XAXIDMA_RX_OFFSET, XAXIDMA_BUFFLEN_OFFSET) != BYTES) return 0;
  Xil_DCacheInvalidateRange((UINTPTR)Came, BYTES);
  return Came[0] == number && Came[WORDS - 1] == sum_of(Came);
}

int main(void) {
  unsigned failures = 0;
  if (set_up() != XST_SUCCESS) return 2;
  for (u32 number = 0; number < 16U;) {
    if (pass(number)) {
      xil_printf("packet %d: %x\r\n", (int)number, (unsigned)Came[WORDS - 1]);
      ++number;
      continue;
    }
    xil_printf("again\r\n");
    if (++failures == 3U || set_up() != XST_SUCCESS) return 3;
  }
  return 0;
}
