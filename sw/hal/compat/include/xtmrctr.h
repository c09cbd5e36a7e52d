#ifndef XTMRCTR_H
#define XTMRCTR_H

/* AXI timer: two counters each. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>
#include <xtmrctr_l.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XTC_CASCADE_MODE_OPTION 0x00000080UL
#define XTC_ENABLE_ALL_OPTION 0x00000040UL
#define XTC_DOWN_COUNT_OPTION 0x00000020UL
#define XTC_CAPTURE_MODE_OPTION 0x00000010UL
#define XTC_INT_MODE_OPTION 0x00000008UL
#define XTC_AUTO_RELOAD_OPTION 0x00000004UL
#define XTC_EXT_COMPARE_OPTION 0x00000002UL

typedef void (*XTmrCtr_Handler)(void* CallBackRef, u8 TmrCtrNumber);

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  u32 SysClockFreqHz;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XTmrCtr_Config;

typedef struct {
  u32 Interrupts;
} XTmrCtrStats;

typedef struct {
  XTmrCtr_Config Config;
  XTmrCtrStats Stats;
  UINTPTR BaseAddress;
  u32 IsReady;
  u32 IsStartedTmrCtr0;
  u32 IsStartedTmrCtr1;
  u32 IsPwmEnabled;
  XTmrCtr_Handler Handler;
  void* CallBackRef;
} XTmrCtr;

/** By number or, as releases with SDT ask, by base address. Else NULL. */
XTmrCtr_Config* XTmrCtr_LookupConfig(UINTPTR DeviceId);
void XTmrCtr_CfgInitialize(XTmrCtr* InstancePtr, XTmrCtr_Config* ConfigPtr, UINTPTR EffectiveAddr);
/** Stops both counters and takes their events away; XST_DEVICE_IS_STARTED if one was started. */
int XTmrCtr_InitHw(XTmrCtr* InstancePtr);
/** The three above in one; XST_DEVICE_NOT_FOUND if there is no such timer. */
int XTmrCtr_Initialize(XTmrCtr* InstancePtr, UINTPTR DeviceId);
int XTmrCtr_SelfTest(XTmrCtr* InstancePtr, u8 TmrCtrNumber);

/** From the reset value on. */
void XTmrCtr_Start(XTmrCtr* InstancePtr, u8 TmrCtrNumber);
void XTmrCtr_Stop(XTmrCtr* InstancePtr, u8 TmrCtrNumber);
/** Loads the reset value; a counter that counts keeps counting. */
void XTmrCtr_Reset(XTmrCtr* InstancePtr, u8 TmrCtrNumber);
u32 XTmrCtr_GetValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber);
void XTmrCtr_SetResetValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber, u32 ResetValue);
u32 XTmrCtr_GetCaptureValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber);
int XTmrCtr_IsExpired(XTmrCtr* InstancePtr, u8 TmrCtrNumber);

void XTmrCtr_SetOptions(XTmrCtr* InstancePtr, u8 TmrCtrNumber, u32 Options);
u32 XTmrCtr_GetOptions(XTmrCtr* InstancePtr, u8 TmrCtrNumber);

/** In ns. Returns the share of high time in percent; PWM is off until XTmrCtr_PwmEnable. */
u8 XTmrCtr_PwmConfigure(XTmrCtr* InstancePtr, u32 PwmPeriod, u32 PwmHighTime);
void XTmrCtr_PwmEnable(XTmrCtr* InstancePtr);
void XTmrCtr_PwmDisable(XTmrCtr* InstancePtr);

void XTmrCtr_SetHandler(XTmrCtr* InstancePtr, XTmrCtr_Handler FuncPtr, void* CallBackRef);
/** For the interrupt controller: a counter that does not reload is stopped and set to its reset
 * value. */
void XTmrCtr_InterruptHandler(void* InstancePtr);
void XTmrCtr_GetStats(XTmrCtr* InstancePtr, XTmrCtrStats* StatsPtr);
void XTmrCtr_ClearStats(XTmrCtr* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
