/* A light that blinks, by polling. */
#include "xgpio.h"
#include "xil_printf.h"
#include "xparameters.h"

#define LED 0x01
#define LED_CHANNEL 1
#define LED_DELAY 1000
#define GPIO_EXAMPLE_DEVICE_ID XPAR_GPIO_0_DEVICE_ID

XGpio Gpio;

int main(void) {
  int Status;
  volatile int Delay;
  int Blinks;

  Status = XGpio_Initialize(&Gpio, GPIO_EXAMPLE_DEVICE_ID);
  if (Status != XST_SUCCESS) {
    xil_printf("Gpio Initialization Failed\r\n");
    return XST_FAILURE;
  }
  XGpio_SetDataDirection(&Gpio, LED_CHANNEL, ~LED);
  for (Blinks = 0; Blinks < 3; Blinks++) {
    XGpio_DiscreteWrite(&Gpio, LED_CHANNEL, LED);
    for (Delay = 0; Delay < LED_DELAY; Delay++)
      ;
    if ((XGpio_DiscreteRead(&Gpio, 2) & LED) == 0) return XST_FAILURE;
    XGpio_DiscreteClear(&Gpio, LED_CHANNEL, LED);
    for (Delay = 0; Delay < LED_DELAY; Delay++)
      ;
  }
  xil_printf("Successfully ran Gpio Example\r\n");
  return XST_SUCCESS;
}
