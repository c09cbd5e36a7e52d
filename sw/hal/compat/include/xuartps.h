#ifndef XUARTPS_H
#define XUARTPS_H

/* UART of the processing system. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xplatform_info.h>
#include <xstatus.h>
#include <xuartps_hw.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XUARTPS_DFT_BAUDRATE 115200U
#define XUARTPS_MIN_RATE 110U
#define XUARTPS_MAX_RATE 921600U

/* For XUartPs_SetOptions. */
#define XUARTPS_OPTION_SET_BREAK 0x0080U
#define XUARTPS_OPTION_STOP_BREAK 0x0040U
#define XUARTPS_OPTION_RESET_TMOUT 0x0020U
#define XUARTPS_OPTION_RESET_TX 0x0010U
#define XUARTPS_OPTION_RESET_RX 0x0008U
#define XUARTPS_OPTION_ASSERT_RTS 0x0004U
#define XUARTPS_OPTION_ASSERT_DTR 0x0002U
#define XUARTPS_OPTION_SET_FCM 0x0001U

#define XUARTPS_OPER_MODE_NORMAL (u8)0x00U
#define XUARTPS_OPER_MODE_AUTO_ECHO (u8)0x01U
#define XUARTPS_OPER_MODE_LOCAL_LOOP (u8)0x02U
#define XUARTPS_OPER_MODE_REMOTE_LOOP (u8)0x03U

#define XUARTPS_FORMAT_8_BITS 0U
#define XUARTPS_FORMAT_7_BITS 2U
#define XUARTPS_FORMAT_6_BITS 3U
#define XUARTPS_FORMAT_EVEN_PARITY 0U
#define XUARTPS_FORMAT_ODD_PARITY 1U
#define XUARTPS_FORMAT_SPACE_PARITY 2U
#define XUARTPS_FORMAT_MARK_PARITY 3U
#define XUARTPS_FORMAT_NO_PARITY 4U
#define XUARTPS_FORMAT_1_STOP_BIT 0U
#define XUARTPS_FORMAT_1_5_STOP_BIT 1U
#define XUARTPS_FORMAT_2_STOP_BIT 2U

/* Events passed to a handler. */
#define XUARTPS_EVENT_RECV_DATA 1U  /**< all that was asked for has come */
#define XUARTPS_EVENT_RECV_TOUT 2U  /**< nothing came for the receive time-out */
#define XUARTPS_EVENT_SENT_DATA 3U  /**< all has been handed to the FIFO, which is empty */
#define XUARTPS_EVENT_RECV_ERROR 4U /**< overrun, framing or parity */
#define XUARTPS_EVENT_MODEM 5U
#define XUARTPS_EVENT_PARE_FRAME_BRKE 6U
#define XUARTPS_EVENT_RECV_ORERR 7U

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  u32 InputClockHz;
  s32 ModemPinsConnected;
  u32 IntrId; /**< for XSetupInterruptSystem */
  UINTPTR IntrParent;
} XUartPs_Config;

typedef struct {
  u8* NextBytePtr;
  u32 RequestedBytes;
  u32 RemainingBytes;
} XUartPsBuffer;

typedef struct {
  u32 BaudRate;
  u32 DataBits;
  u32 Parity;
  u8 StopBits;
} XUartPsFormat;

typedef void (*XUartPs_Handler)(void* CallBackRef, u32 Event, u32 EventData);

typedef struct {
  XUartPs_Config Config;
  u32 InputClockHz;
  u32 IsReady;
  u32 BaudRate;
  XUartPsBuffer SendBuffer;
  XUartPsBuffer ReceiveBuffer;
  XUartPs_Handler Handler;
  void* CallBackRef;
  u32 Platform;
  u8 is_rxbs_error;
} XUartPs;

/** By number or, as releases with SDT ask, by base address. NULL if there is no such device. */
XUartPs_Config* XUartPs_LookupConfig(UINTPTR DeviceId);
/** 115200 baud, 8 data bits, no parity, one stop bit; receiver and transmitter on, no interrupts.
 * XST_UART_BAUD_ERROR if the clock gives no such rate. */
