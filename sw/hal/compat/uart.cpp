// xuartps.h.
#include <hal/hal.h>
#include <uart_registers.h>
#include <xuartps.h>

namespace {

constexpr std::uint32_t worst_error_percent = 3;
constexpr std::uint32_t errors = uart::event::ROVR | uart::event::FRAME | uart::event::PARE;

std::uint32_t read(const XUartPs* instance, std::uint32_t offset) {
  return hal_read32(static_cast<std::uint32_t>(instance->Config.BaseAddress) + offset);
}

void write(const XUartPs* instance, std::uint32_t offset, std::uint32_t word) {
  hal_write32(static_cast<std::uint32_t>(instance->Config.BaseAddress) + offset, word);
}

void replace_mode(const XUartPs* instance, std::uint32_t mask, std::uint32_t bits) {
  write(instance, uart::MR, (read(instance, uart::MR) & ~mask) | bits);
}

/// The register bit of an option of XUartPs_SetOptions.
struct Option {
  u16 option;
  std::uint32_t offset, bit;
};
constexpr Option options[] = {
    {XUARTPS_OPTION_SET_BREAK, uart::CR, uart::cr::STTBRK},
    {XUARTPS_OPTION_STOP_BREAK, uart::CR, uart::cr::STPBRK},
    {XUARTPS_OPTION_RESET_TMOUT, uart::CR, uart::cr::TORST},
    {XUARTPS_OPTION_RESET_TX, uart::CR, uart::cr::TXRES},
    {XUARTPS_OPTION_RESET_RX, uart::CR, uart::cr::RXRES},
    {XUARTPS_OPTION_ASSERT_RTS, uart::MODEMCR, uart::modemcr::RTS},
    {XUARTPS_OPTION_ASSERT_DTR, uart::MODEMCR, uart::modemcr::DTR},
    {XUARTPS_OPTION_SET_FCM, uart::MODEMCR, uart::modemcr::FCM},
};

u32 send_some(XUartPs* instance) {
  XUartPsBuffer& buffer = instance->SendBuffer;
  u32 sent = 0;
  while (buffer.RemainingBytes != 0 && !(read(instance, uart::SR) & uart::sr::TFUL)) {
    write(instance, uart::FIFO, *buffer.NextBytePtr++);
    --buffer.RemainingBytes;
    ++sent;
  }
  return sent;
}

u32 receive_some(XUartPs* instance) {
  XUartPsBuffer& buffer = instance->ReceiveBuffer;
  u32 received = 0;
  while (buffer.RemainingBytes != 0 && !(read(instance, uart::SR) & uart::sr::REMPTY)) {
    *buffer.NextBytePtr++ = static_cast<u8>(read(instance, uart::FIFO));
    --buffer.RemainingBytes;
    ++received;
  }
  return received;
}

void tell(XUartPs* instance, u32 event, u32 bytes) {
  if (instance->Handler != nullptr) instance->Handler(instance->CallBackRef, event, bytes);
}

void serve_receiver(XUartPs* instance, u32 event) {
  XUartPsBuffer& buffer = instance->ReceiveBuffer;
  if (buffer.RemainingBytes != 0) receive_some(instance);
  const u32 received = buffer.RequestedBytes - buffer.RemainingBytes;
  // A time-out that delivers the last requested bytes counts as received data.
  if (buffer.RemainingBytes == 0 && event == XUARTPS_EVENT_RECV_TOUT)
    event = XUARTPS_EVENT_RECV_DATA;
  if (buffer.RemainingBytes == 0 || event != XUARTPS_EVENT_RECV_DATA)
    tell(instance, event, received);
}

}  // namespace

