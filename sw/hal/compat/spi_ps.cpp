// xspips.h.
#include <hal/hal.h>
#include <ps_spi_registers.h>
#include <xspips.h>

namespace {

/// An option and the bit of the control register that it is.
struct Option {
  u32 option, bit;
};
constexpr Option options[] = {
    {XSPIPS_MASTER_OPTION, XSPIPS_CR_MSTREN_MASK},
    {XSPIPS_CLK_ACTIVE_LOW_OPTION, XSPIPS_CR_CPOL_MASK},
    {XSPIPS_CLK_PHASE_1_OPTION, XSPIPS_CR_CPHA_MASK},
    {XSPIPS_DECODE_SSELECT_OPTION, XSPIPS_CR_SSDECEN_MASK},
    {XSPIPS_FORCE_SSELECT_OPTION, XSPIPS_CR_SSFORCE_MASK},
    {XSPIPS_MANUAL_START_OPTION, XSPIPS_CR_MANSTRTEN_MASK},
};

u32 read(const XSpiPs* spi, u32 offset) {
  return XSpiPs_ReadReg(spi->Config.BaseAddress, offset);
}

void write(const XSpiPs* spi, u32 offset, u32 word) {
  XSpiPs_WriteReg(spi->Config.BaseAddress, offset, word);
}

void change_control(const XSpiPs* spi, u32 clear, u32 set) {
  write(spi, XSPIPS_CR_OFFSET, (read(spi, XSPIPS_CR_OFFSET) & ~clear) | set);
}

bool has(const XSpiPs* spi, u32 control) {
  return (read(spi, XSPIPS_CR_OFFSET) & control) != 0;
}

void select(const XSpiPs* spi, u32 slave) {
  change_control(spi, XSPIPS_CR_SSCTRL_MASK, slave);
}

/// As many bytes as the FIFO takes, and never more than come back into the other one.
void fill(XSpiPs* spi) {
  const u32 under_way = spi->RemainingBytes - spi->RequestedBytes;
  for (u32 room = XSPIPS_FIFO_DEPTH - under_way; room > 0 && spi->RequestedBytes > 0; --room) {
    write(spi, XSPIPS_TXD_OFFSET, *spi->SendBufferPtr++);
    --spi->RequestedBytes;
  }
  if (has(spi, XSPIPS_CR_MANSTRTEN_MASK)) change_control(spi, 0, XSPIPS_CR_MANSTRT_MASK);
}

void take_back(XSpiPs* spi) {
  while (spi->RemainingBytes > spi->RequestedBytes &&
         (read(spi, XSPIPS_SR_OFFSET) & XSPIPS_IXR_RXNEMPTY_MASK) != 0) {
    const u8 byte = static_cast<u8>(read(spi, XSPIPS_RXD_OFFSET));
    if (spi->RecvBufferPtr) *spi->RecvBufferPtr++ = byte;
    --spi->RemainingBytes;
  }
}

s32 start(XSpiPs* spi, u8* to_send, u8* received, u32 bytes) {
  Xil_AssertNonvoid(spi->IsReady == XIL_COMPONENT_IS_READY && to_send && bytes > 0);
  if (spi->IsBusy) return XST_DEVICE_BUSY;
  spi->IsBusy = TRUE;
  spi->SendBufferPtr = to_send;
  spi->RecvBufferPtr = received;
  spi->RequestedBytes = spi->RemainingBytes = bytes;
  if (has(spi, XSPIPS_CR_SSFORCE_MASK)) select(spi, spi->SlaveSelect);
  XSpiPs_Enable(spi);
  fill(spi);
  return XST_SUCCESS;
}

void finish(XSpiPs* spi) {
  if (has(spi, XSPIPS_CR_SSFORCE_MASK)) select(spi, XSPIPS_CR_SSCTRL_MASK);
  XSpiPs_Disable(spi);
  spi->IsBusy = FALSE;
}

void tell(XSpiPs* spi, u32 event, u32 bytes) {
  if (spi->StatusHandler) spi->StatusHandler(spi->StatusRef, event, bytes);
}

}  // namespace

