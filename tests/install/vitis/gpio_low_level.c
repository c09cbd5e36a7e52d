/* The same light without a driver's instance: registers by their offsets. */
#include "xgpio_l.h"
#include "xil_printf.h"
#include "xparameters.h"
#include "xstatus.h"

#define GPIO_REG_BASEADDR XPAR_GPIO_0_BASEADDR

int main() {
  u32 Data;

  XGpio_WriteReg((GPIO_REG_BASEADDR), ((XGPIO_TRI_OFFSET)), (0));
  Data = XGpio_ReadReg(GPIO_REG_BASEADDR, XGPIO_TRI_OFFSET);
  if (Data != 0) return XST_FAILURE;
  XGpio_WriteReg(GPIO_REG_BASEADDR, XGPIO_DATA_OFFSET, 0x2A);
  Data = XGpio_ReadReg(GPIO_REG_BASEADDR, XGPIO_DATA_OFFSET);
  if (Data != 0x2A) return XST_FAILURE;
  Data = XGpio_ReadReg(GPIO_REG_BASEADDR, XGPIO_DATA_OFFSET + XGPIO_CHAN_OFFSET);
  if (Data != 0x2A) return XST_FAILURE;
  xil_printf("Successfully ran Gpio Low Level Example\r\n");
  return XST_SUCCESS;
}
