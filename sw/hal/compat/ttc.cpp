// xttcps.h.
#include <hal/hal.h>
#include <ttc_registers.h>
#include <xttcps.h>

namespace {

constexpr u32 counters = 2 * ttc::counter_count;
constexpr u8 no_prescaler = XTTCPS_CLK_CNTRL_PS_DISABLE;

/// An option and the bit that it is.
struct Option {
  u32 option, offset, bit;
};
constexpr Option options[] = {
    {XTTCPS_OPTION_EXTERNAL_CLK, XTTCPS_CLK_CNTRL_OFFSET, XTTCPS_CLK_CNTRL_SRC_MASK},
    {XTTCPS_OPTION_CLK_EDGE_NEG, XTTCPS_CLK_CNTRL_OFFSET, XTTCPS_CLK_CNTRL_EXT_EDGE_MASK},
    {XTTCPS_OPTION_INTERVAL_MODE, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_INT_MASK},
    {XTTCPS_OPTION_DECREMENT, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_DECR_MASK},
    {XTTCPS_OPTION_MATCH_MODE, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_MATCH_MASK},
    {XTTCPS_OPTION_WAVE_DISABLE, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_EN_WAVE_MASK},
    {XTTCPS_OPTION_WAVE_POLARITY, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_POL_WAVE_MASK},
};

u32 match_offset(u8 index) {
  return XTTCPS_MATCH_0_OFFSET + index * (XTTCPS_MATCH_1_OFFSET - XTTCPS_MATCH_0_OFFSET);
}

}  // namespace

extern "C" {

XTtcPs_Config* XTtcPs_LookupConfig(UINTPTR DeviceId) {
  static XTtcPs_Config configs[counters];
  for (u32 n = 0; n < counters; ++n) {
    const bool second = n >= ttc::counter_count;
    const u32 base =
        (second ? ttc::ttc1_base : ttc::ttc0_base) + n % ttc::counter_count * ttc::counter_stride;
    if (DeviceId != n && DeviceId != base) continue;
    const u32 first = 0x4000 + (second ? ttc::ttc1_interrupt : ttc::ttc0_interrupt) - 32;
    configs[n] = {static_cast<u16>(n),
                  base,
                  HAL_XPAR(XTTCPS_0_TTC_CLK_FREQ_HZ),
                  {first, first + 1, first + 2},
                  0xF8F01000};
    return &configs[n];
  }
  return nullptr;
}

s32 XTtcPs_CfgInitialize(XTtcPs* InstancePtr, XTtcPs_Config* ConfigPtr, u32 EffectiveAddr) {
  Xil_AssertNonvoid(InstancePtr && ConfigPtr);
  *InstancePtr = {};
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  if (XTtcPs_IsStarted(InstancePtr)) return XST_DEVICE_IS_STARTED;
  InstWriteReg(InstancePtr, XTTCPS_CNT_CNTRL_OFFSET, XTTCPS_CNT_CNTRL_RESET_VALUE);
  InstWriteReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET, 0);
  InstWriteReg(InstancePtr, XTTCPS_INTERVAL_VAL_OFFSET, 0);
  for (u8 n = 0; n < XTTCPS_NUM_MATCH_REG; ++n) InstWriteReg(InstancePtr, match_offset(n), 0);
  InstWriteReg(InstancePtr, XTTCPS_IER_OFFSET, 0);
  XTtcPs_GetInterruptStatus(InstancePtr);
  XTtcPs_ResetCounterValue(InstancePtr);
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

s32 XTtcPs_SelfTest(XTtcPs* InstancePtr) {
  const u32 control = InstReadReg(InstancePtr, XTTCPS_CNT_CNTRL_OFFSET);
  return control == XTTCPS_CNT_CNTRL_RESET_VALUE ? XST_SUCCESS : XST_FAILURE;
}

void XTtcPs_SetMatchValue(XTtcPs* InstancePtr, u8 MatchIndex, XMatchRegValue Value) {
  Xil_AssertVoid(MatchIndex < XTTCPS_NUM_MATCH_REG);
  InstWriteReg(InstancePtr, match_offset(MatchIndex), Value);
}

XMatchRegValue XTtcPs_GetMatchValue(XTtcPs* InstancePtr, u8 MatchIndex) {
  Xil_AssertNonvoid(MatchIndex < XTTCPS_NUM_MATCH_REG);
  return static_cast<XMatchRegValue>(InstReadReg(InstancePtr, match_offset(MatchIndex)));
}

void XTtcPs_SetPrescaler(XTtcPs* InstancePtr, u8 PrescalerValue) {
  constexpr u32 bits = XTTCPS_CLK_CNTRL_PS_EN_MASK | XTTCPS_CLK_CNTRL_PS_VAL_MASK;
  u32 control = InstReadReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET) & ~bits;
  if (PrescalerValue < no_prescaler) {
    control |= u32{PrescalerValue} << XTTCPS_CLK_CNTRL_PS_VAL_SHIFT | XTTCPS_CLK_CNTRL_PS_EN_MASK;
  }
  InstWriteReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET, control);
}

