// xtime_l.h, sleep.h and xil_exception.h.
#include <cstdarg>

#include <algorithm>
#include <array>

#include <global_timer_registers.h>
#include <hal/hal.h>
#include <sleep.h>
#include <xil_assert.h>
#include <xil_exception.h>
#include <xil_printf.h>
#include <xil_testio.h>
#include <xil_util.h>
#include <xtime_l.h>

namespace {

constexpr std::uint32_t at(std::uint32_t offset) {
  return global_timer::base + offset;
}

/// Cycles that one look at the timer may make pass on the virtual platform.
constexpr std::uint64_t longest_step = 1u << 30;

/// On the chip one look follows the other; on the platform each makes all of the time pass.
void wait_counts(u64 counts) {
  XTime now = 0;
  XTime_GetTime(&now);
  const XTime end = now + counts;
  while (now < end) {
    const std::uint64_t cycles = (end - now) * global_timer::cpu_cycles_per_tick;
    hal_poll_until_changed(at(global_timer::COUNTER_LOW), 0,
                           static_cast<std::uint32_t>(std::min(cycles, longest_step)), 1);
    XTime_GetTime(&now);
  }
}

struct Handler {
  Xil_ExceptionHandler function;
  void* data;
};
std::array<Handler, XIL_EXCEPTION_ID_LAST + 1> handlers{};

}  // namespace

