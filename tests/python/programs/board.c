/* Copies four bytes from an EEPROM at I2C 0 to its other end, shows a button at MIO 50 as MIO 10, and prints the chip's
 * temperature. With registers alone, as a program without the vendor's drivers does it. */
#include <sleep.h>
#include <xil_io.h>
#include <xil_printf.h>
#include <xparameters.h>
#include <xstatus.h>

#define GPIO(offset) (XPAR_XGPIOPS_0_BASEADDR + (offset))
#define I2C(offset) (XPAR_XIICPS_0_BASEADDR + (offset))
#define XADC(offset) (XPAR_XADCPS_0_BASEADDR + (offset))

enum { CR = 0x00, ADDRESS = 0x08, DATA = 0x0C, ISR = 0x10, SIZE = 0x14 };
enum { COMP = 1, NACK = 4 };
enum { MASTER = 0x0E | 0x40 | 9 << 8, READ = 1, HOLD = 0x10 };

static int finished(void) {
  u32 events;
  do {
    usleep(1);
    events = Xil_In32(I2C(ISR));
  } while ((events & (COMP | NACK)) == 0);
  Xil_Out32(I2C(ISR), events);
  return (events & NACK) == 0;
}

static int transfer(u8 place, const u8* bytes, int count, int hold) {
  Xil_Out32(I2C(CR), MASTER | (hold ? HOLD : 0));
  Xil_Out32(I2C(DATA), place);
  for (int i = 0; i < count; i++) Xil_Out32(I2C(DATA), bytes[i]);
  Xil_Out32(I2C(ADDRESS), 0x50);
  return finished();
}

static u32 temperature(void) {
  Xil_Out32(XADC(0x18), 0);
  Xil_Out32(XADC(0x10), 1u << 26);
  Xil_In32(XADC(0x14));
  Xil_Out32(XADC(0x10), 0);
  return Xil_In32(XADC(0x14));
}

int main(void) {
  u8 bytes[4] = {0};
  if (!transfer(0x10, bytes, 0, 1)) {
    xil_printf("no EEPROM\r\n");
    return XST_FAILURE;
  }
  Xil_Out32(I2C(CR), MASTER | READ);
  Xil_Out32(I2C(SIZE), 4);
  Xil_Out32(I2C(ADDRESS), 0x50);
  if (!finished()) return XST_FAILURE;
  for (int i = 0; i < 4; i++) bytes[i] = (u8)Xil_In32(I2C(DATA));
  if (!transfer(0x20, bytes, 4, 0)) return XST_FAILURE;
  xil_printf("copied, temperature 0x%x\r\n", temperature());

  Xil_Out32(GPIO(0x204), 1u << 10);
  Xil_Out32(GPIO(0x208), 1u << 10);
  while ((Xil_In32(GPIO(0x64)) >> 18 & 1) == 0) usleep(10);
  Xil_Out32(GPIO(0x40), 1u << 10);
  usleep(10);
  xil_printf("button, loop-back %d\r\n", Xil_In32(GPIO(0x60)) >> 14 & 1);
  if ((Xil_In32(GPIO(0x64)) >> 19 & 1) != 0) Xil_In32(0xE0008000); /* MIO 51: CAN 0, which has no model */
  return XST_SUCCESS;
}
