#ifndef XGPIO_H
#define XGPIO_H

/* AXI GPIO (PG144). */

#include <xgpio_l.h>
#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  int InterruptPresent;
  int IsDual;
  u32 IntrId; /**< for XSetupInterruptSystem; 0xFFFF: none */
  UINTPTR IntrParent;
} XGpio_Config;

typedef struct {
  UINTPTR BaseAddress;
  u32 IsReady;
  int InterruptPresent;
  int IsDual;
} XGpio;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XGpio_Config* XGpio_LookupConfig(UINTPTR DeviceId);
int XGpio_CfgInitialize(XGpio* InstancePtr, XGpio_Config* Config, UINTPTR EffectiveAddr);
/** XST_DEVICE_NOT_FOUND if there is no such device. */
int XGpio_Initialize(XGpio* InstancePtr, UINTPTR DeviceId);
/** XST_SUCCESS if the device was initialised. */
int XGpio_SelfTest(XGpio* InstancePtr);

/** `Channel` is 1 or 2; a 1 in `DirectionMask` is an input. */
void XGpio_SetDataDirection(XGpio* InstancePtr, unsigned Channel, u32 DirectionMask);
u32 XGpio_GetDataDirection(XGpio* InstancePtr, unsigned Channel);
u32 XGpio_DiscreteRead(XGpio* InstancePtr, unsigned Channel);
void XGpio_DiscreteWrite(XGpio* InstancePtr, unsigned Channel, u32 Mask);
void XGpio_DiscreteSet(XGpio* InstancePtr, unsigned Channel, u32 Mask);
void XGpio_DiscreteClear(XGpio* InstancePtr, unsigned Channel, u32 Mask);

/** Interrupts need a device that was built with them. `Mask`: XGPIO_IR_CH1_MASK, XGPIO_IR_CH2_MASK.
 */
void XGpio_InterruptGlobalEnable(XGpio* InstancePtr);
void XGpio_InterruptGlobalDisable(XGpio* InstancePtr);
void XGpio_InterruptEnable(XGpio* InstancePtr, u32 Mask);
void XGpio_InterruptDisable(XGpio* InstancePtr, u32 Mask);
void XGpio_InterruptClear(XGpio* InstancePtr, u32 Mask);
u32 XGpio_InterruptGetEnabled(XGpio* InstancePtr);
u32 XGpio_InterruptGetStatus(XGpio* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
