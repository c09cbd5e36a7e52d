#include "xgpio.h"
#include "xil_printf.h"

static UINTPTR channel_of(XGpio* InstancePtr, unsigned Channel) {
  return InstancePtr->BaseAddress + (Channel - 1) * XGPIO_CHAN_OFFSET;
}

void XGpio_SetDataDirection(XGpio* InstancePtr, unsigned Channel, u32 DirectionMask) {
  XGpio_WriteReg(channel_of(InstancePtr, Channel), XGPIO_TRI_OFFSET, DirectionMask);
}

u32 XGpio_DiscreteRead(XGpio* InstancePtr, unsigned Channel) {
  return XGpio_ReadReg(channel_of(InstancePtr, Channel), XGPIO_DATA_OFFSET);
}

void XGpio_DiscreteWrite(XGpio* InstancePtr, unsigned Channel, u32 Mask) {
  InstancePtr->Writes++;
  xil_printf("another driver, write %d\r\n", (int)InstancePtr->Writes);
  XGpio_WriteReg(channel_of(InstancePtr, Channel), XGPIO_DATA_OFFSET, Mask);
}

void XGpio_DiscreteClear(XGpio* InstancePtr, unsigned Channel, u32 Mask) {
  XGpio_DiscreteWrite(InstancePtr, Channel, XGpio_DiscreteRead(InstancePtr, Channel) & ~Mask);
}
