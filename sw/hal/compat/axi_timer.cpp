// xtmrctr.h.
#include <hal/hal.h>
#include <xtmrctr.h>

#include "device_tables.h"

namespace {

// As with the vendor's driver, a control word goes back as it was read: the event in it, which a
// write of 1 takes away, is gone then.

constexpr u8 counters = XTC_DEVICE_TIMER_COUNT;
constexpr u32 ns_per_s = 1000000000;

/// An option and the bits of the control register that it is.
struct Option {
  u32 option, bits;
};
constexpr Option options[] = {
    {XTC_CASCADE_MODE_OPTION, XTC_CSR_CASC_MASK},
    {XTC_ENABLE_ALL_OPTION, XTC_CSR_ENABLE_ALL_MASK},
    {XTC_DOWN_COUNT_OPTION, XTC_CSR_DOWN_COUNT_MASK},
    {XTC_CAPTURE_MODE_OPTION, XTC_CSR_CAPTURE_MODE_MASK | XTC_CSR_EXT_CAPTURE_MASK},
    {XTC_INT_MODE_OPTION, XTC_CSR_ENABLE_INT_MASK},
    {XTC_AUTO_RELOAD_OPTION, XTC_CSR_AUTO_RELOAD_MASK},
    {XTC_EXT_COMPARE_OPTION, XTC_CSR_EXT_GENERATE_MASK},
};

u32 control(const XTmrCtr* timer, u8 number) {
  return XTmrCtr_GetControlStatusReg(timer->BaseAddress, number);
}

void set_control(const XTmrCtr* timer, u8 number, u32 word) {
  XTmrCtr_SetControlStatusReg(timer->BaseAddress, number, word);
}

u32& started(XTmrCtr* timer, u8 number) {
  return number == 0 ? timer->IsStartedTmrCtr0 : timer->IsStartedTmrCtr1;
}

void change_both(const XTmrCtr* timer, u32 clear, u32 set) {
  for (u8 n = 0; n < counters; ++n) set_control(timer, n, (control(timer, n) & ~clear) | set);
}

void serve(XTmrCtr* timer, u8 number) {
  constexpr u32 asks = XTC_CSR_ENABLE_INT_MASK | XTC_CSR_INT_OCCURED_MASK;
  if ((control(timer, number) & asks) != asks) return;
  ++timer->Stats.Interrupts;
  if (timer->Handler) timer->Handler(timer->CallBackRef, number);
  u32 word = control(timer, number);
  if ((word & (XTC_CSR_AUTO_RELOAD_MASK | XTC_CSR_CAPTURE_MODE_MASK)) == 0) {
    word &= ~u32{XTC_CSR_ENABLE_TMR_MASK};
    set_control(timer, number, word | XTC_CSR_LOAD_MASK);
  }
  set_control(timer, number, word | XTC_CSR_INT_OCCURED_MASK);
}

#define MARKERVP_AXI_TIMER(number)                                                   \
  {                                                                                  \
    number, MARKERVP_XPAR(TMRCTR_##number##_BASEADDR, 0),                            \
        MARKERVP_XPAR(TMRCTR_##number##_CLOCK_FREQ_HZ, 0),                           \
        MARKERVP_XPAR(XTMRCTR_##number##_INTERRUPTS, markervp_compat::no_interrupt), \
        XPAR_XSCUGIC_0_BASEADDR,                                                     \
  }

}  // namespace

extern "C" {

XTmrCtr_Config* XTmrCtr_LookupConfig(UINTPTR DeviceId) {
  static XTmrCtr_Config configs[] = MARKERVP_EACH_DEVICE(MARKERVP_AXI_TIMER);
  static const unsigned count = markervp_compat::devices(MARKERVP_XPAR(XTMRCTR_NUM_INSTANCES, 0));
  for (unsigned n = 0; n < count; ++n) {
    if (DeviceId == n || DeviceId == configs[n].BaseAddress) return &configs[n];
  }
  return nullptr;
}

void XTmrCtr_CfgInitialize(XTmrCtr* InstancePtr, XTmrCtr_Config* ConfigPtr, UINTPTR EffectiveAddr) {
  Xil_AssertVoid(InstancePtr && ConfigPtr);
  InstancePtr->Config = *ConfigPtr;
  InstancePtr->Config.BaseAddress = EffectiveAddr;
  InstancePtr->BaseAddress = EffectiveAddr;
  InstancePtr->Handler = nullptr;
  InstancePtr->CallBackRef = InstancePtr;
  InstancePtr->IsPwmEnabled = FALSE;
  InstancePtr->Stats = {};
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
}

int XTmrCtr_InitHw(XTmrCtr* InstancePtr) {
  int status = XST_DEVICE_IS_STARTED;
  for (u8 n = 0; n < counters; ++n) {
    if (started(InstancePtr, n) == XIL_COMPONENT_IS_STARTED) continue;
    XTmrCtr_SetLoadReg(InstancePtr->BaseAddress, n, 0);
    set_control(InstancePtr, n, XTC_CSR_INT_OCCURED_MASK | XTC_CSR_LOAD_MASK);
    set_control(InstancePtr, n, 0);
    status = XST_SUCCESS;
  }
  return status;
}

int XTmrCtr_Initialize(XTmrCtr* InstancePtr, UINTPTR DeviceId) {
  XTmrCtr_Config* config = XTmrCtr_LookupConfig(DeviceId);
  if (config == nullptr) return XST_DEVICE_NOT_FOUND;
  XTmrCtr_CfgInitialize(InstancePtr, config, config->BaseAddress);
  return XTmrCtr_InitHw(InstancePtr);
}

int XTmrCtr_SelfTest(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  if ((control(InstancePtr, TmrCtrNumber) & XTC_CSR_ENABLE_TMR_MASK) != 0)
    return XST_DEVICE_IS_STARTED;
  XTmrCtr_SetLoadReg(InstancePtr->BaseAddress, TmrCtrNumber, 0);
  XTmrCtr_Reset(InstancePtr, TmrCtrNumber);
  return XTmrCtr_GetValue(InstancePtr, TmrCtrNumber) == 0 ? XST_SUCCESS : XST_FAILURE;
}

void XTmrCtr_Start(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertVoid(TmrCtrNumber < counters);
  const u32 word = control(InstancePtr, TmrCtrNumber);
  set_control(InstancePtr, TmrCtrNumber, XTC_CSR_LOAD_MASK);
  started(InstancePtr, TmrCtrNumber) = XIL_COMPONENT_IS_STARTED;
  set_control(InstancePtr, TmrCtrNumber, word | XTC_CSR_ENABLE_TMR_MASK);
}

void XTmrCtr_Stop(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertVoid(TmrCtrNumber < counters);
  const u32 word = control(InstancePtr, TmrCtrNumber);
  set_control(InstancePtr, TmrCtrNumber, word & ~u32{XTC_CSR_ENABLE_TMR_MASK});
  started(InstancePtr, TmrCtrNumber) = 0;
}

void XTmrCtr_Reset(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertVoid(TmrCtrNumber < counters);
  const u32 word = control(InstancePtr, TmrCtrNumber);
  set_control(InstancePtr, TmrCtrNumber, word | XTC_CSR_LOAD_MASK);
  set_control(InstancePtr, TmrCtrNumber, word);
}

u32 XTmrCtr_GetValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertNonvoid(TmrCtrNumber < counters);
  return XTmrCtr_GetTimerCounterReg(InstancePtr->BaseAddress, TmrCtrNumber);
}

void XTmrCtr_SetResetValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber, u32 ResetValue) {
  Xil_AssertVoid(TmrCtrNumber < counters);
  XTmrCtr_SetLoadReg(InstancePtr->BaseAddress, TmrCtrNumber, ResetValue);
}

u32 XTmrCtr_GetCaptureValue(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertNonvoid(TmrCtrNumber < counters);
  return XTmrCtr_GetLoadReg(InstancePtr->BaseAddress, TmrCtrNumber);
}

int XTmrCtr_IsExpired(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  Xil_AssertNonvoid(TmrCtrNumber < counters);
  return XTmrCtr_HasEventOccurred(InstancePtr->BaseAddress, TmrCtrNumber);
}

void XTmrCtr_SetOptions(XTmrCtr* InstancePtr, u8 TmrCtrNumber, u32 Options) {
  Xil_AssertVoid(TmrCtrNumber < counters);
  u32 clear = 0, set = 0;
  for (const Option& option : options) {
    ((Options & option.option) != 0 ? set : clear) |= option.bits;
  }
  set_control(InstancePtr, TmrCtrNumber, (control(InstancePtr, TmrCtrNumber) & ~clear) | set);
}

u32 XTmrCtr_GetOptions(XTmrCtr* InstancePtr, u8 TmrCtrNumber) {
  const u32 word = control(InstancePtr, TmrCtrNumber);
  u32 set = 0;
  for (const Option& option : options) {
    if ((word & option.bits) != 0) set |= option.option;
  }
  return set;
}

// Both count down and reload: the first is the period, the second the time that the output is high.
u8 XTmrCtr_PwmConfigure(XTmrCtr* InstancePtr, u32 PwmPeriod, u32 PwmHighTime) {
  for (u8 n = 0; n < counters; ++n) XTmrCtr_Stop(InstancePtr, n);
  change_both(InstancePtr,
              XTC_CSR_CASC_MASK | XTC_CSR_EXT_GENERATE_MASK | XTC_CSR_CAPTURE_MODE_MASK,
              XTC_CSR_DOWN_COUNT_MASK | XTC_CSR_AUTO_RELOAD_MASK);
  const auto rounded = [](u64 of, u64 by) { return (of + by / 2) / by; };
  const u64 clock_ns = rounded(ns_per_s, InstancePtr->Config.SysClockFreqHz);
  if (PwmPeriod < PwmHighTime || PwmHighTime < 2 * clock_ns) return XST_INVALID_PARAM;
  const u64 period = rounded(PwmPeriod, clock_ns) - 2, high = rounded(PwmHighTime, clock_ns) - 2;
  XTmrCtr_SetResetValue(InstancePtr, 0, static_cast<u32>(period));
  XTmrCtr_SetResetValue(InstancePtr, 1, static_cast<u32>(high));
  return period == 0 ? 100 : static_cast<u8>(rounded(high * 100, period));
}

void XTmrCtr_PwmEnable(XTmrCtr* InstancePtr) {
  constexpr u32 output = XTC_CSR_ENABLE_PWM_MASK | XTC_CSR_EXT_GENERATE_MASK;
  change_both(InstancePtr, 0, output);
  for (u8 n = 0; n < counters; ++n) XTmrCtr_Start(InstancePtr, n);
  InstancePtr->IsPwmEnabled = TRUE;
}

void XTmrCtr_PwmDisable(XTmrCtr* InstancePtr) {
  change_both(InstancePtr, XTC_CSR_ENABLE_PWM_MASK, 0);
  for (u8 n = 0; n < counters; ++n) XTmrCtr_Stop(InstancePtr, n);
  InstancePtr->IsPwmEnabled = FALSE;
}

void XTmrCtr_SetHandler(XTmrCtr* InstancePtr, XTmrCtr_Handler FuncPtr, void* CallBackRef) {
  InstancePtr->Handler = FuncPtr;
  InstancePtr->CallBackRef = CallBackRef;
}

void XTmrCtr_InterruptHandler(void* InstancePtr) {
  for (u8 n = 0; n < counters; ++n) serve(static_cast<XTmrCtr*>(InstancePtr), n);
}

void XTmrCtr_GetStats(XTmrCtr* InstancePtr, XTmrCtrStats* StatsPtr) {
  *StatsPtr = InstancePtr->Stats;
}

void XTmrCtr_ClearStats(XTmrCtr* InstancePtr) {
  InstancePtr->Stats = {};
}

}  // extern "C"
