// xiicps.h.
#include <hal/hal.h>
#include <ps_i2c_registers.h>
#include <xiicps.h>

namespace {

constexpr u32 failures = XIICPS_IXR_ARB_LOST_MASK | XIICPS_IXR_RX_UNF_MASK |
                         XIICPS_IXR_TX_OVR_MASK | XIICPS_IXR_RX_OVR_MASK | XIICPS_IXR_NACK_MASK;
constexpr s32 depth = XIICPS_FIFO_DEPTH;
constexpr s32 most = XIICPS_MAX_TRANSFER_SIZE;

u32 read(const XIicPs* i2c, u32 offset) {
  return XIicPs_ReadReg(i2c->Config.BaseAddress, offset);
}

void write(const XIicPs* i2c, u32 offset, u32 word) {
  XIicPs_WriteReg(i2c->Config.BaseAddress, offset, word);
}

void change_control(const XIicPs* i2c, u32 clear, u32 set) {
  write(i2c, XIICPS_CR_OFFSET, (read(i2c, XIICPS_CR_OFFSET) & ~clear) | set);
}

void clear_events(const XIicPs* i2c) {
  write(i2c, XIICPS_ISR_OFFSET, read(i2c, XIICPS_ISR_OFFSET));
}

/// As a master, with an empty FIFO; longer transfers than the FIFO, and those before a repeated
/// start, hold the bus.
void prepare(XIicPs* i2c, bool receives, s32 bytes) {
  u32 set = XIICPS_CR_MS_MASK | XIICPS_CR_ACKEN_MASK | XIICPS_CR_CLR_FIFO_MASK;
  if (!i2c->Is10BitAddr) set |= XIICPS_CR_NEA_MASK;
  if (receives) set |= XIICPS_CR_RD_WR_MASK;
  if (i2c->IsRepeatedStart || bytes > depth) set |= XIICPS_CR_HOLD_MASK;
  i2c->IsSend = !receives;
  change_control(i2c, XIICPS_CR_RD_WR_MASK | XIICPS_CR_NEA_MASK, set);
  clear_events(i2c);
}

void let_go(const XIicPs* i2c) {
  if (!i2c->IsRepeatedStart) change_control(i2c, XIICPS_CR_HOLD_MASK, 0);
}

/// In send mode the transfer size register counts what lies in the FIFO.
void fill(XIicPs* i2c) {
  s32 room = depth - static_cast<s32>(read(i2c, XIICPS_TRANS_SIZE_OFFSET));
  for (; room > 0 && i2c->SendByteCount > 0; --room, --i2c->SendByteCount) {
    write(i2c, XIICPS_DATA_OFFSET, *i2c->SendBufferPtr++);
  }
}

void ask_for(XIicPs* i2c) {
  i2c->CurrByteCount = i2c->RecvByteCount < most ? i2c->RecvByteCount : most;
  write(i2c, XIICPS_TRANS_SIZE_OFFSET, static_cast<u32>(i2c->CurrByteCount));
}

/// More than one load of the register: the next one is due while a full FIFO stretches the clock,
/// so that the count does not reach 0.
void ask_for_more(XIicPs* i2c) {
  while (read(i2c, XIICPS_TRANS_SIZE_OFFSET) != 1) {
  }
  const s32 left = i2c->RecvByteCount - depth;
  const s32 size = left < most ? left : most;
  write(i2c, XIICPS_TRANS_SIZE_OFFSET, static_cast<u32>(size));
  i2c->CurrByteCount = size + depth;
}

void drain(XIicPs* i2c) {
  while (i2c->CurrByteCount > 0 && (read(i2c, XIICPS_SR_OFFSET) & XIICPS_SR_RXDV_MASK) != 0) {
    *i2c->RecvBufferPtr++ = static_cast<u8>(read(i2c, XIICPS_DATA_OFFSET));
    --i2c->RecvByteCount;
    --i2c->CurrByteCount;
    if (i2c->CurrByteCount == depth + 1 && i2c->RecvByteCount > depth + 1) ask_for_more(i2c);
  }
}

/// All has left the FIFO. COMP alone may be that of a FIFO that ran empty before it was filled
/// again.
bool sent(const XIicPs* i2c, u32 events) {
  return (events & XIICPS_IXR_COMP_MASK) != 0 && i2c->SendByteCount == 0 &&
         read(i2c, XIICPS_TRANS_SIZE_OFFSET) == 0;
}

void start_send(XIicPs* i2c, u8* bytes, s32 count, u16 address) {
  i2c->SendBufferPtr = bytes;
  i2c->SendByteCount = count;
  prepare(i2c, false, count);
  fill(i2c);
  write(i2c, XIICPS_ADDR_OFFSET, address);
}

void start_receive(XIicPs* i2c, u8* bytes, s32 count, u16 address) {
  i2c->RecvBufferPtr = bytes;
  i2c->RecvByteCount = count;
  prepare(i2c, true, count);
  ask_for(i2c);
  write(i2c, XIICPS_ADDR_OFFSET, address);
}

s32 failed(XIicPs* i2c, u32 events) {
  XIicPs_Abort(i2c);
  return events & XIICPS_IXR_ARB_LOST_MASK ? XST_IIC_ARB_LOST : XST_FAILURE;
}

/// The failures of a transfer as one event of the program's handler.
u32 events_of(u32 failed) {
  u32 told = 0;
  if (failed & XIICPS_IXR_ARB_LOST_MASK) told |= XIICPS_EVENT_ARB_LOST;
  if (failed & XIICPS_IXR_NACK_MASK) told |= XIICPS_EVENT_NACK;
  if (failed & ~static_cast<u32>(XIICPS_IXR_ARB_LOST_MASK)) told |= XIICPS_EVENT_ERROR;
  return told;
}

void tell(XIicPs* i2c, u32 event) {
  if (i2c->StatusHandler) i2c->StatusHandler(i2c->CallBackRef, event);
}

}  // namespace

