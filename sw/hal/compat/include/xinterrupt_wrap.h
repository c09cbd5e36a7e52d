#ifndef XINTERRUPT_WRAP_H
#define XINTERRUPT_WRAP_H

/*
 * Interrupts as releases from 2023.2 on set them up: a device's configuration says which it has
 * (IntrId) and to what controller it goes (IntrParent), and one call connects a handler. There is
 * one controller, that of the Cortex-A9. An IntrId has the number in bits 11:0 (counted from the
 * first of its kind), the sense in 15:12 (1 rising edge, 4 level high), and the kind: bit 20 a
 * core's own, bit 22 a software interrupt, neither a shared one.
 */

#include <xil_exception.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xscugic.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

enum XIntrType { XSPI, XPPI, XSGI };

#define XINTERRUPT_DEFAULT_PRIORITY 0xA0U
#define XINTC_TYPE_IS_SCUGIC 0U
#define XINTC_TYPE_IS_INTC 1U
#define XINTR_IS_EDGE_TRIGGERED 3U
#define XINTR_IS_LEVEL_TRIGGERED 1U
/* Senses of an IntrId. */
#define XIL_TRIG_LOW_TO_HIGH_EDGE 1U
#define XIL_TRIG_HIGH_TO_LOW_EDGE 2U
#define XIL_TRIG_ACTIVE_HIGH_LEVEL 4U
#define XIL_TRIG_ACTIVE_LOW_LEVEL 8U
#define XGet_IntcType(IntParent) ((IntParent)&1U)
#define XGet_BaseAddr(IntParent) ((IntParent) & ~(UINTPTR)1U)
#define XGet_IntrId(IntId) ((IntId)&0xFFFU)
#define XGet_TriggerType(IntId) (((IntId)&0xF000U) >> 12)
#define XGet_IntrType(IntId) (((IntId)&0x100000U) >> 20)
#define XIsIntrTypeSGI(IntId) (((IntId)&0x400000U) >> 22)
#define XGet_IntrOffset(IntId) (XIsIntrTypeSGI(IntId) ? 0U : XGet_IntrType(IntId) ? 16U : 32U)
#define XGetEncodedIntcBaseAddr(IntParent, IntcType) ((IntParent) | (IntcType))

/** Connects `IntrHandler`, which gets `DriverInstance`, and enables the interrupt, at the
 * controller and at the CPU. The first call sets up the controller. XST_FAILURE if `IntcParent` is
 * not a controller. */
int XSetupInterruptSystem(void* DriverInstance, void* IntrHandler, u32 IntrId, UINTPTR IntcParent,
                          u16 Priority);

/** Its steps. XST_FAILURE if `IntcParent` is not a controller, or was not set up. */
int XConfigInterruptCntrl(UINTPTR IntcParent);
int XConnectToInterruptCntrl(u32 IntrId, void* IntrHandler, void* CallBackRef, UINTPTR IntcParent);
/** It is started when it is set up. */
int XStartInterruptCntrl(u32 Mode, UINTPTR IntcParent);
/** `IntrHandler`: NULL for that of the controller. */
void XRegisterInterruptHandler(void* IntrHandler, UINTPTR IntcParent);
void XEnableIntrId(u32 IntrId, UINTPTR IntcParent);
void XSetPriorityTriggerType(u32 IntrId, u8 Priority, UINTPTR IntcParent);
void XGetPriorityTriggerType(u32 IntrId, u8* Priority, u8* Trigger, UINTPTR IntcParent);

void XDisableIntrId(u32 IntrId, UINTPTR IntcParent);
int XDisconnectInterruptCntrl(u32 IntrId, UINTPTR IntcParent);
void XStopInterruptCntrl(UINTPTR IntcParent);

/** The IntrId of an interrupt as UG585 numbers it. XST_FAILURE for another controller or kind. */
s32 XGetEncodedIntrId(u32 LegacyIntrId, u32 TriggerType, u8 IntrType, u8 IntcType, u32* IntrId);
/** Raises a software interrupt at the CPUs whose bits are set. */
s32 XTriggerSoftwareIntr(u32 IntrId, UINTPTR IntcParent, u32 Cpu_Id);

#ifdef __cplusplus
}
#endif

#endif
