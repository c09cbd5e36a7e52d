#ifndef XSPIPS_H
#define XSPIPS_H

/* SPI controllers of the processing system as masters. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xspips_hw.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XSPIPS_MASTER_OPTION 0x00000001U
#define XSPIPS_CLK_ACTIVE_LOW_OPTION 0x00000002U
#define XSPIPS_CLK_PHASE_1_OPTION 0x00000004U
#define XSPIPS_DECODE_SSELECT_OPTION 0x00000008U
#define XSPIPS_FORCE_SSELECT_OPTION 0x00000010U
#define XSPIPS_MANUAL_START_OPTION 0x00000020U

#define XSPIPS_CLK_PRESCALE_4 0x01U
#define XSPIPS_CLK_PRESCALE_8 0x02U
#define XSPIPS_CLK_PRESCALE_16 0x03U
#define XSPIPS_CLK_PRESCALE_32 0x04U
#define XSPIPS_CLK_PRESCALE_64 0x05U
#define XSPIPS_CLK_PRESCALE_128 0x06U
#define XSPIPS_CLK_PRESCALE_256 0x07U

#define XSPIPS_EVENT_MODE_FAULT 1U
#define XSPIPS_EVENT_TRANSFER_DONE 2U
#define XSPIPS_EVENT_TRANSMIT_UNDERRUN 3U
#define XSPIPS_EVENT_RECEIVE_OVERRUN 4U

/** `StatusEvent` is XST_SPI_TRANSFER_DONE and the like, of xstatus.h. */
typedef void (*XSpiPs_StatusHandler)(const void* CallBackRef, u32 StatusEvent, u32 ByteCount);

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  u32 InputClockHz;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XSpiPs_Config;

typedef struct {
  XSpiPs_Config Config;
  u32 IsReady;
  u8* SendBufferPtr;
  u8* RecvBufferPtr;
  u32 RequestedBytes; /**< bytes that have not gone into the FIFO */
  u32 RemainingBytes; /**< bytes that have not come back */
  u32 IsBusy;
  u32 SlaveSelect; /**< in place in the control register */
  XSpiPs_StatusHandler StatusHandler;
  void* StatusRef;
} XSpiPs;

/** By number or, as releases with SDT ask, by base address. Else NULL. */
XSpiPs_Config* XSpiPs_LookupConfig(UINTPTR DeviceId);
s32 XSpiPs_CfgInitialize(XSpiPs* InstancePtr, const XSpiPs_Config* ConfigPtr, u32 EffectiveAddr);
void XSpiPs_Reset(XSpiPs* InstancePtr);
void XSpiPs_Abort(XSpiPs* InstancePtr);
s32 XSpiPs_SelfTest(XSpiPs* InstancePtr);

/** `RecvBufPtr` may be NULL. XST_DEVICE_BUSY while another transfer is under way. */
s32 XSpiPs_PolledTransfer(XSpiPs* InstancePtr, u8* SendBufPtr, u8* RecvBufPtr, u32 ByteCount);
/** Starts it; XSpiPs_InterruptHandler() carries it on and tells of its end. */
s32 XSpiPs_Transfer(XSpiPs* InstancePtr, u8* SendBufPtr, u8* RecvBufPtr, u32 ByteCount);
void XSpiPs_InterruptHandler(XSpiPs* InstancePtr);
void XSpiPs_SetStatusHandler(XSpiPs* InstancePtr, void* CallBackRef,
                             XSpiPs_StatusHandler FunctionPtr);

/** Slave 0 to 2, 0 to 15 with the decoder; with XSPIPS_FORCE_SSELECT_OPTION 15 selects none. It is
 * selected with the next transfer. */
s32 XSpiPs_SetSlaveSelect(XSpiPs* InstancePtr, u8 SlaveSel);
u8 XSpiPs_GetSlaveSelect(const XSpiPs* InstancePtr);
s32 XSpiPs_SetOptions(XSpiPs* InstancePtr, u32 Options);
u32 XSpiPs_GetOptions(const XSpiPs* InstancePtr);
s32 XSpiPs_SetClkPrescaler(const XSpiPs* InstancePtr, u8 Prescaler);
u8 XSpiPs_GetClkPrescaler(const XSpiPs* InstancePtr);
s32 XSpiPs_SetDelays(const XSpiPs* InstancePtr, u8 DelayNss, u8 DelayBtwn, u8 DelayAfter,
                     u8 DelayInit);
void XSpiPs_GetDelays(const XSpiPs* InstancePtr, u8* DelayNss, u8* DelayBtwn, u8* DelayAfter,
                      u8* DelayInit);

#define XSpiPs_IsManualStart(InstancePtr) \
  ((XSpiPs_GetOptions(InstancePtr) & XSPIPS_MANUAL_START_OPTION) ? TRUE : FALSE)
#define XSpiPs_IsManualChipSelect(InstancePtr) \
  ((XSpiPs_GetOptions(InstancePtr) & XSPIPS_FORCE_SSELECT_OPTION) ? TRUE : FALSE)
#define XSpiPs_IsDecodeSSelect(InstancePtr) \
  ((XSpiPs_GetOptions(InstancePtr) & XSPIPS_DECODE_SSELECT_OPTION) ? TRUE : FALSE)
#define XSpiPs_IsMaster(InstancePtr) \
  ((XSpiPs_GetOptions(InstancePtr) & XSPIPS_MASTER_OPTION) ? TRUE : FALSE)
#define XSpiPs_SetTXWatermark(InstancePtr, RegisterValue) \
  XSpiPs_WriteReg((InstancePtr)->Config.BaseAddress, XSPIPS_TXWR_OFFSET, (RegisterValue))
#define XSpiPs_GetTXWatermark(InstancePtr) \
  ((u8)XSpiPs_ReadReg((InstancePtr)->Config.BaseAddress, XSPIPS_TXWR_OFFSET))
#define XSpiPs_SetRXWatermark(InstancePtr, RegisterValue) \
  XSpiPs_WriteReg((InstancePtr)->Config.BaseAddress, XSPIPS_RXWR_OFFSET, (RegisterValue))
#define XSpiPs_GetRXWatermark(InstancePtr) \
  ((u8)XSpiPs_ReadReg((InstancePtr)->Config.BaseAddress, XSPIPS_RXWR_OFFSET))
#define XSpiPs_Enable(InstancePtr) \
  XSpiPs_WriteReg((InstancePtr)->Config.BaseAddress, XSPIPS_ER_OFFSET, XSPIPS_ER_ENABLE_MASK)
#define XSpiPs_Disable(InstancePtr) \
  XSpiPs_WriteReg((InstancePtr)->Config.BaseAddress, XSPIPS_ER_OFFSET, 0U)

#ifdef __cplusplus
}
#endif

#endif