extern "C" {

XIicPs_Config* XIicPs_LookupConfig(UINTPTR DeviceId) {
  static XIicPs_Config configs[2];
  const u32 clock = HAL_XPAR(XIICPS_0_I2C_CLK_FREQ_HZ);
  configs[0] = {0, ps_i2c::i2c0_base, clock, 0x4000 + ps_i2c::i2c0_interrupt - 32, 0xF8F01000};
  configs[1] = {1, ps_i2c::i2c1_base, clock, 0x4000 + ps_i2c::i2c1_interrupt - 32, 0xF8F01000};
  for (XIicPs_Config& config : configs) {
    if (DeviceId == config.DeviceId || DeviceId == config.BaseAddress) return &config;
  }
  return nullptr;
}

s32 XIicPs_CfgInitialize(XIicPs* InstancePtr, XIicPs_Config* ConfigPtr, u32 EffectiveAddr) {
  Xil_AssertNonvoid(InstancePtr && ConfigPtr);
  *InstancePtr = {};
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  XIicPs_Reset(InstancePtr);
  InstancePtr->Options = XIicPs_GetOptions(InstancePtr);
  return XST_SUCCESS;
}

void XIicPs_Reset(XIicPs* InstancePtr) {
  XIicPs_Abort(InstancePtr);
  write(InstancePtr, XIICPS_CR_OFFSET, XIICPS_CR_RESET_VALUE);
  write(InstancePtr, XIICPS_TIME_OUT_OFFSET, XIICPS_TO_RESET_VALUE);
  XIicPs_DisableAllInterrupts(InstancePtr->Config.BaseAddress);
}

void XIicPs_Abort(XIicPs* InstancePtr) {
  XIicPs_DisableAllInterrupts(InstancePtr->Config.BaseAddress);
  change_control(InstancePtr, XIICPS_CR_HOLD_MASK, XIICPS_CR_CLR_FIFO_MASK);
  write(InstancePtr, XIICPS_TRANS_SIZE_OFFSET, 0);
  clear_events(InstancePtr);
}

s32 XIicPs_BusIsBusy(XIicPs* InstancePtr) {
  return (read(InstancePtr, XIICPS_SR_OFFSET) & XIICPS_SR_BA_MASK) != 0;
}

s32 XIicPs_SelfTest(XIicPs* InstancePtr) {
  constexpr u32 pattern = 0x05;
  XIicPs_Reset(InstancePtr);
  write(InstancePtr, XIICPS_SLV_PAUSE_OFFSET, pattern);
  const bool kept = read(InstancePtr, XIICPS_SLV_PAUSE_OFFSET) == pattern;
  const bool masked = read(InstancePtr, XIICPS_IMR_OFFSET) == XIICPS_IXR_ALL_INTR_MASK;
  XIicPs_Reset(InstancePtr);
  return kept && masked ? XST_SUCCESS : XST_FAILURE;
}

s32 XIicPs_SetOptions(XIicPs* InstancePtr, u32 Options) {
  if (Options & XIICPS_REP_START_OPTION) InstancePtr->IsRepeatedStart = 1;
  if (Options & XIICPS_7_BIT_ADDR_OPTION) InstancePtr->Is10BitAddr = 0;
  if (Options & XIICPS_10_BIT_ADDR_OPTION) InstancePtr->Is10BitAddr = 1;
  const u32 monitor = Options & XIICPS_SLAVE_MON_OPTION ? XIICPS_CR_SLVMON_MASK : 0;
  change_control(InstancePtr, XIICPS_CR_NEA_MASK,
                 monitor | (InstancePtr->Is10BitAddr ? 0 : XIICPS_CR_NEA_MASK));
  InstancePtr->Options = XIicPs_GetOptions(InstancePtr);
  return XST_SUCCESS;
}

s32 XIicPs_ClearOptions(XIicPs* InstancePtr, u32 Options) {
  if (Options & XIICPS_REP_START_OPTION) InstancePtr->IsRepeatedStart = 0;
  if (Options & XIICPS_7_BIT_ADDR_OPTION) InstancePtr->Is10BitAddr = 1;
  if (Options & XIICPS_10_BIT_ADDR_OPTION) InstancePtr->Is10BitAddr = 0;
  const u32 monitor = Options & XIICPS_SLAVE_MON_OPTION ? XIICPS_CR_SLVMON_MASK : 0;
  change_control(InstancePtr, XIICPS_CR_NEA_MASK | monitor,
                 InstancePtr->Is10BitAddr ? 0 : XIICPS_CR_NEA_MASK);
  InstancePtr->Options = XIicPs_GetOptions(InstancePtr);
  return XST_SUCCESS;
}

u32 XIicPs_GetOptions(XIicPs* InstancePtr) {
  const u32 control = read(InstancePtr, XIICPS_CR_OFFSET);
  u32 set = control & XIICPS_CR_NEA_MASK ? XIICPS_7_BIT_ADDR_OPTION : XIICPS_10_BIT_ADDR_OPTION;
  if (control & XIICPS_CR_SLVMON_MASK) set |= XIICPS_SLAVE_MON_OPTION;
  if (InstancePtr->IsRepeatedStart) set |= XIICPS_REP_START_OPTION;
  return set;
}

s32 XIicPs_SetSClk(XIicPs* InstancePtr, u32 FsclHz) {
  Xil_AssertNonvoid(FsclHz > 0);
  if (read(InstancePtr, XIICPS_TRANS_SIZE_OFFSET) != 0) return XST_DEVICE_IS_STARTED;
  const u32 clock = InstancePtr->Config.InputClockHz / ps_i2c::scl_divisor;
  const u32 ratio = clock / FsclHz;
  if (ratio == 0) return XST_FAILURE;
  u32 wanted = FsclHz > 384600 ? 384600 : FsclHz;
  if (wanted > 90000 && wanted <= 100000) wanted = 90000;
  const bool is_whole = InstancePtr->Config.InputClockHz % (ps_i2c::scl_divisor * wanted) == 0;
  u32 best_error = wanted, best_a = 0, best_b = 0;
  for (u32 product = ratio; product <= ratio + (is_whole ? 0 : 1); ++product) {
    for (u32 b = 0; b <= XIICPS_CR_DIV_B_MASK >> XIICPS_CR_DIV_B_SHIFT; ++b) {
      const u32 a = product > b ? product / (b + 1) - 1 : 0;
      if (a >= XIICPS_DIV_A_MAX) continue;
      const u32 given = clock / ((a + 1) * (b + 1));
      const u32 error = given > wanted ? given - wanted : wanted - given;
      if (error >= best_error) continue;
      best_error = error;
      best_a = a;
      best_b = b;
    }
  }
  change_control(InstancePtr, XIICPS_CR_DIV_A_MASK | XIICPS_CR_DIV_B_MASK,
                 best_a << XIICPS_CR_DIV_A_SHIFT | best_b << XIICPS_CR_DIV_B_SHIFT);
  return XST_SUCCESS;
}

u32 XIicPs_GetSClk(XIicPs* InstancePtr) {
  const u32 control = read(InstancePtr, XIICPS_CR_OFFSET);
  const u32 a = (control & XIICPS_CR_DIV_A_MASK) >> XIICPS_CR_DIV_A_SHIFT;
  const u32 b = (control & XIICPS_CR_DIV_B_MASK) >> XIICPS_CR_DIV_B_SHIFT;
  return InstancePtr->Config.InputClockHz / (ps_i2c::scl_divisor * (a + 1) * (b + 1));
}

s32 XIicPs_MasterSendPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr) {
  Xil_AssertNonvoid(InstancePtr->IsReady == XIL_COMPONENT_IS_READY && MsgPtr);
  start_send(InstancePtr, MsgPtr, ByteCount, SlaveAddr);
  for (u32 events = 0; !sent(InstancePtr, events);) {
    events = read(InstancePtr, XIICPS_ISR_OFFSET);
    if (events & failures) return failed(InstancePtr, events);
    if (InstancePtr->SendByteCount > 0) fill(InstancePtr);
  }
  let_go(InstancePtr);
  return XST_SUCCESS;
}