u8 XTtcPs_GetPrescaler(XTtcPs* InstancePtr) {
  const u32 control = InstReadReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET);
  if ((control & XTTCPS_CLK_CNTRL_PS_EN_MASK) == 0) return no_prescaler;
  return static_cast<u8>((control & XTTCPS_CLK_CNTRL_PS_VAL_MASK) >> XTTCPS_CLK_CNTRL_PS_VAL_SHIFT);
}

// The smallest prescaler whose interval has 16 bits.
void XTtcPs_CalcIntervalFromFreq(XTtcPs* InstancePtr, u32 Freq, XInterval* Interval,
                                 u8* Prescaler) {
  *Interval = XTTCPS_MAX_INTERVAL_COUNT;
  *Prescaler = 0xFF;
  const u32 clocks = Freq == 0 ? 0 : InstancePtr->Config.InputClockHz / Freq;
  if (clocks < 4) return;  // no interval of use
  if (clocks <= XTTCPS_MAX_INTERVAL_COUNT) {
    *Interval = static_cast<XInterval>(clocks);
    *Prescaler = no_prescaler;
    return;
  }
  for (u8 power = 0; power < no_prescaler; ++power) {
    const u32 counts = clocks >> (power + 1);
    if (counts > XTTCPS_MAX_INTERVAL_COUNT) continue;
    *Interval = static_cast<XInterval>(counts);
    *Prescaler = power;
    return;
  }
}

s32 XTtcPs_SetOptions(XTtcPs* InstancePtr, u32 Options) {
  u32 clock = InstReadReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET);
  u32 control = InstReadReg(InstancePtr, XTTCPS_CNT_CNTRL_OFFSET);
  for (const Option& option : options) {
    u32& word = option.offset == XTTCPS_CLK_CNTRL_OFFSET ? clock : control;
    word = (Options & option.option) != 0 ? word | option.bit : word & ~option.bit;
  }
  InstWriteReg(InstancePtr, XTTCPS_CLK_CNTRL_OFFSET, clock);
  InstWriteReg(InstancePtr, XTTCPS_CNT_CNTRL_OFFSET, control);
  return XST_SUCCESS;
}

u32 XTtcPs_GetOptions(XTtcPs* InstancePtr) {
  u32 set = 0;
  for (const Option& option : options) {
    if ((InstReadReg(InstancePtr, option.offset) & option.bit) != 0) set |= option.option;
  }
  return set;
}

void XTtcPs_SetStatusHandler(XTtcPs* InstancePtr, void* CallBackRef,
                             XTtcPs_StatusHandler FuncPointer) {
  InstancePtr->StatusHandler = FuncPointer;
  InstancePtr->StatusRef = CallBackRef;
}

u32 XTtcPs_InterruptHandler(XTtcPs* InstancePtr) {
  const u32 events = XTtcPs_GetInterruptStatus(InstancePtr);
  if (InstancePtr->StatusHandler) InstancePtr->StatusHandler(InstancePtr->StatusRef, events);
  return XST_SUCCESS;
}

}  // extern "C"