s32 XUartPs_CfgInitialize(XUartPs* InstancePtr, XUartPs_Config* Config, UINTPTR EffectiveAddr);

/** Puts what fits into the FIFO; with interrupts on, the handler sends the rest. Returns how many.
 */
u32 XUartPs_Send(XUartPs* InstancePtr, u8* BufferPtr, u32 NumBytes);
/** Takes what has come; with interrupts on, the handler takes the rest. Returns how many. */
u32 XUartPs_Recv(XUartPs* InstancePtr, u8* BufferPtr, u32 NumBytes);
u32 XUartPs_IsSending(XUartPs* InstancePtr);

#define XUartPs_GetChannelStatus(InstancePtr) \
  XUartPs_ReadReg((InstancePtr)->Config.BaseAddress, XUARTPS_SR_OFFSET)
#define XUartPs_GetModeControl(InstancePtr) \
  XUartPs_ReadReg((InstancePtr)->Config.BaseAddress, XUARTPS_CR_OFFSET)
#define XUartPs_SetModeControl(InstancePtr, RegisterValue) \
  XUartPs_WriteReg((InstancePtr)->Config.BaseAddress, XUARTPS_CR_OFFSET, (RegisterValue))

/** Exactly these: XUARTPS_OPTION_…. Breaks and modem lines are stored only. */
void XUartPs_SetOptions(XUartPs* InstancePtr, u16 Options);
u16 XUartPs_GetOptions(XUartPs* InstancePtr);
/** XUARTPS_MODEMSR_…. No modem line is wired. */
u16 XUartPs_GetModemStatus(XUartPs* InstancePtr);
/** Bytes in the receive FIFO that would stop the other end; below 4: none. */
void XUartPs_SetFlowDelay(XUartPs* InstancePtr, u8 FlowDelayValue);
u8 XUartPs_GetFlowDelay(XUartPs* InstancePtr);

/** XST_UART_BAUD_ERROR if no divisors come within 3 %. */
s32 XUartPs_SetBaudRate(XUartPs* InstancePtr, u32 BaudRate);
s32 XUartPs_SetDataFormat(XUartPs* InstancePtr, XUartPsFormat* FormatPtr);
void XUartPs_GetDataFormat(XUartPs* InstancePtr, XUartPsFormat* FormatPtr);
void XUartPs_SetOperMode(XUartPs* InstancePtr, u8 OperationMode);
u8 XUartPs_GetOperMode(XUartPs* InstancePtr);
/** Bytes in the receive FIFO that interrupt, 1 to 63. */
void XUartPs_SetFifoThreshold(XUartPs* InstancePtr, u8 TriggerLevel);
u8 XUartPs_GetFifoThreshold(XUartPs* InstancePtr);
/** In four bit times; 0: none. */
void XUartPs_SetRecvTimeout(XUartPs* InstancePtr, u8 RecvTimeout);
u8 XUartPs_GetRecvTimeout(XUartPs* InstancePtr);
void XUartPs_EnableUart(XUartPs* InstancePtr);
void XUartPs_DisableUart(XUartPs* InstancePtr);

u32 XUartPs_GetInterruptMask(XUartPs* InstancePtr);
/** Exactly these: XUARTPS_IXR_…. */
void XUartPs_SetInterruptMask(XUartPs* InstancePtr, u32 Mask);
void XUartPs_SetHandler(XUartPs* InstancePtr, XUartPs_Handler FuncPtr, void* CallBackRef);
/** For XScuGic_Connect: serves the interrupts of the device. */
void XUartPs_InterruptHandler(XUartPs* InstancePtr);
/** Sends bytes to itself. XST_UART_TEST_FAIL if one comes back wrong. */
s32 XUartPs_SelfTest(XUartPs* InstancePtr);

#ifdef __cplusplus
}
#endif

#endif
