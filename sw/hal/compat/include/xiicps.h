#ifndef XIICPS_H
#define XIICPS_H

/* I2C controllers of the processing system as masters. A call of the slave's side does not link:
 * the platform has no model of it. */

#include <xiicps_hw.h>
#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XIICPS_7_BIT_ADDR_OPTION 0x01U
#define XIICPS_10_BIT_ADDR_OPTION 0x02U
#define XIICPS_SLAVE_MON_OPTION 0x04U
#define XIICPS_REP_START_OPTION 0x08U

#define XIICPS_EVENT_COMPLETE_SEND 0x0001U
#define XIICPS_EVENT_COMPLETE_RECV 0x0002U
#define XIICPS_EVENT_TIME_OUT 0x0004U
#define XIICPS_EVENT_ERROR 0x0008U
#define XIICPS_EVENT_ARB_LOST 0x0010U
#define XIICPS_EVENT_NACK 0x0020U
#define XIICPS_EVENT_SLAVE_RDY 0x0040U
#define XIICPS_EVENT_RX_OVR 0x0080U
#define XIICPS_EVENT_TX_OVR 0x0100U
#define XIICPS_EVENT_RX_UNF 0x0200U

/** The most that one load of the transfer size register asks for. */
#define XIICPS_MAX_TRANSFER_SIZE 252U

typedef void (*XIicPs_IntrHandler)(void* CallBackRef, u32 StatusEvent);

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  u32 InputClockHz;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XIicPs_Config;

typedef struct {
  XIicPs_Config Config;
  u32 IsReady;
  u32 Options;
  u8* SendBufferPtr;
  u8* RecvBufferPtr;
  s32 SendByteCount; /**< bytes that have not gone into the FIFO */
  s32 RecvByteCount; /**< bytes that have not come out of it */
  s32 CurrByteCount; /**< of those, how many the controller was asked for */
  s32 IsSend;
  s32 IsRepeatedStart; /**< the bus is kept after a transfer */
  s32 Is10BitAddr;
  XIicPs_IntrHandler StatusHandler;
  void* CallBackRef;
} XIicPs;

/** By number or, as releases with SDT ask, by base address. Else NULL. */
XIicPs_Config* XIicPs_LookupConfig(UINTPTR DeviceId);
s32 XIicPs_CfgInitialize(XIicPs* InstancePtr, XIicPs_Config* ConfigPtr, u32 EffectiveAddr);
void XIicPs_Reset(XIicPs* InstancePtr);
/** Ends what is under way, and lets the bus go. */
void XIicPs_Abort(XIicPs* InstancePtr);
s32 XIicPs_BusIsBusy(XIicPs* InstancePtr);
s32 XIicPs_SelfTest(XIicPs* InstancePtr);

s32 XIicPs_SetOptions(XIicPs* InstancePtr, u32 Options);
s32 XIicPs_ClearOptions(XIicPs* InstancePtr, u32 Options);
u32 XIicPs_GetOptions(XIicPs* InstancePtr);
/** The clock nearest to FsclHz, which may be above it. The controller is not asked for more than
 * 384.6 kHz, nor for 90 to 100 kHz: that becomes 90 kHz. XST_FAILURE if FsclHz is more than the
 * input clock / 22, XST_DEVICE_IS_STARTED during a transfer. */
s32 XIicPs_SetSClk(XIicPs* InstancePtr, u32 FsclHz);
u32 XIicPs_GetSClk(XIicPs* InstancePtr);

/** Return when the transfer is over: XST_FAILURE if nothing acknowledged, XST_IIC_ARB_LOST if
 * another master has the bus. */
s32 XIicPs_MasterSendPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr);
s32 XIicPs_MasterRecvPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr);

/** Start a transfer; XIicPs_MasterInterruptHandler() carries it on and tells of its end. */
void XIicPs_MasterSend(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr);
void XIicPs_MasterRecv(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr);
void XIicPs_MasterInterruptHandler(XIicPs* InstancePtr);
void XIicPs_SetStatusHandler(XIicPs* InstancePtr, void* CallBackRef,
                             XIicPs_IntrHandler FunctionPtr);

/** Polls an address until a device answers there: event XIICPS_EVENT_SLAVE_RDY. */
void XIicPs_EnableSlaveMonitor(XIicPs* InstancePtr, u16 SlaveAddr);
void XIicPs_DisableSlaveMonitor(XIicPs* InstancePtr);

void XIicPs_SetupSlave(XIicPs* InstancePtr, u16 SlaveAddr);
void XIicPs_SlaveSend(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount);
void XIicPs_SlaveRecv(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount);
s32 XIicPs_SlaveSendPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount);
s32 XIicPs_SlaveRecvPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount);
void XIicPs_SlaveInterruptHandler(XIicPs* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
