/* Takes the place of the vendor's driver in the test of VENDOR_BSP: the same names, other content.
 */
#ifndef XGPIO_H
#define XGPIO_H

#include "xgpio_l.h"
#include "xil_types.h"
#include "xstatus.h"

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  int InterruptPresent;
  int IsDual;
} XGpio_Config;

typedef struct {
  UINTPTR BaseAddress;
  u32 IsReady;
  u32 Writes; /* ours has none */
} XGpio;

int XGpio_Initialize(XGpio* InstancePtr, u16 DeviceId);
XGpio_Config* XGpio_LookupConfig(u16 DeviceId);
void XGpio_SetDataDirection(XGpio* InstancePtr, unsigned Channel, u32 DirectionMask);
u32 XGpio_DiscreteRead(XGpio* InstancePtr, unsigned Channel);
void XGpio_DiscreteWrite(XGpio* InstancePtr, unsigned Channel, u32 Mask);
void XGpio_DiscreteClear(XGpio* InstancePtr, unsigned Channel, u32 Mask);

#endif
