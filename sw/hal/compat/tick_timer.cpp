// xiltimer.h: the tick.
#include <algorithm>

#include <private_timer_registers.h>
#include <xiltimer.h>
#include <xinterrupt_wrap.h>
#include <xscutimer_hw.h>

namespace {

constexpr UINTPTR base = XPAR_XSCUTIMER_0_BASEADDR;

XTimer_TickHandler tick_handler = nullptr;
void* tick_context = nullptr;

void on_tick(void*) {
  XTimer_ClearTickInterrupt();
  if (tick_handler != nullptr) tick_handler(tick_context, 0);
}

}  // namespace

extern "C" {

void XTimer_SetInterval(unsigned long delay) {
  using namespace private_timer::control;
  const unsigned long per_second =
      std::max(1ul, static_cast<unsigned long>(XTIMER_DELAY_MSEC) / std::max(1ul, delay));
  XScuTimer_SetControlReg(base, 0);
  XScuTimer_SetLoadReg(base, static_cast<u32>(COUNTS_PER_SECOND / per_second));
  XScuTimer_SetControlReg(base, IRQ_Enable | Auto_Reload | Enable);
}

void XTimer_SetHandler(XTimer_TickHandler FuncPtr, void* CallBackRef, u8 Priority) {
  tick_handler = FuncPtr;
  tick_context = CallBackRef;
  XSetupInterruptSystem(nullptr, reinterpret_cast<void*>(&on_tick), XPAR_XSCUTIMER_0_INTERRUPTS,
                        XPAR_XSCUTIMER_0_INTERRUPT_PARENT, Priority);
}

void XTimer_ClearTickInterrupt(void) {
  XScuTimer_SetIntrReg(base, private_timer::status::Event_Flag);
}

}  // extern "C"
