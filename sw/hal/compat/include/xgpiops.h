#ifndef XGPIOPS_H
#define XGPIOPS_H

/* GPIO of the processing system: pins 0 to 53 are MIO, 54 to 117 EMIO, in four banks. */

#include <xgpiops_hw.h>
#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XGPIOPS_IRQ_TYPE_EDGE_RISING 0x00U
#define XGPIOPS_IRQ_TYPE_EDGE_FALLING 0x01U
#define XGPIOPS_IRQ_TYPE_EDGE_BOTH 0x02U
#define XGPIOPS_IRQ_TYPE_LEVEL_HIGH 0x03U
#define XGPIOPS_IRQ_TYPE_LEVEL_LOW 0x04U

#define XGPIOPS_BANK0 0x00U
#define XGPIOPS_BANK1 0x01U
#define XGPIOPS_BANK2 0x02U
#define XGPIOPS_BANK3 0x03U
#define XGPIOPS_BANK_MAX_PINS 32U
#define XGPIOPS_MAX_BANKS 0x04U
#define XGPIOPS_DEVICE_MAX_PIN_NUM 118U

/** Called for each bank with an enabled event: which of its pins. */
typedef void (*XGpioPs_Handler)(void* CallBackRef, u32 Bank, u32 Status);

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddr;
  u16 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XGpioPs_Config;

typedef struct {
  XGpioPs_Config GpioConfig;
  u32 IsReady;
  XGpioPs_Handler Handler;
  void* CallBackRef;
  u32 Platform;
  u32 MaxPinNum;
  u8 MaxBanks;
} XGpioPs;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XGpioPs_Config* XGpioPs_LookupConfig(UINTPTR DeviceId);
/** Masks all interrupts. */
s32 XGpioPs_CfgInitialize(XGpioPs* InstancePtr, const XGpioPs_Config* ConfigPtr,
                          UINTPTR EffectiveAddr);
s32 XGpioPs_SelfTest(const XGpioPs* InstancePtr);

/** By bank, 0 to 3. A 1 in `Direction` is an output, a 1 in `OpEnable` drives it. */
u32 XGpioPs_Read(const XGpioPs* InstancePtr, u8 Bank);
void XGpioPs_Write(const XGpioPs* InstancePtr, u8 Bank, u32 Data);
void XGpioPs_SetDirection(const XGpioPs* InstancePtr, u8 Bank, u32 Direction);
u32 XGpioPs_GetDirection(const XGpioPs* InstancePtr, u8 Bank);
void XGpioPs_SetOutputEnable(const XGpioPs* InstancePtr, u8 Bank, u32 OpEnable);
u32 XGpioPs_GetOutputEnable(const XGpioPs* InstancePtr, u8 Bank);

/** By pin, 0 to 117. */
void XGpioPs_GetBankPin(u8 PinNumber, u8* BankNumber, u8* PinNumberInBank);
u32 XGpioPs_ReadPin(const XGpioPs* InstancePtr, u32 Pin);
void XGpioPs_WritePin(const XGpioPs* InstancePtr, u32 Pin, u32 Data);
void XGpioPs_SetDirectionPin(const XGpioPs* InstancePtr, u32 Pin, u32 Direction);
u32 XGpioPs_GetDirectionPin(const XGpioPs* InstancePtr, u32 Pin);
void XGpioPs_SetOutputEnablePin(const XGpioPs* InstancePtr, u32 Pin, u32 OpEnable);
u32 XGpioPs_GetOutputEnablePin(const XGpioPs* InstancePtr, u32 Pin);

/** Interrupts by bank. `IntrType` 1 for edges, `IntrPolarity` 1 for rising or high, `IntrOnAny` 1
 * for both edges. */
void XGpioPs_IntrEnable(const XGpioPs* InstancePtr, u8 Bank, u32 Mask);
void XGpioPs_IntrDisable(const XGpioPs* InstancePtr, u8 Bank, u32 Mask);
u32 XGpioPs_IntrGetEnabled(const XGpioPs* InstancePtr, u8 Bank);
u32 XGpioPs_IntrGetStatus(const XGpioPs* InstancePtr, u8 Bank);
void XGpioPs_IntrClear(const XGpioPs* InstancePtr, u8 Bank, u32 Mask);
void XGpioPs_SetIntrType(const XGpioPs* InstancePtr, u8 Bank, u32 IntrType, u32 IntrPolarity,
                         u32 IntrOnAny);
void XGpioPs_GetIntrType(const XGpioPs* InstancePtr, u8 Bank, u32* IntrType, u32* IntrPolarity,
                         u32* IntrOnAny);

/** Interrupts by pin. `IrqType` is XGPIOPS_IRQ_TYPE_… */
void XGpioPs_IntrEnablePin(const XGpioPs* InstancePtr, u32 Pin);
void XGpioPs_IntrDisablePin(const XGpioPs* InstancePtr, u32 Pin);
u32 XGpioPs_IntrGetEnabledPin(const XGpioPs* InstancePtr, u32 Pin);
u32 XGpioPs_IntrGetStatusPin(const XGpioPs* InstancePtr, u32 Pin);
void XGpioPs_IntrClearPin(const XGpioPs* InstancePtr, u32 Pin);
void XGpioPs_SetIntrTypePin(const XGpioPs* InstancePtr, u32 Pin, u8 IrqType);
u8 XGpioPs_GetIntrTypePin(const XGpioPs* InstancePtr, u32 Pin);

void XGpioPs_SetCallbackHandler(XGpioPs* InstancePtr, void* CallBackRef,
                                XGpioPs_Handler FuncPointer);
/** For the interrupt controller: clears the events of each bank and calls the handler. */
void XGpioPs_IntrHandler(const XGpioPs* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
