// What the macros of MarkervpAssembly.h call. An instruction changes no register, so all that a
// function may change are kept but those of floating point: no value stays in them between two
// statements, as programs are compiled with -O0.
#include <hal/hal.h>

#if defined(__x86_64__)
extern "C" {
__attribute__((visibility("hidden"))) void markervp_irq_on() {
  static_cast<void>(hal_interrupt_enable(true));
}
__attribute__((visibility("hidden"))) void markervp_irq_off() {
  static_cast<void>(hal_interrupt_enable(false));
}
}

__asm__(R"(
  .macro markervp_call name, function
  .text
  .globl markervp_\name
  .hidden markervp_\name
markervp_\name:
  .cfi_startproc
  pushfq
  .irp register, rax, rcx, rdx, rsi, rdi, r8, r9, r10, r11, rbp
  pushq %\register
  .endr
  movq %rsp, %rbp
  .cfi_def_cfa %rbp, 96
  .cfi_offset %rbp, -96
  andq $-16, %rsp
  call \function@PLT
  movq %rbp, %rsp
  .irp register, rbp, r11, r10, r9, r8, rdi, rsi, rdx, rcx, rax
  popq %\register
  .endr
  popfq
  ret
  .cfi_endproc
  .endm
  markervp_call sev, hal_send_event
  markervp_call wfe, hal_wait_for_event
  markervp_call wfi, hal_wait_for_interrupt
  markervp_call barrier, hal_barrier
  markervp_call cpsie, markervp_irq_on
  markervp_call cpsid, markervp_irq_off
)");
#endif