s32 XIicPs_MasterRecvPolled(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr) {
  Xil_AssertNonvoid(InstancePtr->IsReady == XIL_COMPONENT_IS_READY && MsgPtr);
  start_receive(InstancePtr, MsgPtr, ByteCount, SlaveAddr);
  while (InstancePtr->RecvByteCount > 0) {
    const u32 events = read(InstancePtr, XIICPS_ISR_OFFSET);
    if (events & failures) return failed(InstancePtr, events);
    drain(InstancePtr);
  }
  let_go(InstancePtr);
  return XST_SUCCESS;
}

void XIicPs_MasterSend(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr) {
  start_send(InstancePtr, MsgPtr, ByteCount, SlaveAddr);
  XIicPs_EnableInterrupts(InstancePtr->Config.BaseAddress, failures | XIICPS_IXR_COMP_MASK);
}

void XIicPs_MasterRecv(XIicPs* InstancePtr, u8* MsgPtr, s32 ByteCount, u16 SlaveAddr) {
  start_receive(InstancePtr, MsgPtr, ByteCount, SlaveAddr);
  XIicPs_EnableInterrupts(InstancePtr->Config.BaseAddress,
                          failures | XIICPS_IXR_COMP_MASK | XIICPS_IXR_DATA_MASK);
}

