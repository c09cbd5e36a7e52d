/* The rest of the headers: checks, tests of registers, waiting, time, the low-level interrupt
 * controller. */
#include "Sleep.h" /* as a host writes it that does not mind the case */
#include "platform.h"
#include "platform_config.h"
#include "xil_assert.h"
#include "xil_cache.h"
#include "xil_io.h"
#include "xil_mem.h"
#include "xil_printf.h"
#include "xil_testio.h"
#include "xil_testmem.h"
#include "xil_util.h"
#include "xiltimer.h"
#include "xparameters.h"
#include "xparameters_ps.h"
#include "xpseudo_asm.h"
#include "xscugic_hw.h"
#include "xstatus.h"
#include "xtime_l.h"

static int checks_failed;
static volatile int interrupts;
static volatile int ticks;
static u32 memory[64];

static void Ticked(void* CallBackRef, u32 Status) {
  *(volatile int*)CallBackRef += Status == 0;
}

static void CheckFailed(const char8* File, s32 Line) {
  (void)File;
  if (Line > 0) checks_failed++;
}

static int Positive(int Value) {
  Xil_AssertNonvoid(Value > 0);
  return Value;
}

static void Raised(void* Data) {
  interrupts += *(int*)Data;
}

int main(void) {
  static int three = 3;
  u32 word = 0x12345678, copy = 0;
  u8 nibble = 0;
  XTime begin, end;

  init_platform();
  Xil_AssertSetCallback(CheckFailed);
  Xil_AssertWait = FALSE;
  if (Positive(5) != 5 || Positive(-5) != 0 || checks_failed != 1) return XST_FAILURE;
  if (Xil_AssertStatus != XIL_ASSERT_OCCURRED) return XST_FAILURE;

  Xil_Out32(XPAR_GPIO_0_BASEADDR + 4, 0);
  if (Xil_TestIO32((u32*)XPAR_GPIO_0_BASEADDR, 4, 0x5A, XIL_TESTIO_DEFAULT, 0) != 0) {
    return XST_FAILURE;
  }
  if (Xil_WaitForEvent(XPAR_GPIO_0_BASEADDR + 8, 0xFF, 0x5A, 10) != XST_SUCCESS) return XST_FAILURE;
  if (Xil_WaitForEvent(XPAR_GPIO_0_BASEADDR + 8, 0xFF, 0xA5, 10) == XST_SUCCESS) return XST_FAILURE;
  if (Xil_ConvertCharToNibble('c', &nibble) != XST_SUCCESS || nibble != 12) return XST_FAILURE;
  Xil_MemCpy(&copy, &word, sizeof word);
  dsb();
  DATA_SYNC;
  INST_SYNC;
  SYNCHRONIZE_IO;
  if (copy != word) return XST_FAILURE;
  Xil_Out32BE((UINTPTR)&copy, 0x11223344);
  if (copy != 0x44332211 || Xil_In32BE((UINTPTR)&copy) != 0x11223344) return XST_FAILURE;
  if (Xil_Htons(0x1234) != 0x3412 || Xil_In16LE((UINTPTR)&copy) != 0x2211) return XST_FAILURE;

  XTime_GetTime(&begin);
  usleep(100);
  XTime_GetTime(&end);
  if ((end - begin) / COUNTS_PER_USECOND < 100 || (end - begin) / COUNTS_PER_USECOND > 110) {
    return XST_FAILURE;
  }

  if (XPAR_CPU_ID != 0U) return XST_FAILURE;
#ifndef PLATFORM_ZYNQ /* by which the vendor's scugic knows how many interrupts there are */
  return XST_FAILURE;
#endif
  if (XPS_EFUSE_BASEADDR != 0xF800D000U) return XST_FAILURE;
  XScuGic_DeviceInitialize(XPAR_SCUGIC_0_DEVICE_ID);
  XScuGic_RegisterHandler(XPAR_SCUGIC_0_CPU_BASEADDR, 3, Raised, &three);
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_IRQ_INT, XScuGic_DeviceInterruptHandler,
                               (void*)XPAR_SCUGIC_0_DEVICE_ID);
  XScuGic_EnableIntr(XPAR_SCUGIC_0_DIST_BASEADDR, 3);
  Xil_ExceptionEnable();
  XScuGic_WriteReg(XPAR_SCUGIC_0_DIST_BASEADDR, XSCUGIC_SFI_TRIG_OFFSET, 0x00010003);
  while (interrupts == 0)
    ;
  if (interrupts != 3) return XST_FAILURE;
  if (Xil_TestMem32(memory, 64, 0, XIL_TESTMEM_ALLMEMTESTS) != 0 || memory[63] != 0xDEADBEEF)
    return XST_FAILURE;
  XTimer_SetInterval(1);
  XTimer_SetHandler(Ticked, (void*)&ticks, 0xA0);
  msleep(5);
  if (ticks < 4 || ticks > 5) return XST_FAILURE;
  xil_printf("Successfully ran the odds and ends\r\n");
  return XST_SUCCESS;
}