extern "C" {

void Xil_ExceptionRegisterHandler(u32 Exception_id, Xil_ExceptionHandler Handler, void* Data) {
  if (Exception_id >= handlers.size()) return;
  handlers[Exception_id] = {Handler, Data};
  if (Exception_id == XIL_EXCEPTION_ID_IRQ_INT) hal_interrupt_connect(Handler, Data);
  if (Exception_id == XIL_EXCEPTION_ID_FIQ_INT && Handler != nullptr) {
    hal_warn(
        "Xil_ExceptionRegisterHandler of FIQ, which is not modelled: the handler is never called; "
        "register it for XIL_EXCEPTION_ID_IRQ_INT");
  }
}

void Xil_ExceptionRemoveHandler(u32 Exception_id) {
  Xil_ExceptionRegisterHandler(Exception_id, nullptr, nullptr);
}

void Xil_GetExceptionRegisterHandler(u32 Exception_id, Xil_ExceptionHandler* Handler, void** Data) {
  if (Exception_id >= handlers.size()) return;
  *Handler = handlers[Exception_id].function;
  *Data = handlers[Exception_id].data;
}

void XTime_GetTime(XTime* Xtime_Global) {
  std::uint32_t high = hal_read32(at(global_timer::COUNTER_HIGH));
  for (;;) {
    const std::uint32_t low = hal_read32(at(global_timer::COUNTER_LOW));
    const std::uint32_t again = hal_read32(at(global_timer::COUNTER_HIGH));
    if (again == high) {
      *Xtime_Global = static_cast<XTime>(high) << 32 | low;
      return;
    }
    high = again;
  }
}

void XTime_SetTime(XTime Xtime_Global) {
  const std::uint32_t control = hal_read32(at(global_timer::CONTROL));
  hal_write32(at(global_timer::CONTROL), control & ~global_timer::control::Timer_Enable);
  hal_write32(at(global_timer::COUNTER_LOW), static_cast<std::uint32_t>(Xtime_Global));
  hal_write32(at(global_timer::COUNTER_HIGH), static_cast<std::uint32_t>(Xtime_Global >> 32));
  hal_write32(at(global_timer::CONTROL), control | global_timer::control::Timer_Enable);
}

int usleep(unsigned int useconds) {
  wait_counts(static_cast<u64>(useconds) * COUNTS_PER_SECOND / 1'000'000);
  return 0;
}

unsigned int sleep(unsigned int seconds) {
  wait_counts(static_cast<u64>(seconds) * COUNTS_PER_SECOND);
  return 0;
}

void msleep(unsigned long mseconds) {
  wait_counts(static_cast<u64>(mseconds) * COUNTS_PER_SECOND / 1'000);
}

}  // extern "C"

// xil_assert.h, xil_util.h and xil_testio.h.

namespace {

Xil_AssertCallback assert_callback = nullptr;

}  // namespace

extern "C" {

u32 Xil_AssertStatus = XIL_ASSERT_NONE;
s32 Xil_AssertWait = 1;

void Xil_AssertSetCallback(Xil_AssertCallback Routine) {
  assert_callback = Routine;
}

// The vendor's waits here for ever; a trap ends the run and says where it was.
void Xil_Assert(const char8* File, s32 Line) {
  if (assert_callback != nullptr) assert_callback(File, Line);
  if (Xil_AssertWait == 0) return;
  xil_printf("%s:%d: an argument is not as the driver needs it\n", File, static_cast<int>(Line));
  __builtin_trap();
}

void XNullHandler(void*) {}

u32 Xil_WaitForEvent(UINTPTR RegAddr, u32 EventMask, u32 Event, u32 Timeout) {
  for (u32 looks = 0; looks < Timeout; ++looks) {
    if ((Xil_In32(RegAddr) & EventMask) == Event) return XST_SUCCESS;
    usleep(1);
  }
  return XST_FAILURE;
}

u32 Xil_WaitForEvents(UINTPTR EventsRegAddr, u32 EventsMask, u32 WaitEvents, u32 Timeout,
                      u32* Events) {
  *Events = 0;
  for (u32 looks = 0; looks < Timeout; ++looks) {
    const u32 seen = Xil_In32(EventsRegAddr) & EventsMask;
    if ((seen & WaitEvents) != 0) {
      *Events = seen;
      return XST_SUCCESS;
    }
    usleep(1);
  }
  return XST_TIMEOUT;
}

u32 Xil_WaitForEventSet(u32 Timeout, u32 NumOfEvents, volatile u32* EventAddr, ...) {
  va_list addresses;
  va_start(addresses, EventAddr);
  u32 looks = 0;
  volatile u32* address = EventAddr;
  for (u32 event = 0; event < NumOfEvents; ++event) {
    if (event > 0) address = va_arg(addresses, volatile u32*);
    for (; looks < Timeout && Xil_In32(reinterpret_cast<UINTPTR>(address)) == 0; ++looks) usleep(1);
  }
  va_end(addresses);
  return looks < Timeout ? XST_SUCCESS : XST_FAILURE;
}

u32 Xil_ConvertCharToNibble(u8 InChar, u8* Num) {
  if (InChar >= '0' && InChar <= '9') {
    *Num = static_cast<u8>(InChar - '0');
  } else if (InChar >= 'a' && InChar <= 'f') {
    *Num = static_cast<u8>(InChar - 'a' + 10);
  } else if (InChar >= 'A' && InChar <= 'F') {
    *Num = static_cast<u8>(InChar - 'A' + 10);
  } else {
    return XST_FAILURE;
  }
  return XST_SUCCESS;
}

s32 Xil_TestIO8(u8* Addr, s32 Length, u8 Value) {
  for (s32 i = 0; i < Length; ++i) {
    Xil_Out8(reinterpret_cast<UINTPTR>(Addr), Value);
    if (Xil_In8(reinterpret_cast<UINTPTR>(Addr)) != Value) return -1;
  }
  return 0;
}

s32 Xil_TestIO16(u16* Addr, s32 Length, u16 Value, s32, s32) {
  for (s32 i = 0; i < Length; ++i) {
    Xil_Out16(reinterpret_cast<UINTPTR>(Addr), Value);
    if (Xil_In16(reinterpret_cast<UINTPTR>(Addr)) != Value) return -1;
  }
  return 0;
}

s32 Xil_TestIO32(u32* Addr, s32 Length, u32 Value, s32, s32) {
  for (s32 i = 0; i < Length; ++i) {
    Xil_Out32(reinterpret_cast<UINTPTR>(Addr), Value);
    if (Xil_In32(reinterpret_cast<UINTPTR>(Addr)) != Value) return -1;
  }
  return 0;
}

}  // extern "C"