void XIicPs_MasterInterruptHandler(XIicPs* InstancePtr) {
  const u32 masked = read(InstancePtr, XIICPS_IMR_OFFSET);
  const u32 events = read(InstancePtr, XIICPS_ISR_OFFSET) & ~masked;
  write(InstancePtr, XIICPS_ISR_OFFSET, events);
  if (events & XIICPS_IXR_SLV_RDY_MASK) tell(InstancePtr, XIICPS_EVENT_SLAVE_RDY);
  if (events & failures) {
    XIicPs_Abort(InstancePtr);
    return tell(InstancePtr, events_of(events & failures));
  }
  if ((events & (XIICPS_IXR_COMP_MASK | XIICPS_IXR_DATA_MASK)) == 0) return;
  if (InstancePtr->IsSend) {
    if (InstancePtr->SendByteCount > 0) return fill(InstancePtr);
    if (!sent(InstancePtr, events)) return;
  } else {
    drain(InstancePtr);
    if (InstancePtr->RecvByteCount > 0 || (events & XIICPS_IXR_COMP_MASK) == 0) return;
  }
  XIicPs_DisableAllInterrupts(InstancePtr->Config.BaseAddress);
  let_go(InstancePtr);
  tell(InstancePtr, InstancePtr->IsSend ? XIICPS_EVENT_COMPLETE_SEND : XIICPS_EVENT_COMPLETE_RECV);
}

void XIicPs_SetStatusHandler(XIicPs* InstancePtr, void* CallBackRef,
                             XIicPs_IntrHandler FunctionPtr) {
  InstancePtr->StatusHandler = FunctionPtr;
  InstancePtr->CallBackRef = CallBackRef;
}

void XIicPs_EnableSlaveMonitor(XIicPs* InstancePtr, u16 SlaveAddr) {
  change_control(
      InstancePtr, XIICPS_CR_RD_WR_MASK,
      XIICPS_CR_MS_MASK | XIICPS_CR_NEA_MASK | XIICPS_CR_CLR_FIFO_MASK | XIICPS_CR_SLVMON_MASK);
  clear_events(InstancePtr);
  XIicPs_EnableInterrupts(InstancePtr->Config.BaseAddress, XIICPS_IXR_SLV_RDY_MASK);
  write(InstancePtr, XIICPS_SLV_PAUSE_OFFSET, 0xF);
  write(InstancePtr, XIICPS_ADDR_OFFSET, SlaveAddr);
}

void XIicPs_DisableSlaveMonitor(XIicPs* InstancePtr) {
  change_control(InstancePtr, XIICPS_CR_SLVMON_MASK, 0);
  XIicPs_DisableInterrupts(InstancePtr->Config.BaseAddress, XIICPS_IXR_SLV_RDY_MASK);
}

void XIicPs_ResetHw(UINTPTR BaseAddress) {
  XIicPs_DisableAllInterrupts(BaseAddress);
  XIicPs_WriteReg(BaseAddress, XIICPS_CR_OFFSET, XIICPS_CR_CLR_FIFO_MASK);
  XIicPs_WriteReg(BaseAddress, XIICPS_ISR_OFFSET, XIICPS_IXR_ALL_INTR_MASK);
  XIicPs_WriteReg(BaseAddress, XIICPS_TIME_OUT_OFFSET, XIICPS_TO_RESET_VALUE);
  XIicPs_WriteReg(BaseAddress, XIICPS_TRANS_SIZE_OFFSET, 0);
  XIicPs_WriteReg(BaseAddress, XIICPS_CR_OFFSET, 0);
}

}  // extern "C"