extern "C" {

void XUartPs_SendByte(UINTPTR BaseAddress, u8 Data) {
  while (XUartPs_IsTransmitFull(BaseAddress)) {
  }
  XUartPs_WriteReg(BaseAddress, uart::FIFO, Data);
}

void XUartPs_WaitTransmitDone(UINTPTR BaseAddress) {
  while (!XUartPs_IsTransmitFifoEmpty(BaseAddress) || XUartPs_IsTransmitActive(BaseAddress)) {
  }
}

u8 XUartPs_RecvByte(UINTPTR BaseAddress) {
  while (!XUartPs_IsReceiveData(BaseAddress)) {
  }
  return static_cast<u8>(XUartPs_ReadReg(BaseAddress, uart::FIFO));
}

void XUartPs_ResetHw(UINTPTR BaseAddress) {
  XUartPs_WriteReg(BaseAddress, uart::IDR, uart::event::all);
  XUartPs_WriteReg(BaseAddress, uart::CR,
                   uart::cr::RXRES | uart::cr::TXRES | uart::cr::RXDIS | uart::cr::TXDIS);
  XUartPs_WriteReg(BaseAddress, uart::ISR, uart::event::all);
  XUartPs_WriteReg(BaseAddress, uart::MR, 0);
  XUartPs_WriteReg(BaseAddress, uart::RXWM, XUARTPS_RXWM_RESET_VAL);
  XUartPs_WriteReg(BaseAddress, uart::TX_FIFO_LEVEL, XUARTPS_TXWM_RESET_VAL);
  XUartPs_WriteReg(BaseAddress, uart::RXTOUT, XUARTPS_RXTOUT_DISABLE);
  XUartPs_WriteReg(BaseAddress, uart::MODEMCR, 0);
  XUartPs_WriteReg(BaseAddress, uart::FLOW_DELAY, 0);
  XUartPs_WriteReg(BaseAddress, uart::BAUDGEN, XUARTPS_BAUDGEN_RESET_VAL);
  XUartPs_WriteReg(BaseAddress, uart::BAUD_DIV, XUARTPS_BAUDDIV_RESET_VAL);
}

XUartPs_Config* XUartPs_LookupConfig(UINTPTR DeviceId) {
  static XUartPs_Config configs[] = {
      {0, HAL_XPAR(XUARTPS_0_BASEADDR), HAL_XPAR(XUARTPS_0_UART_CLK_FREQ_HZ), 0,
       HAL_XPAR(XUARTPS_0_INTERRUPTS), XPAR_XUARTPS_0_INTERRUPT_PARENT},
#ifdef XPAR_XUARTPS_1_BASEADDR
      {1, HAL_XPAR(XUARTPS_1_BASEADDR), HAL_XPAR(XUARTPS_1_UART_CLK_FREQ_HZ), 0,
       HAL_XPAR(XUARTPS_1_INTERRUPTS), XPAR_XUARTPS_1_INTERRUPT_PARENT},
#endif
  };
  for (UINTPTR number = 0; number < HAL_XPAR(XUARTPS_NUM_INSTANCES); ++number) {
    if (DeviceId == number || DeviceId == configs[number].BaseAddress) return &configs[number];
  }
  return nullptr;
}

s32 XUartPs_CfgInitialize(XUartPs* InstancePtr, XUartPs_Config* Config, UINTPTR EffectiveAddr) {
  *InstancePtr = {};
  InstancePtr->Config = *Config;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  InstancePtr->InputClockHz = Config->InputClockHz;
  write(InstancePtr, uart::IDR, uart::event::all);
  const s32 status = XUartPs_SetBaudRate(InstancePtr, XUARTPS_DFT_BAUDRATE);
  if (status != XST_SUCCESS) return status;
  write(InstancePtr, uart::MR, uart::mr::PAR_none);
  write(InstancePtr, uart::RXWM, 8);
  write(InstancePtr, uart::RXTOUT, 1);
  write(InstancePtr, uart::ISR, uart::event::all);
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

u32 XUartPs_Send(XUartPs* InstancePtr, u8* BufferPtr, u32 NumBytes) {
  constexpr std::uint32_t wanted = uart::event::TEMPTY | uart::event::TFUL;
  write(InstancePtr, uart::IDR, wanted);
  InstancePtr->SendBuffer = {BufferPtr, NumBytes, NumBytes};
  const u32 sent = send_some(InstancePtr);
  if (read(InstancePtr, uart::IMR) != 0) write(InstancePtr, uart::IER, wanted);
  return sent;
}

u32 XUartPs_Recv(XUartPs* InstancePtr, u8* BufferPtr, u32 NumBytes) {
  const u32 enabled = read(InstancePtr, uart::IMR);
  write(InstancePtr, uart::IDR, uart::event::all);
  InstancePtr->ReceiveBuffer = {BufferPtr, NumBytes, NumBytes};
  const u32 received = receive_some(InstancePtr);
  write(InstancePtr, uart::IER, enabled);
  return received;
}

u32 XUartPs_IsSending(XUartPs* InstancePtr) {
  const u32 status = read(InstancePtr, uart::SR);
  const bool sends = (status & uart::sr::TACTIVE) != 0 || (status & uart::sr::TEMPTY) == 0;
  return sends ? TRUE : FALSE;
}

s32 XUartPs_SetBaudRate(XUartPs* InstancePtr, u32 BaudRate) {
  if (BaudRate == 0) return XST_UART_BAUD_ERROR;
  const u32 clock =
      InstancePtr->InputClockHz / (read(InstancePtr, uart::MR) & uart::mr::CLKS ? 8 : 1);
  u32 best_generator = 0, best_divider = 0, best_error = BaudRate;
  for (u32 divider = uart::smallest_baud_div; divider <= 0xFF; ++divider) {
    const u64 step = u64{BaudRate} * (divider + 1);
    const u64 generator = clock / step;
    if (generator == 0 || generator > 0xFFFF) continue;
    const u32 rate = static_cast<u32>(clock / (generator * (divider + 1)));
    const u32 error = rate > BaudRate ? rate - BaudRate : BaudRate - rate;
    if (error >= best_error) continue;
    best_error = error;
    best_generator = static_cast<u32>(generator);
    best_divider = divider;
  }
  if (u64{best_error} * 100 > u64{BaudRate} * worst_error_percent) return XST_UART_BAUD_ERROR;
  write(InstancePtr, uart::CR, uart::cr::TXDIS | uart::cr::RXDIS);
  write(InstancePtr, uart::BAUDGEN, best_generator);
  write(InstancePtr, uart::BAUD_DIV, best_divider);
  write(InstancePtr, uart::CR, uart::cr::TXRES | uart::cr::RXRES);
  XUartPs_EnableUart(InstancePtr);
  InstancePtr->BaudRate = BaudRate;
  return XST_SUCCESS;
}

s32 XUartPs_SetDataFormat(XUartPs* InstancePtr, XUartPsFormat* FormatPtr) {
  if (FormatPtr->DataBits > XUARTPS_FORMAT_6_BITS || FormatPtr->Parity > XUARTPS_FORMAT_NO_PARITY ||
      FormatPtr->StopBits > XUARTPS_FORMAT_2_STOP_BIT) {
    return XST_INVALID_PARAM;
  }
  replace_mode(InstancePtr, uart::mr::CHRL | uart::mr::PAR | uart::mr::NBSTOP,
               FormatPtr->DataBits << uart::mr::CHRL_shift |
                   FormatPtr->Parity << uart::mr::PAR_shift |
                   static_cast<u32>(FormatPtr->StopBits) << uart::mr::NBSTOP_shift);
  return XUartPs_SetBaudRate(InstancePtr, FormatPtr->BaudRate);
}

void XUartPs_GetDataFormat(XUartPs* InstancePtr, XUartPsFormat* FormatPtr) {
  const u32 mode = read(InstancePtr, uart::MR);
  FormatPtr->BaudRate = InstancePtr->BaudRate;
  FormatPtr->DataBits = (mode & uart::mr::CHRL) >> uart::mr::CHRL_shift;
  FormatPtr->Parity = (mode & uart::mr::PAR) >> uart::mr::PAR_shift;
  FormatPtr->StopBits = static_cast<u8>((mode & uart::mr::NBSTOP) >> uart::mr::NBSTOP_shift);
}

void XUartPs_SetOptions(XUartPs* InstancePtr, u16 Options) {
  for (const Option& option : options) {
    const u32 others = read(InstancePtr, option.offset) & ~option.bit;
    write(InstancePtr, option.offset, others | ((Options & option.option) != 0 ? option.bit : 0));
  }
}

u16 XUartPs_GetOptions(XUartPs* InstancePtr) {
  unsigned set = 0;
  for (const Option& option : options) {
    if ((read(InstancePtr, option.offset) & option.bit) != 0) set |= option.option;
  }
  return static_cast<u16>(set);
}

u16 XUartPs_GetModemStatus(XUartPs* InstancePtr) {
  return static_cast<u16>(read(InstancePtr, uart::MODEMSR));
}

void XUartPs_SetFlowDelay(XUartPs* InstancePtr, u8 FlowDelayValue) {
  write(InstancePtr, uart::FLOW_DELAY, FlowDelayValue & XUARTPS_FLOWDEL_MASK);
}

u8 XUartPs_GetFlowDelay(XUartPs* InstancePtr) {
  return static_cast<u8>(read(InstancePtr, uart::FLOW_DELAY) & XUARTPS_FLOWDEL_MASK);
}

void XUartPs_SetOperMode(XUartPs* InstancePtr, u8 OperationMode) {
  replace_mode(InstancePtr, uart::mr::CHMODE, u32{OperationMode} << uart::mr::CHMODE_shift);
}

u8 XUartPs_GetOperMode(XUartPs* InstancePtr) {
  return static_cast<u8>((read(InstancePtr, uart::MR) & uart::mr::CHMODE) >>
                         uart::mr::CHMODE_shift);
}

void XUartPs_SetFifoThreshold(XUartPs* InstancePtr, u8 TriggerLevel) {
  write(InstancePtr, uart::RXWM, TriggerLevel & XUARTPS_RXWM_MASK);
}

u8 XUartPs_GetFifoThreshold(XUartPs* InstancePtr) {
  return static_cast<u8>(read(InstancePtr, uart::RXWM) & XUARTPS_RXWM_MASK);
}

void XUartPs_SetRecvTimeout(XUartPs* InstancePtr, u8 RecvTimeout) {
  write(InstancePtr, uart::RXTOUT, RecvTimeout);
  write(InstancePtr, uart::CR, read(InstancePtr, uart::CR) | uart::cr::TORST);
}

u8 XUartPs_GetRecvTimeout(XUartPs* InstancePtr) {
  return static_cast<u8>(read(InstancePtr, uart::RXTOUT));
}

void XUartPs_EnableUart(XUartPs* InstancePtr) {
  write(InstancePtr, uart::CR, uart::cr::TXEN | uart::cr::RXEN);
}

void XUartPs_DisableUart(XUartPs* InstancePtr) {
  write(InstancePtr, uart::CR, uart::cr::TXDIS | uart::cr::RXDIS);
}

u32 XUartPs_GetInterruptMask(XUartPs* InstancePtr) {
  return read(InstancePtr, uart::IMR);
}

void XUartPs_SetInterruptMask(XUartPs* InstancePtr, u32 Mask) {
  write(InstancePtr, uart::IER, Mask & uart::event::all);
  write(InstancePtr, uart::IDR, ~Mask & uart::event::all);
}

void XUartPs_SetHandler(XUartPs* InstancePtr, XUartPs_Handler FuncPtr, void* CallBackRef) {
  InstancePtr->Handler = FuncPtr;
  InstancePtr->CallBackRef = CallBackRef;
}

void XUartPs_InterruptHandler(XUartPs* InstancePtr) {
  const u32 events = read(InstancePtr, uart::IMR) & read(InstancePtr, uart::ISR);
  write(InstancePtr, uart::ISR, events);
  if (events & (uart::event::RTRIG | uart::event::RFUL | uart::event::REMPTY)) {
    serve_receiver(InstancePtr, XUARTPS_EVENT_RECV_DATA);
  }
  if (events & uart::event::TIMEOUT) serve_receiver(InstancePtr, XUARTPS_EVENT_RECV_TOUT);
  if (events & errors) serve_receiver(InstancePtr, XUARTPS_EVENT_RECV_ERROR);
  if (events & (uart::event::TEMPTY | uart::event::TFUL)) {
    if (InstancePtr->SendBuffer.RemainingBytes != 0) {
      send_some(InstancePtr);
    } else if (events & uart::event::TEMPTY) {
      write(InstancePtr, uart::IDR, uart::event::TEMPTY | uart::event::TFUL);
      tell(InstancePtr, XUARTPS_EVENT_SENT_DATA, InstancePtr->SendBuffer.RequestedBytes);
    }
  }
  if (events & uart::event::DMSI) tell(InstancePtr, XUARTPS_EVENT_MODEM, 0);
}

s32 XUartPs_SelfTest(XUartPs* InstancePtr) {
  const u32 enabled = read(InstancePtr, uart::IMR), mode = read(InstancePtr, uart::MR);
  write(InstancePtr, uart::IDR, uart::event::all);
  XUartPs_SetOperMode(InstancePtr, XUARTPS_OPER_MODE_LOCAL_LOOP);
  s32 result = XST_SUCCESS;
  for (u32 byte = 0; byte < 0x100 && result == XST_SUCCESS; byte += 0x11) {
    XUartPs_SendByte(InstancePtr->Config.BaseAddress, static_cast<u8>(byte));
    if (XUartPs_RecvByte(InstancePtr->Config.BaseAddress) != byte) result = XST_UART_TEST_FAIL;
  }
  write(InstancePtr, uart::MR, mode);
  write(InstancePtr, uart::IER, enabled);
  return result;
}

}  // extern "C"