extern "C" {

XSpiPs_Config* XSpiPs_LookupConfig(UINTPTR DeviceId) {
  static XSpiPs_Config configs[2];
  const u32 clock = HAL_XPAR(XSPIPS_0_SPI_CLK_FREQ_HZ);
  configs[0] = {0, ps_spi::spi0_base, clock, 0x4000 + ps_spi::spi0_interrupt - 32, 0xF8F01000};
  configs[1] = {1, ps_spi::spi1_base, clock, 0x4000 + ps_spi::spi1_interrupt - 32, 0xF8F01000};
  for (XSpiPs_Config& config : configs) {
    if (DeviceId == config.DeviceId || DeviceId == config.BaseAddress) return &config;
  }
  return nullptr;
}

s32 XSpiPs_CfgInitialize(XSpiPs* InstancePtr, const XSpiPs_Config* ConfigPtr, u32 EffectiveAddr) {
  Xil_AssertNonvoid(InstancePtr && ConfigPtr);
  if (InstancePtr->IsBusy == TRUE && InstancePtr->IsReady == XIL_COMPONENT_IS_READY)
    return XST_DEVICE_IS_STARTED;
  *InstancePtr = {};
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  InstancePtr->SlaveSelect = XSPIPS_CR_SSCTRL_MASK;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  XSpiPs_Reset(InstancePtr);
  return XST_SUCCESS;
}

void XSpiPs_Reset(XSpiPs* InstancePtr) {
  XSpiPs_Abort(InstancePtr);
  write(InstancePtr, XSPIPS_CR_OFFSET, XSPIPS_CR_RESET_STATE);
}

void XSpiPs_Abort(XSpiPs* InstancePtr) {
  XSpiPs_Disable(InstancePtr);
  write(InstancePtr, XSPIPS_IDR_OFFSET, XSPIPS_IXR_DFLT_MASK);
  while ((read(InstancePtr, XSPIPS_SR_OFFSET) & XSPIPS_IXR_RXNEMPTY_MASK) != 0) {
    read(InstancePtr, XSPIPS_RXD_OFFSET);
  }
  write(InstancePtr, XSPIPS_SR_OFFSET, XSPIPS_IXR_WR_TO_CLR_MASK);
  InstancePtr->RemainingBytes = InstancePtr->RequestedBytes = 0;
  InstancePtr->IsBusy = FALSE;
}

s32 XSpiPs_SelfTest(XSpiPs* InstancePtr) {
  constexpr u8 delays[] = {0x5A, 0xA5, 0x12, 0x34};
  XSpiPs_Reset(InstancePtr);
  if (read(InstancePtr, XSPIPS_CR_OFFSET) != XSPIPS_CR_RESET_STATE) return XST_REGISTER_ERROR;
  XSpiPs_SetDelays(InstancePtr, delays[0], delays[1], delays[2], delays[3]);
  u8 kept[4] = {};
  XSpiPs_GetDelays(InstancePtr, &kept[0], &kept[1], &kept[2], &kept[3]);
  XSpiPs_SetDelays(InstancePtr, 0, 0, 0, 0);
  for (unsigned n = 0; n < 4; ++n) {
    if (kept[n] != delays[n]) return XST_REGISTER_ERROR;
  }
  return XST_SUCCESS;
}

s32 XSpiPs_PolledTransfer(XSpiPs* InstancePtr, u8* SendBufPtr, u8* RecvBufPtr, u32 ByteCount) {
  const s32 status = start(InstancePtr, SendBufPtr, RecvBufPtr, ByteCount);
  if (status != XST_SUCCESS) return status;
  for (;;) {
    take_back(InstancePtr);
    if (InstancePtr->RemainingBytes == 0) break;
    if ((read(InstancePtr, XSPIPS_SR_OFFSET) & XSPIPS_IXR_MODF_MASK) != 0) {
      XSpiPs_Abort(InstancePtr);
      return XST_SEND_ERROR;
    }
    if (InstancePtr->RequestedBytes > 0) fill(InstancePtr);
  }
  finish(InstancePtr);
  return XST_SUCCESS;
}

s32 XSpiPs_Transfer(XSpiPs* InstancePtr, u8* SendBufPtr, u8* RecvBufPtr, u32 ByteCount) {
  const s32 status = start(InstancePtr, SendBufPtr, RecvBufPtr, ByteCount);
  if (status == XST_SUCCESS) write(InstancePtr, XSPIPS_IER_OFFSET, XSPIPS_IXR_DFLT_MASK);
  return status;
}

// TXOW is up as long as the FIFO is nearly empty: it is there while the last byte is being sent.
void XSpiPs_InterruptHandler(XSpiPs* InstancePtr) {
  const u32 events = read(InstancePtr, XSPIPS_SR_OFFSET);
  write(InstancePtr, XSPIPS_SR_OFFSET, events & XSPIPS_IXR_WR_TO_CLR_MASK);
  // As the vendor counts them: those that went into the FIFO and did not come back.
  const u32 under_way = InstancePtr->RemainingBytes - InstancePtr->RequestedBytes;
  if ((events & XSPIPS_IXR_MODF_MASK) != 0) {
    XSpiPs_Abort(InstancePtr);
    return tell(InstancePtr, XST_SPI_MODE_FAULT, under_way);
  }
  if ((events & (XSPIPS_IXR_RXOVR_MASK | XSPIPS_IXR_TXUF_MASK)) != 0) finish(InstancePtr);
  if ((events & XSPIPS_IXR_RXOVR_MASK) != 0) tell(InstancePtr, XST_SPI_RECEIVE_OVERRUN, under_way);
  if ((events & XSPIPS_IXR_TXUF_MASK) != 0) tell(InstancePtr, XST_SPI_TRANSMIT_UNDERRUN, under_way);
  if (!InstancePtr->IsBusy) return;
  take_back(InstancePtr);
  if (InstancePtr->RequestedBytes > 0) return fill(InstancePtr);
  while (InstancePtr->RemainingBytes > 0) take_back(InstancePtr);
  write(InstancePtr, XSPIPS_IDR_OFFSET, XSPIPS_IXR_DFLT_MASK);
  finish(InstancePtr);
  tell(InstancePtr, XST_SPI_TRANSFER_DONE, 0);
}

void XSpiPs_SetStatusHandler(XSpiPs* InstancePtr, void* CallBackRef,
                             XSpiPs_StatusHandler FunctionPtr) {
  InstancePtr->StatusHandler = FunctionPtr;
  InstancePtr->StatusRef = CallBackRef;
}

s32 XSpiPs_SetSlaveSelect(XSpiPs* InstancePtr, u8 SlaveSel) {
  if (InstancePtr->IsBusy) return XST_DEVICE_BUSY;
  u32 code = SlaveSel;
  if (SlaveSel != XSPIPS_CR_SSCTRL_MAXIMUM && !XSpiPs_IsDecodeSSelect(InstancePtr)) {
    Xil_AssertNonvoid(SlaveSel <= 2);
    code = ~(1u << SlaveSel);  // the lowest bit that is 0
  }
  InstancePtr->SlaveSelect = code << XSPIPS_CR_SSCTRL_SHIFT & XSPIPS_CR_SSCTRL_MASK;
  if (!XSpiPs_IsManualChipSelect(InstancePtr)) select(InstancePtr, InstancePtr->SlaveSelect);
  return XST_SUCCESS;
}

u8 XSpiPs_GetSlaveSelect(const XSpiPs* InstancePtr) {
  const u32 code = InstancePtr->SlaveSelect >> XSPIPS_CR_SSCTRL_SHIFT;
  if (code == XSPIPS_CR_SSCTRL_MAXIMUM || XSpiPs_IsDecodeSSelect(InstancePtr))
    return static_cast<u8>(code);
  u8 slave = 0;
  while ((code >> slave & 1) != 0) ++slave;
  return slave;
}

s32 XSpiPs_SetOptions(XSpiPs* InstancePtr, u32 Options) {
  if (InstancePtr->IsBusy) return XST_DEVICE_BUSY;
  u32 clear = 0, set = 0;
  for (const Option& option : options) ((Options & option.option) != 0 ? set : clear) |= option.bit;
  change_control(InstancePtr, clear, set);
  return XST_SUCCESS;
}

u32 XSpiPs_GetOptions(const XSpiPs* InstancePtr) {
  const u32 control = read(InstancePtr, XSPIPS_CR_OFFSET);
  u32 set = 0;
  for (const Option& option : options) {
    if ((control & option.bit) != 0) set |= option.option;
  }
  return set;
}

s32 XSpiPs_SetClkPrescaler(const XSpiPs* InstancePtr, u8 Prescaler) {
  Xil_AssertNonvoid(Prescaler > 0 && Prescaler <= XSPIPS_CR_PRESC_MAXIMUM);
  if (InstancePtr->IsBusy) return XST_DEVICE_BUSY;
  change_control(InstancePtr, XSPIPS_CR_PRESC_MASK, u32{Prescaler} << XSPIPS_CR_PRESC_SHIFT);
  return XST_SUCCESS;
}

u8 XSpiPs_GetClkPrescaler(const XSpiPs* InstancePtr) {
  return static_cast<u8>((read(InstancePtr, XSPIPS_CR_OFFSET) & XSPIPS_CR_PRESC_MASK) >>
                         XSPIPS_CR_PRESC_SHIFT);
}

s32 XSpiPs_SetDelays(const XSpiPs* InstancePtr, u8 DelayNss, u8 DelayBtwn, u8 DelayAfter,
                     u8 DelayInit) {
  if (InstancePtr->IsBusy) return XST_DEVICE_BUSY;
  write(InstancePtr, XSPIPS_DR_OFFSET,
        u32{DelayNss} << XSPIPS_DR_NSS_SHIFT | u32{DelayBtwn} << XSPIPS_DR_BTWN_SHIFT |
            u32{DelayAfter} << XSPIPS_DR_AFTER_SHIFT | DelayInit);
  return XST_SUCCESS;
}

void XSpiPs_GetDelays(const XSpiPs* InstancePtr, u8* DelayNss, u8* DelayBtwn, u8* DelayAfter,
                      u8* DelayInit) {
  const u32 word = read(InstancePtr, XSPIPS_DR_OFFSET);
  *DelayNss = static_cast<u8>(word >> XSPIPS_DR_NSS_SHIFT);
  *DelayBtwn = static_cast<u8>(word >> XSPIPS_DR_BTWN_SHIFT);
  *DelayAfter = static_cast<u8>(word >> XSPIPS_DR_AFTER_SHIFT);
  *DelayInit = static_cast<u8>(word);
}

void XSpiPs_ResetHw(UINTPTR BaseAddress) {
  XSpiPs_WriteReg(BaseAddress, XSPIPS_IDR_OFFSET, XSPIPS_IXR_DISABLE_ALL_MASK);
  XSpiPs_WriteReg(BaseAddress, XSPIPS_ER_OFFSET, 0);
  XSpiPs_WriteReg(BaseAddress, XSPIPS_TXWR_OFFSET, XSPIPS_TXWR_RESET_VALUE);
  XSpiPs_WriteReg(BaseAddress, XSPIPS_RXWR_OFFSET, XSPIPS_RXWR_RESET_VALUE);
  while ((XSpiPs_ReadReg(BaseAddress, XSPIPS_SR_OFFSET) & XSPIPS_IXR_RXNEMPTY_MASK) != 0)
    (void)XSpiPs_ReadReg(BaseAddress, XSPIPS_RXD_OFFSET);
  XSpiPs_WriteReg(BaseAddress, XSPIPS_SR_OFFSET, XSPIPS_IXR_WR_TO_CLR_MASK);
  XSpiPs_WriteReg(BaseAddress, XSPIPS_CR_OFFSET, XSPIPS_CR_RESET_STATE | XSPIPS_CR_SSCTRL_MASK);
}

}  // extern "C"
